// λ_ω against the speed.

const softening = new Chart("softening", {x: "speed ω, rad/s", y: "λ_ω", label: "Softening coefficient against rotation speed, one curve per model"});
// The paper's beam, and further where a blade's exact λ goes further.
const LAMBDA = {close: [Math.min(-0.08, 1.2 * Math.min(...D.exact_lambda_omega)), Math.max(0.06, 1.2 * Math.max(...D.exact_lambda_omega))], all: [-0.15, 1.4]};
function drawSoftening() {
  const curves = {};
  softening.frame([D.omega[0], FASTEST], LAMBDA[state.scale], back => {
    const y = softening.y(0);
    node("line", {class: "zero", x1: softening.x0, x2: softening.x1, y1: y, y2: y}, back);
  });
  for (const m of shown()) curves[m] = Array.from(D.omega, (v, w) => [v, lambda(m, w)]);
  softening.draw(curves);
  softening.name(curves);
}
function markSpeed() {
  softening.front.replaceChildren();
  const x = softening.x(D.omega[state.w]);
  softening.mark(D.omega[state.w], `ω = ${fixed(D.omega[state.w], 2)}`);
  for (const m of shown().reverse()) {
    const y = softening.y(lambda(m, state.w));
    if (Number.isFinite(y)) node("circle", {cx: x, cy: y, r: 3.5, fill: stroke(m), "data-model": m}, softening.front);
  }
}
/** What the curves say at a speed. */
function softeningNumbers(w) {
  const lines = shown().map(m => [m, lambda(m, w)]).filter(([, v]) => Number.isFinite(v)).sort((p, q) => q[1] - p[1]);
  return [`ω = ${fixed(D.omega[w], 2)} rad/s`, lines.map(([m, v]) => [m, m, fixed(v, 5)])];
}
function tellSoftening(place) {
  softening.over.replaceChildren();
  if (!place || place[0] < softening.x0 || place[0] > softening.x1 + 20) return softening.tell(null);
  const w = nearest(D.omega, softening.invertX(place[0])), x = softening.x(D.omega[w]);
  node("line", {class: "cross", x1: x, x2: x, y1: softening.y0, y2: softening.y1}, softening.over);
  softening.tell(place, ...softeningNumbers(w));
}
softening.listen(tellSoftening, place => set({w: nearest(D.omega, softening.invertX(place[0]))}));
softening.step("w", D.omega, tellSoftening, softeningNumbers);
