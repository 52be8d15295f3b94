// Each chart as PNG, SVG or CSV, made here: nothing is asked of a network.

/** Columns [name with its unit, values] of each chart's CSV; a chart adds its own here. */
const COLUMNS = {
  backbone() {
    const steps = Array.from({length: A + 1}, (_, i) => i - 1), points = finiteElements();
    return [
      ["a [-]", steps.map(i => i < 0 ? 0 : D.a[i])],
      ...shown().map(m => [`omega_NL ${m} [rad/s]`, steps.map(i => frequency(m, state.w, i))]),
      ...points.length ? [["a finite elements [-]", points.map(p => p[0])], ["omega_NL finite elements [rad/s]", points.map(p => p[2])]] : [],
    ];
  },
  orbit() {
    const degrees = Array.from({length: TURN + 1}, (_, k) => 360 * k / TURN);
    return [["phase [deg]", degrees], ...shown().flatMap(m => [[`x ${m} [-]`, orbits[m].map(p => p[0])], [`dx/dtau ${m} [-]`, orbits[m].map(p => p[1])]])];
  },
  softening: () => [["omega [rad/s]", [...D.omega]], ...shown().map(m => [`lambda_omega ${m} [-]`, [...D.omega].map((_, w) => lambda(m, w))])],
  "spin-up": () => [["t [s]", spinUpCurve().map(p => p[0])], ["q/L [-]", spinUpCurve().map(p => p[1])]],
  left() {
    const j = speed(), n = D.ramp_curve.length, runs = D.ramp_time.length;
    return [["T [s]", [...D.exact_ramp_time]], ["a exact [-]", [...D.exact_left.subarray(j * RAMPS, (j + 1) * RAMPS)]],
      ["T closed form [s]", [...D.ramp_curve]], ["a closed form [-]", [...D.closed_left.subarray(j * n, (j + 1) * n)]],
      ["T finite elements [s]", [...D.ramp_time]], ["a finite elements [-]", [...D.fe_amplitude.subarray(j * runs, (j + 1) * runs)]]];
  },
  beam() {
    const points = beamAxis(state.w, state.a, state.phase);
    return [["x/L [-]", points.map(p => p[0])], ["y/L [-]", points.map(p => p[1])]];
  },
};
const quoted = text => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
function toCSV(columns, about) {
  const rows = Math.max(...columns.map(([, values]) => values.length));
  const lines = Array.from({length: rows}, (_, i) => columns.map(([, values]) => Number.isFinite(values[i]) ? String(values[i]) : "").join(","));
  return [`# ${about}`, columns.map(([name]) => quoted(name)).join(","), ...lines, ""].join("\n");
}

const KEPT = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap", "opacity", "paint-order",
  "font-family", "font-size", "font-weight", "text-anchor"];
/** What a key says: curves that bear no name, and a person's own points, [name, its mark drawn at a place]. */
function keysOf(figure, drawn) {
  const curves = figure.querySelector("text.name") ? [] : [...new Set([...drawn.querySelectorAll("[data-model]")].map(e => e.dataset.model))];
  curves.sort((m, n) => (ORDER.indexOf(m) + 1 || Infinity) - (ORDER.indexOf(n) + 1 || Infinity));
  const points = [...new Set([...drawn.querySelectorAll("[data-own]")].map(e => +e.dataset.own))];
  return [...curves.map(m => [nameOf(m), m, (x, y, into) =>
    node("line", {class: m === "exact" ? "curve exact" : "curve", style: colors(m), "stroke-dasharray": dashes(m), x1: x, x2: x + 24, y1: y, y2: y}, into)]),
    ...points.map(k => [OWN[k].name, `own-${k}`, (x, y, into) => node("path", {class: "own", d: markOf(k, x + 12, y)}, into)])];
}
/** Write keys in rows that end at a width, and below them the words under the chart; return where they end. */
function writeBelow(figure, keys, made, width, from) {
  let x = 8, y = from + 6;
  for (const [name, m, mark] of keys) {
    const text = node("text", {class: "name", style: colors(m)}, made, name), wide = 29 + text.getComputedTextLength();
    if (x > 8 && x + wide > width) { x = 8; y += 18; }
    text.setAttribute("x", x + 29); text.setAttribute("y", y + 4);
    mark(x, y, made);
    x += wide + 18;
  }
  if (keys.length) y += 18;
  let line = null;
  for (const word of figure.querySelector(".about").textContent.trim().split(/\s+/)) {
    const before = line?.textContent;
    if (line) line.textContent += ` ${word}`;
    if (line && line.getComputedTextLength() <= width - 8) continue;
    if (line) line.textContent = before;
    line = node("text", {x: 4, y: y + 4}, made, word);
    y += LETTERS;
  }
  return y;
}
/** The drawing with its styles written into it, between its title, a key and what is said of it. */
function toSVG(figure) {
  const drawn = figure.querySelector(".plot > svg"), {width, height} = drawn.getBoundingClientRect(), keys = keysOf(figure, drawn);
  document.documentElement.classList.add("printing");  // on white, whatever the screen
  try {
    const made = node("svg", {xmlns: SVG, width});
    drawn.append(made);  // where styles reach it
    const ground = node("rect", {width, fill: "var(--paper)"}, made);
    const title = node("text", {class: "here", x: 2, y: 17}, made);
    write(title, titleOf(figure));
    node("tspan", {"font-weight": 400}, title, `, ${stateInWords(figure.querySelector(".plot").id)}`);
    const copy = node("g", {transform: "translate(0,26)"}, made);
    for (const child of drawn.children) if (child !== made) copy.append(child.cloneNode(true));
    const tall = writeBelow(figure, keys, made, width, 26 + height);
    ground.setAttribute("height", tall);
    for (const [n, v] of [["height", tall], ["viewBox", `0 0 ${width} ${tall}`]]) made.setAttribute(n, v);
    const all = [...made.querySelectorAll("*")];
    const styles = all.map(e => { const computed = getComputedStyle(e); return KEPT.map(name => `${name}:${computed.getPropertyValue(name)}`).join(";"); });
    all.forEach((e, i) => {
      if (e.getAttribute("visibility") === "hidden") return e.remove();
      e.setAttribute("style", styles[i]);
      for (const name of ["class", "fill", "stroke-dasharray"]) e.removeAttribute(name);
    });
    made.remove();
    return {width, height: tall, text: new XMLSerializer().serializeToString(made)};
  } finally {
    drawn.querySelector(":scope > svg")?.remove();
    document.documentElement.classList.remove("printing");
  }
}
const SHARPER = 3;  // pixels of the PNG to one of the page: 288 to the inch
async function toPNG({width, height, text}) {
  const image = new Image();
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(text);
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), {width: Math.round(SHARPER * width), height: Math.round(SHARPER * height)});
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise(done => canvas.toBlob(done, "image/png"));
}

const titleOf = figure => figure.querySelector("h2").dataset.title ?? figure.querySelector("h2").textContent;
/** What is chosen of what a chart shows: [name, letter, value, unit]. */
function chosen(id) {
  const spun = id === "spin-up" || id === "left";
  return [["omega", "ω", spun ? D.fe_omega[speed()] : D.omega[state.w], " rad/s"], spun ? ["T", "T", T(), " s"] : ["a", "a", D.a[state.a], ""]];
}
const stateInWords = id => chosen(id).map(([, letter, value, unit]) => `${letter} = ${plain(value)}${unit}`).join(", ");
async function save(figure, kind) {
  const id = figure.querySelector(".plot").id, about = `Rotating beam explorer, ${titleOf(figure)}: ${stateInWords(id)}`;
  const blob = kind === "csv" ? new Blob([toCSV([...COLUMNS[id](), ...ownColumns(id)], [about, ...DATA.blade.split("\n")].filter(Boolean).join("; "))], {type: "text/csv"})
    : kind === "svg" ? new Blob([toSVG(figure).text], {type: "image/svg+xml"}) : await toPNG(toSVG(figure));
  const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: [id, ...chosen(id).map(([name, , value]) => name + plain(value))].join("-") + `.${kind}`});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
for (const figure of document.querySelectorAll("figure:not(#turns)")) {
  const menu = document.createElement("details"), offered = document.createElement("div");
  menu.className = "save";
  menu.append(Object.assign(document.createElement("summary"), {textContent: "Save"}), offered);
  menu.firstChild.setAttribute("aria-label", `Save ${titleOf(figure)}`);
  for (const kind of ["png", "svg", "csv"]) {
    const button = Object.assign(document.createElement("button"), {textContent: kind.toUpperCase()});
    button.setAttribute("aria-label", `Save ${titleOf(figure)} as ${kind.toUpperCase()}`);
    button.addEventListener("click", () => { menu.open = false; save(figure, kind); });
    offered.append(button);
  }
  document.addEventListener("pointerdown", e => { if (!menu.contains(e.target)) menu.open = false; });
  menu.addEventListener("keydown", e => { if (e.key === "Escape") { menu.open = false; menu.firstChild.focus(); } });
  figure.querySelector("figcaption").append(menu);
}
