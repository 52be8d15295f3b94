// The tip's orbits in phase space.

const orbit = new Chart("orbit", {x: "x = q/L", y: "dx/dτ", margin: {left: 44, right: 20, top: 28, bottom: 36}, label: "Orbit of the tip in phase space, one curve per model"});
const LEVELS = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 8];
const level = v => LEVELS.find(l => l >= v) ?? 10;
let orbits = {}, speeds = "";
const TURN = 120;
function drawOrbit() {
  const {w, a: i} = state;
  let fastest = 1.02 * D.a[i] * linear("exact", w) / DATA.frequencyScale;
  orbits = {};
  for (const m of shown()) {
    const points = orbits[m] = [];
    for (let k = 0; k <= TURN; k++) {
      const phase = 2 * Math.PI * k / TURN;
      points.push(m === "exact" ? exactState(w, i, phase) : modelState(m, w, i, phase - Math.PI / 2));  // all straight at phase 0
      if (points[k][1] > fastest) fastest = points[k][1];
    }
  }
  const largest = m => Math.max(...orbits[m].map(p => p[1]));
  speeds = shown().filter(m => Number.isFinite(largest(m))).map(m => `${m} ${fixed(largest(m), 3)}`).join(", ");
  const reach = level(1.04 * D.a[i]), rate = level(1.04 * fastest);
  orbit.frame([-reach, reach], [-rate, rate], back => {
    node("path", {class: "zero", fill: "none", d: `M${orbit.x0},${orbit.y(0)}H${orbit.x1}M${orbit.x(0)},${orbit.y0}V${orbit.y1}`}, back);
  });
  orbit.draw(orbits);
  drawDot();
}
let dot = null;
function drawDot() {
  if (!dot) dot = node("circle", {class: "dot", r: 5}, orbit.front);
  const [x, v] = exactState(state.w, state.a, state.phase);
  place(dot, orbit.x(x), orbit.y(v));
  document.getElementById("about-orbit").textContent = `● exact, x = ${fixed(x, 3)}, dx/dτ = ${fixed(v, 3)}, at the phase of the beam.` + (speeds && ` Largest dx/dτ: ${speeds}.`);
}
orbit.listen(place => {
  orbit.over.replaceChildren();
  if (!place) return orbit.tell(null);
  let best = null;
  for (const m of shown()) for (const p of orbits[m]) {
    if (!Number.isFinite(p[0])) continue;
    const distance = Math.hypot(orbit.x(p[0]) - place[0], orbit.y(p[1]) - place[1]);
    if (!best || distance < best.distance - 1e-9) best = {m, p, distance};
  }
  if (!best || best.distance > 28) return orbit.tell(null);
  const {m, p: [x, v]} = best, px = orbit.x(x), py = orbit.y(v);
  node("path", {class: "cross", fill: "none", d: `M${orbit.x0},${py}H${px}V${orbit.y0}`}, orbit.over);
  node("circle", {r: 4, style: colors(m), fill: stroke(m)}, orbit.over).setAttribute("transform", `translate(${px},${py})`);
  orbit.tell(place, m, [[null, "x", fixed(x, 4)], [null, "dx/dτ", fixed(v, 4)]]);
});
