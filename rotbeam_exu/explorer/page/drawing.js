// Drawing: nodes, words, colors, ticks, and labels that keep clear of one another.

const SVG = "http://www.w3.org/2000/svg";
function node(tag, attributes = {}, parent = null, text = null) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== null) made.textContent = text;
  if (parent) parent.append(made);
  return made;
}
/** Put a circle at a place, and away where there is none. */
function place(circle, x, y) {
  circle.setAttribute("visibility", Number.isFinite(x) ? "visible" : "hidden");
  if (Number.isFinite(x)) { circle.setAttribute("cx", x); circle.setAttribute("cy", y); }
}
/** Write a label, its subscripts after an underscore each. */
function write(text, label) {
  if (text.dataset.label === label) return;
  text.dataset.label = label;
  text.replaceChildren();
  for (const [, sub, part] of label.matchAll(/(_?)([A-Za-z]+|[^_A-Za-z]+)/g))
    node("tspan", sub ? {"font-size": "80%", dy: 3} : {}, text, part).after(...(sub ? [node("tspan", {dy: -3}, null, "\u200b")] : []));
}
const WIDTHS = new Map();
/** How wide a text is; remembered, for to measure makes the browser lay out the page. */
function widthOf(text) {
  const key = text.getAttribute("class") + text.textContent;
  if (!WIDTHS.has(key)) WIDTHS.set(key, text.getComputedTextLength());
  return WIDTHS.get(key);
}
const minus = text => text.replace("-", "−");
const fixed = (x, digits) => Number.isFinite(x) ? minus((Math.abs(x) < 0.5 * 10 ** -digits ? 0 : x).toFixed(digits)) : "–";
const plain = x => String(+x.toFixed(6));

const COLORED = {exact: "ink", FrM5: "FrM", closed: "FrM"};  // others by their own names, if style.css knows them
/** The name of a curve's color. */
function colorOf(m) {
  if (!(m in COLORED)) COLORED[m] = m.startsWith("own-") ? "own" : getComputedStyle(document.documentElement).getPropertyValue(`--${m}`) ? m : "other";
  return COLORED[m];
}
const stroke = m => `var(--${colorOf(m)})`;
const ink = m => m === "exact" ? "var(--ink)" : `var(--${colorOf(m)}-word)`;
const colors = m => `--s:${stroke(m)};--c:${ink(m)}`;
const DASHES = {
  exact: "", closed: "", FrM: "", FrM5: "1 3", FrE: "7 3", FrI: "9 2 2 2", CE: "5 2", CI: "2 2", FrC: "7 2 2 2 2 2", P3: "1 3", P4: "4 4", P5: "12 3",
};
const dashes = m => DASHES[m] ?? (m.startsWith("own-") ? OWN_DASHES[m.slice(4) % OWN_DASHES.length] : "1 2");
const nameOf = m => m === "closed" ? "closed form" : m.startsWith("own-") ? OWN[m.slice(4)].name : m;

/** Values and texts on an axis of so many pixels, at least `apart` from each other. */
function ticks(low, high, pixels, apart) {
  const rough = (high - low) * apart / Math.max(1, pixels), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(s => s * power >= 0.999 * rough);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), values = [];
  for (let i = Math.ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; i++) values.push(i * step);
  return values.map(v => [v, fixed(v, digits)]);
}

/** Ascending places, moved as little as possible to be `gap` apart between two bounds: pooled, where they are too close. */
function spread(places, gap, low, high) {
  const pools = [];
  places.forEach((place, i) => {
    pools.push({sum: place - gap * i, count: 1});
    for (let n = pools.length; n > 1 && pools[n - 2].sum / pools[n - 2].count >= pools[n - 1].sum / pools[n - 1].count; n--) {
      const {sum, count} = pools.pop();
      pools[n - 2].sum += sum; pools[n - 2].count += count;
    }
  });
  const top = high - gap * (places.length - 1);
  return pools.flatMap(({sum, count}) => Array(count).fill(Math.max(low, Math.min(top, sum / count)))).map((v, i) => v + gap * i);
}
