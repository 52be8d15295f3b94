// Frequency against amplitude.

const backbone = new Chart("backbone", {x: "a = peak of q/L", y: "ω_NL/ω_n", label: "Frequency against amplitude, one curve per model"});
const RATIO = {close: {own: [0.98, 1.02], exact: [0.97, 1.07]}, all: {own: [0.5, 1.06], exact: [0.5, 1.35]}};
const base = (m, w) => state.norm === "own" ? linear(m, w) : D.exact_omega_n[w];
function drawBackbone() {
  const w = state.w, curves = {};
  backbone.frame([0, LARGEST], RATIO[state.scale][state.norm], back => {
    if (LARGEST <= PAPER_BOUND) return;
    const x = backbone.x(PAPER_BOUND);
    node("rect", {class: "wash", x, width: backbone.x1 - x, y: backbone.y1, height: backbone.y0 - backbone.y1}, back);
  });
  write(backbone.yTitle, state.norm === "own" ? "ω_NL/ω_n, each model by its own" : "ω_NL over the exact beam's ω_n");
  for (const m of shown()) {
    const points = curves[m] = [];
    for (let i = -1; i < A; i++) points.push([i < 0 ? 0 : D.a[i], frequency(m, w, i) / base(m, w)]);
  }
  backbone.draw(curves);
  backbone.name(curves);
  backbone.front.replaceChildren();
  backbone.mark(D.a[state.a], `a = ${fixed(D.a[state.a], 2)}`);
  const here = finiteElements();
  for (const [a, f] of here) if (a <= LARGEST) node("circle", {class: "point", cx: backbone.x(a), cy: backbone.y(f), r: 4}, backbone.front);
  drawOwnPoints();
  const beyond = here.filter(p => p[0] > LARGEST).map(p => fixed(p[0], 2));
  document.getElementById("about-backbone").textContent =
    (state.hide.has("FE") ? "" : `○ ${DATA.elements} finite elements` + (!here.length ? `: at ${[...D.fe_omega].map(plain).join(", ")} rad/s only. `
      : beyond.length ? `, more at a = ${beyond.join(", ")}. ` : ". ")) +
    (LARGEST > PAPER_BOUND ? "Shaded: amplitudes beyond the paper's own bound. " : "") + (ownUnseen() ? `Outside these axes: ${places(ownUnseen(), "point")} of your own.` : "");
}
/** Points at the present speed, [a, ratio, frequency]; none between the speeds of the runs. */
function finiteElements() {
  const j = D.fe_omega.findIndex(v => Math.abs(v - D.omega[state.w]) < 1e-9), T = SHAPE.fe_amplitude[1], found = [];
  if (j < 0 || state.hide.has("FE")) return found;
  for (let i = 0; i < T; i++) {
    const f = D.fe_frequency[j * T + i];
    found.push([D.fe_amplitude[j * T + i], f / (state.norm === "own" ? D.fe_omega_n[j * T + i] : D.exact_omega_n[state.w]), f]);
  }
  return found;
}
/** What the curves say at an amplitude. */
function backboneNumbers(i) {
  const lines = shown().map(m => [m, frequency(m, state.w, i) / base(m, state.w)]).filter(([, f]) => Number.isFinite(f)).sort((p, q) => q[1] - p[1]);
  return [`a = ${fixed(D.a[i], 2)}`, lines.map(([m, f]) => [m, m, fixed(f, 5)])];
}
function tellBackbone(place) {
  backbone.over.replaceChildren();
  if (!place || place[0] < backbone.x0 || place[0] > backbone.x1 + 20) return backbone.tell(null);
  const i = nearest(D.a, backbone.invertX(place[0])), x = backbone.x(D.a[i]);
  const point = finiteElements().find(([a, f]) => Math.hypot(backbone.x(a) - place[0], backbone.y(f) - place[1]) < 9);
  if (point) return backbone.tell(place, `${DATA.elements} finite elements`, [[null, "a", fixed(point[0], 4)], [null, "ω_NL", fixed(point[2], 4) + " rad/s"], [null, "ratio", fixed(point[1], 5)]]);
  const own = ownPoints().find(([a, f]) => Math.hypot(backbone.x(a) - place[0], backbone.y(f) - place[1]) < 9);
  if (own) return backbone.tell(place, OWN[own[3]].name, [[null, "a", fixed(own[0], 4)], [null, "ω_NL", fixed(own[2], 4) + " rad/s"], [null, "ratio", fixed(own[1], 5)]]);
  node("line", {class: "cross", x1: x, x2: x, y1: backbone.y0, y2: backbone.y1}, backbone.over);
  backbone.tell(place, ...backboneNumbers(i));
}
backbone.listen(tellBackbone, place => set({a: nearest(D.a, backbone.invertX(place[0]))}));
backbone.step("a", D.a, tellBackbone, backboneNumbers);
