// A person's own points among the backbones, and own histories beside the spin-up.

const OWN = [], SHAPES = [[[0, -6], [6, 0], [0, 6], [-6, 0]], [[0, -5.5], [6, 5.5], [-6, 5.5]], [[-5, -5], [5, -5], [5, 5], [-5, 5]]];
const OWN_DASHES = ["6 4", "2 3", "10 3 2 3"], MOST_POINTS = 4000;
const markOf = (k, x, y) => "M" + SHAPES[k % SHAPES.length].map(([dx, dy]) => `${x + dx},${y + dy}`).join("L") + "Z";

/** Own points at the present speed: [a, ratio, frequency, which]. */
function ownPoints() {
  return OWN.flatMap((own, k) => own.kind !== "points" ? [] : own.rows.filter(r => r.w === state.w)
    .map(r => [r.a, r.omega_NL / (state.norm === "own" ? r.omega_n ?? D.exact_omega_n[r.w] : D.exact_omega_n[r.w]), r.omega_NL, k]));
}
function drawOwnPoints() {
  for (const [a, ratio, , k] of ownPoints())
    if (a <= LARGEST) node("path", {class: "own", "data-own": k, d: markOf(k, backbone.x(a), backbone.y(ratio))}, backbone.front);
}
/** How many points of one's own are at the present speed and outside the axes. */
const ownUnseen = () => ownPoints().filter(([a, ratio]) => a > LARGEST || !backbone.inside(ratio)).length;
/** A history [t, q/L] in the time that is drawn, thinned to what a screen shows. */
function thinned({rows, key}) {
  const within = (r, i) => (rows[i + 1] ?? r).t >= 0 && (rows[i - 1] ?? r).t <= DATA.duration;
  const drawn = rows.filter(within), every = Math.ceil(drawn.length / MOST_POINTS);
  return drawn.filter((_, i) => i % every === 0).map(r => [r.t, r[key]]);
}
const ownHistories = () => Object.fromEntries(OWN.flatMap((own, k) => own.kind === "history" ? [[`own-${k}`, own.line]] : []));
/** Columns of a chart's CSV that are a person's own. */
function ownColumns(id) {
  return OWN.flatMap(({name, kind, rows, key}) =>
    id === "backbone" && kind === "points" ? [[`a ${name} [-]`, rows.filter(r => r.w === state.w).map(r => r.a)], [`omega_NL ${name} [rad/s]`, rows.filter(r => r.w === state.w).map(r => r.omega_NL)]]
    : id === "spin-up" && kind === "history" ? [[`t ${name} [s]`, rows.map(r => r.t)], [`q/L ${name} [-]`, rows.map(r => r[key])]] : []);
}
const places = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
/** What became of a file, in a sentence. */
function described({kind, rows, headings, without}) {
  const told = kind === "history" ? headings : headings.filter(h => columnOf(h).key === "omega_NL" && !/^(omega|ω)_nl\s*([[(]|$)/i.test(h));
  const from = (told.length ? `, from "${told.join('", "')}"` : "") + (without ? `; ${places(without, "row")} without a number left out` : "");
  if (kind === "history") {
    const beyond = rows.filter(r => r.t < 0 || r.t > DATA.duration).length;
    return `${places(rows.length, "sample")} of q(t) beside the spin-up${from}` + (beyond ? `; ${beyond} not within 0 to ${plain(DATA.duration)} s` : "");
  }
  const speeds = [...new Set(rows.map(r => r.w))].map(w => plain(D.omega[w])), beyond = rows.filter(r => r.a > LARGEST).length;
  return `${places(rows.length, "point")} at ${speeds.join(", ")} rad/s` + (rows[0].omega === undefined ? ", the slider's speed" : "") +
    (rows[0].omega_n === undefined ? ", over the exact natural frequency" : "") + from + (beyond ? `; ${beyond} beyond a = ${plain(LARGEST)}` : "");
}
async function take(file) {
  if (file.size > MOST_BYTES) refuse(`it has ${Math.round(file.size / 1e6)} MB: give at most ${MOST_BYTES / 1e6}`);
  const own = {name: file.name, ...checked(readTable(await file.text()))};
  const half = 0.5 * (D.omega[1] - D.omega[0]) + 1e-9;
  for (const row of own.rows) {
    row.w = row.omega === undefined ? state.w : nearest(D.omega, row.omega);
    if (row.omega !== undefined && Math.abs(D.omega[row.w] - row.omega) > half) refuse(`line ${row.line}: omega = ${row.omega} rad/s is beyond the slider, which ends at ${plain(FASTEST)} rad/s`);
  }
  if (own.kind === "history") own.line = thinned(own);
  OWN.push(own);
}
async function takeAll(files) {
  const said = [];
  for (const file of files)
    try { await take(file); }
    catch (error) { said.push(`${file.name}: ${error instanceof Refused ? error.message : "it cannot be read"}.`); }
  listOwn(said.join(" "));
}
function listOwn(refused = "") {
  document.getElementById("refused").textContent = refused;
  document.getElementById("own-list").replaceChildren(...OWN.map((own, k) => {
    const item = document.createElement("li"), swatch = node("svg", {width: 21, height: 14, "aria-hidden": "true"}), words = document.createElement("span");
    if (own.kind === "points") node("path", {class: "own", d: markOf(k, 10.5, 7)}, swatch);
    else node("line", {class: "curve", style: colors(`own-${k}`), "stroke-dasharray": dashes(`own-${k}`), x1: 0, x2: 21, y1: 7, y2: 7}, swatch);
    words.textContent = `${own.name}: ${described(own)}.`;
    const remove = Object.assign(document.createElement("button"), {textContent: "Remove"});
    remove.setAttribute("aria-label", `Remove ${own.name}`);
    remove.addEventListener("click", () => { OWN.splice(k, 1); listOwn(); });
    item.append(swatch, words, remove);
    return item;
  }));
  drawAll();
}
const chooser = document.getElementById("file");
chooser.addEventListener("change", () => { takeAll([...chooser.files]); chooser.value = ""; });
for (const [kind, over] of [["dragover", true], ["dragleave", false], ["drop", false]])
  window.addEventListener(kind, e => {
    if (![...e.dataTransfer.types].includes("Files")) return;
    e.preventDefault();
    document.body.classList.toggle("dropping", over);
    if (kind === "drop") takeAll([...e.dataTransfer.files]);
  });
