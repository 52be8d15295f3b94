// The beam that turns, seen from outside: exact, and the linear one without the tension of rotation.

const turning = {host: document.getElementById("turning"), time: 0};
turning.svg = node("svg", {role: "img", "aria-label": "The turning beam seen from outside: exact, and linear"}, turning.host);
turning.circle = node("circle", {class: "zero", fill: "none"}, turning.svg);
turning.rigid = node("line", {class: "zero"}, turning.svg);
turning.trace = node("path", {class: "trace"}, turning.svg);
turning.linear = node("path", {class: "beam linear"}, turning.svg);
turning.exact = node("path", {class: "beam"}, turning.svg);
turning.hub = node("circle", {class: "dot", r: 6}, turning.svg);
turning.said = document.getElementById("about-turning");
const AT_REST = D.exact_omega_n[0], SLOW = 4;  // the picture turns with 4 rad/s at most
/** The linear beam exists for the paper's beam, whose first slider stop is at rest. */
const hasLinear = DATA.blade === "" && D.omega[0] === 0;
document.getElementById("legend-linear").hidden = !hasLinear;
/** Tip over L of the linear beam, let go at q = a: q̈ + (ω_0² - ω²) q = 0. */
function linearTip(w, i, time) {
  const k = AT_REST ** 2 - D.omega[w] ** 2, rate = Math.sqrt(Math.abs(k)) * time;
  return D.a[i] * (k > 0 ? Math.cos(rate) : Math.cosh(rate));
}
/** When the linear tip has left the picture, in seconds; never below ω_0. */
function lostAfter(w, i) {
  const k = D.omega[w] ** 2 - AT_REST ** 2;
  return k > 0 ? Math.acosh(1.2 / D.a[i]) / Math.sqrt(k) : Infinity;
}
/** The linear beam over L: the shape of the smallest orbit at rest. */
function linearAxis(w, i, time) {
  const mode = beamAxis(0, 0, Math.PI / 2), q = linearTip(w, i, time) / mode[LAST][1];
  return mode.map(([, y], p) => [p / LAST, q * y]);
}
const turned = (points, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), {x0, y0, scale} = turning;
  return points.map(([x, y]) => [x0 + scale * (c * x - s * y), y0 - scale * (s * x + c * y)]);
};
function drawTurning() {
  turning.time = 0;
  moveTurning();
}
function moveTurning() {
  const width = turning.host.clientWidth, height = turning.host.clientHeight;
  if (!width) return;
  Object.assign(turning, {x0: width / 2, y0: height / 2, scale: Math.min(width, height) / 2.3});
  const {w, a: i} = state, time = turning.time, omega = D.omega[w], own = exactFrequency(w, i);
  place(turning.hub, turning.x0, turning.y0);
  place(turning.circle, turning.x0, turning.y0);
  turning.circle.setAttribute("r", turning.scale);
  const at = t => turned(beamAxis(w, i, Math.PI / 2 + own * t), omega * t);
  const [tip] = turned([[1, 0]], omega * time);
  for (const [key, value] of Object.entries({x1: turning.x0, y1: turning.y0, x2: tip[0], y2: tip[1]})) turning.rigid.setAttribute(key, value);
  turning.exact.setAttribute("d", smooth(at(time)));
  let trace = "";
  for (let k = 0; k <= 40; k++) {
    const t = time - Math.min(time, Math.PI / (omega || own)) * k / 40, [[x, y]] = turned(beamAxis(w, i, Math.PI / 2 + own * t, LAST), omega * t);
    trace += (k ? "L" : "M") + x.toFixed(1) + "," + y.toFixed(1);
  }
  turning.trace.setAttribute("d", trace.includes("NaN") ? "" : trace);
  const lost = time > lostAfter(w, i);
  turning.linear.setAttribute("d", hasLinear && !lost ? smooth(turned(linearAxis(w, i, time), omega * time)) : "");
  const slower = Math.max(1, omega / SLOW);
  turning.said.textContent = (slower > 1 ? `${fixed(slower, 1)} times slower than real time. ` : "") +
    (!hasLinear ? (Number.isFinite(own) ? `It swings with ${fixed(own, 2)} rad/s.` : "No exact orbit was found here.") : Number.isFinite(lostAfter(w, i)) ? (lost ? `The linear beam is lost, ${fixed(lostAfter(w, i), 2)} s after both were let go.` : "Both were let go at the same deflection.")
      : `The linear beam swings with ${fixed(Math.sqrt(AT_REST ** 2 - omega ** 2), 2)} rad/s, the exact one with ${fixed(own, 2)}. Turn faster than ${fixed(AT_REST, 2)} rad/s!`);
}
/** Go on by so many seconds on the clock; some time after the linear beam is lost, begin again. */
function turn(elapsed) {
  turning.time += elapsed / Math.max(1, D.omega[state.w] / SLOW);
  if (turning.time > Math.max(8, lostAfter(state.w, state.a) + 6) && Number.isFinite(lostAfter(state.w, state.a))) turning.time = 0;
  moveTurning();
}
// Simple or expert; and the ramp that leaves the least.
for (const button of document.querySelectorAll("button[data-view]")) button.addEventListener("click", () => set({view: button.dataset.view}));
const quietest = () => {
  const left = Array.from(D.exact_ramp_time, (_, t) => exactLeft(speed(), t)).map(a => Number.isFinite(a) ? a : Infinity);
  return left.indexOf(Math.min(...left));
};
document.getElementById("quiet").addEventListener("click", () => set({t: quietest()}));
document.getElementById("again").addEventListener("click", () => {
  drawTurning();
  if (!state.playing) { state.playing = true; showPlaying(); start(); }
});
function showView() {
  document.documentElement.dataset.view = state.view;
  const least = exactLeft(speed(), quietest());
  document.getElementById("challenge").textContent = exactLeft(speed(), state.t) <= Math.max(1.05 * least, 0.01)
    ? `Quiet: after this ramp the tip swings by ${fixed(exactLeft(speed(), state.t), 4)} L.`
    : "Challenge: find a ramp time after which the blade hardly swings.";
}
