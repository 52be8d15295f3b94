// The exact spin-up by Eq. 1 to the nearest speed of the finite elements, and what its ramp time leaves.

const spinUp = new Chart("spin-up", {x: "time t, s", y: "q/L", margin: {left: 44, right: 20, top: 28, bottom: 36}, label: "Deflection of the tip against time, exact"});
const left = new Chart("left", {x: "ramp time T, s", y: "amplitude left, over L", margin: {left: 52, right: 20, top: 28, bottom: 36}, label: "Amplitude left after the ramp against its duration"});
const RAMPS = D.exact_ramp_time.length, SAMPLES = SHAPE.spin_up[2];
const HIGHEST = 0.2;  // decades of the amplitude left
const LOWEST = Math.max(-5, Math.min(-1, Math.floor(2 * Math.log10(D.exact_left.reduce((least, a) => a > 0 ? Math.min(least, a) : least, 0.1))) / 2));
/** Which of the finite elements' speeds is shown. */
const speed = () => nearest(D.fe_omega, D.omega[state.w]);
const seconds = i => DATA.duration * i / (SAMPLES - 1);
/** q/L of the exact spin-up at a sample. */
function spinUpAt(j, t, i) {
  const value = D.spin_up[(j * RAMPS + t) * SAMPLES + i];
  return value === DATA.unknown ? NaN : DATA.step * value;
}
const exactLeft = (j, t) => D.exact_left[j * RAMPS + t];
const T = () => D.exact_ramp_time[state.t];
const spinUpCurve = () => Array.from({length: SAMPLES}, (_, i) => [seconds(i), spinUpAt(speed(), state.t, i)]);
/** What finite elements say of the ramp time, NaN if they were not asked. */
function meshLeft(j, time) {
  const k = D.ramp_time.findIndex(v => Math.abs(v - time) < 1e-9);
  return k < 0 || state.hide.has("FE") ? NaN : D.fe_amplitude[j * D.ramp_time.length + k];
}
function drawSpinUp() {
  const j = speed(), all = D.spin_up.subarray(j * RAMPS * SAMPLES, (j + 1) * RAMPS * SAMPLES);
  const own = ownHistories(), widest = Object.values(own).flat().reduce((most, [, q]) => Math.max(most, Math.abs(q)), 0);
  const reach = level(1.04 * Math.max(widest, DATA.step * all.reduce((most, v) => v === DATA.unknown ? most : Math.max(most, Math.abs(v)), 0)));
  spinUp.frame([0, DATA.duration], [-reach, reach], back => {
    spinUp.ramp = node("rect", {class: "wash", x: spinUp.x0, y: spinUp.y1, height: spinUp.y0 - spinUp.y1}, back);
    node("path", {class: "zero", fill: "none", d: `M${spinUp.x0},${spinUp.y(0)}H${spinUp.x1}`}, back);
  });
  spinUp.ramp.setAttribute("width", spinUp.x(T()) - spinUp.x0);
  spinUp.draw({...state.hide.has("exact") ? {} : {exact: spinUpCurve()}, ...own});
  spinUp.mark(T(), `T = ${plain(T())}`);
  spinUp.front.replaceChildren();
  const a = exactLeft(j, state.t);
  if (Number.isFinite(a)) for (const side of [-a, a])
    node("line", {class: "cross", x1: spinUp.x(T()), x2: spinUp.x1, y1: spinUp.y(side), y2: spinUp.y(side)}, spinUp.front);
}
/** What is seen of it, in words; at any speed of the slider. */
function tellSpeed() {
  const j = speed(), a = exactLeft(j, state.t), mesh = meshLeft(j, T());
  document.getElementById("spin-up-speed").textContent = `to ${plain(D.fe_omega[j])} rad/s`;
  document.getElementById("about-spin-up").textContent = (Number.isFinite(a) ? `After the ramp (shaded) the tip swings by a = ${fixed(a, 4)}` +
    (Number.isFinite(mesh) ? `, ${DATA.elements} finite elements by ${fixed(mesh, 4)}.` : ".") : "Too violent to be computed.") +
    (Math.abs(D.fe_omega[j] - D.omega[state.w]) > 1e-9 ? ` Computed to ${[...D.fe_omega].map(plain).join(", ")} rad/s only: this is the nearest.` : "");
}
const decade = a => a > 0 ? Math.log10(a) : NaN;
function drawLeft() {
  const j = speed(), curve = D.ramp_curve, n = curve.length, last = D.exact_ramp_time[RAMPS - 1], pad = Math.max(0.03 * (last - curve[0]), 0.02 * last);
  const decades = Array.from({length: Math.floor(-LOWEST) + 1}, (_, i) => [-i, String(+(10 ** -i).toFixed(i))]);
  left.frame([curve[0] - pad, last + pad], [LOWEST, HIGHEST], null, decades);
  const points = Array.from(curve, (v, i) => [v, decade(D.closed_left[j * n + i])]);
  left.draw({closed: points});
  left.mark(T(), `T = ${plain(T())}`);
  left.front.replaceChildren();
  const within = y => Math.min(left.y0, Math.max(left.y1, left.y(y)));
  for (let t = 0; t < RAMPS; t++) {
    const y = decade(exactLeft(j, t));
    if (Number.isFinite(y)) node("circle", {class: "dot", cx: left.x(D.exact_ramp_time[t]), cy: within(y), r: t === state.t ? 5.5 : 3.5}, left.front);
  }
  if (!state.hide.has("FE")) D.ramp_time.forEach((time, k) => {
    const y = decade(D.fe_amplitude[j * D.ramp_time.length + k]);
    if (Number.isFinite(y)) node("circle", {class: "ring", cx: left.x(time), cy: within(y), r: 7}, left.front);
  });
}
/** What is known of a ramp time. */
function leftNumbers(t) {
  const j = speed(), time = D.exact_ramp_time[t], mesh = meshLeft(j, time), n = D.ramp_curve.length;
  const closed = D.closed_left[j * n + nearest(D.ramp_curve, time)];
  return [`T = ${plain(time)} s`, [["exact", "exact", fixed(exactLeft(j, t), 5)], ["closed", "closed form", fixed(closed, 5)],
    ...Number.isFinite(mesh) ? [[null, `${DATA.elements} elements`, fixed(mesh, 5)]] : []]];
}
function tellLeft(place) {
  if (!place || place[0] < left.x0 || place[0] > left.x1 + 10) return left.tell(null);
  left.tell(place, ...leftNumbers(nearest(D.exact_ramp_time, left.invertX(place[0]))));
}
left.listen(tellLeft, place => set({t: nearest(D.exact_ramp_time, left.invertX(place[0]))}));
left.step("t", D.exact_ramp_time, tellLeft, leftNumbers);
const spinUpNumbers = i => [`t = ${fixed(seconds(i), 2)} s`, [["exact", "q/L", fixed(spinUpAt(speed(), state.t, i), 4)]]];
function tellSpinUp(place) {
  spinUp.over.replaceChildren();
  if (!place || place[0] < spinUp.x0 || place[0] > spinUp.x1) return spinUp.tell(null);
  const i = Math.round(spinUp.invertX(place[0]) / DATA.duration * (SAMPLES - 1)), x = spinUp.x(seconds(i));
  node("line", {class: "cross", x1: x, x2: x, y1: spinUp.y0, y2: spinUp.y1}, spinUp.over);
  spinUp.tell(place, ...spinUpNumbers(i));
}
spinUp.listen(tellSpinUp);
spinUp.step("sample", Array.from({length: SAMPLES}, (_, i) => seconds(i)), tellSpinUp, spinUpNumbers);
const rampInput = document.getElementById("ramp");
Object.assign(rampInput, {min: 0, max: RAMPS - 1, step: 1});
rampInput.addEventListener("input", () => set({t: +rampInput.value}));
