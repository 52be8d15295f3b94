// The deflected beam, moving.

const beam = {host: document.getElementById("beam")};
beam.svg = node("svg", {role: "img", "aria-label": "The deflected beam in the rotating frame, to scale"}, beam.host);
beam.still = node("g", {}, beam.svg);
beam.ghosts = node("path", {class: "ghost"}, beam.svg);
beam.trace = node("path", {class: "trace"}, beam.svg);
beam.path = node("path", {class: "beam"}, beam.svg);
beam.tip = node("circle", {class: "dot", r: 5}, beam.svg);
beam.q = node("text", {class: "title", id: "deflection"}, beam.svg);
/** A smooth path through points, Catmull and Rom's. */
function smooth(points) {
  if (!points.every(([x]) => Number.isFinite(x))) return "";
  let d = `M${points[0][0].toFixed(1)},${points[0][1].toFixed(1)}`;
  for (let i = 0; i + 1 < points.length; i++) {
    const [p, q, r, s] = [points[Math.max(0, i - 1)], points[i], points[i + 1], points[Math.min(points.length - 1, i + 2)]];
    d += `C${(q[0] + (r[0] - p[0]) / 6).toFixed(1)},${(q[1] + (r[1] - p[1]) / 6).toFixed(1)},` +
      `${(r[0] - (s[0] - q[0]) / 6).toFixed(1)},${(r[1] - (s[1] - q[1]) / 6).toFixed(1)},${r[0].toFixed(1)},${r[1].toFixed(1)}`;
  }
  return d;
}
const placed = points => points.map(([x, y]) => [beam.x0 + beam.scale * x, beam.y0 - beam.scale * y]);
function drawBeam() {
  const width = beam.host.clientWidth, height = beam.host.clientHeight, {w, a: i} = state;
  const reach = Math.max(0.25, level(1.04 * D.a[i]));
  beam.scale = Math.min((width - 74) / 1.02, (height - 44) / (2 * reach));
  beam.x0 = Math.max(40, (width - beam.scale) / 2 - 6); beam.y0 = height / 2 - 6;
  const {x0, y0, scale} = beam;
  let ghosts = "", trace = "M";
  for (let k = 0; k < 12; k++) ghosts += smooth(placed(beamAxis(w, i, 2 * Math.PI * k / 12)));
  for (let k = 0; k <= 60; k++) {
    const [[x, y]] = placed(beamAxis(w, i, 2 * Math.PI * k / 60, LAST));
    trace += (k ? "L" : "") + x.toFixed(1) + "," + y.toFixed(1);
  }
  beam.ghosts.setAttribute("d", ghosts);
  beam.trace.setAttribute("d", trace.includes("NaN") ? "" : trace);
  const period = 2 * Math.PI / exactFrequency(w, i);
  document.getElementById("period").textContent = `Rotating frame, to scale; period ${fixed(period, 3)} s.`;
  moveBeam();
  const key = [width, height, scale].join();
  if (beam.key === key) return;
  beam.key = key;
  beam.still.replaceChildren();
  node("line", {class: "zero", x1: x0, x2: x0 + scale, y1: y0, y2: y0}, beam.still);
  // the clamp, and the sense of rotation
  node("line", {class: "axis", x1: x0, x2: x0, y1: y0 - 16, y2: y0 + 16, "stroke-width": 2}, beam.still);
  for (let k = 0; k < 4; k++) node("line", {class: "axis", x1: x0, x2: x0 - 7, y1: y0 - 12 + 9 * k, y2: y0 - 6 + 9 * k}, beam.still);
  node("path", {class: "axis", fill: "none", "stroke-width": 1.4, d: `M${x0 - 18},${y0 + 22}A26,26 0 0 0 ${x0 + 14},${y0 + 24}`}, beam.still);
  node("path", {class: "axis", fill: "none", "stroke-width": 1.4, d: `M${x0 + 7},${y0 + 23}L${x0 + 14},${y0 + 24}L${x0 + 12},${y0 + 31}`}, beam.still);
  node("text", {x: x0 - 8, y: y0 + 44}, beam.still, "ω");
  // a bar for the scale
  node("path", {class: "axis", fill: "none", d: `M${x0},${height - 12}v6h${scale / 5}v-6`}, beam.still);
  node("text", {x: x0 + scale / 5 + 6, y: height - 4}, beam.still, "0.2 L");
}
function moveBeam() {
  const points = placed(beamAxis(state.w, state.a, state.phase)), tip = points.at(-1);
  beam.path.setAttribute("d", smooth(points));
  place(beam.tip, ...tip);
  beam.q.setAttribute("x", beam.x0 + beam.scale * 0.42); beam.q.setAttribute("y", 14);
  beam.q.textContent = `q = ${fixed(exactState(state.w, state.a, state.phase)[0], 3)} L`;
}
const phaseInput = document.getElementById("phase"), play = document.getElementById("play");
function showPhase() {
  const degrees = Math.round(state.phase * 180 / Math.PI) % 360;
  phaseInput.value = degrees;
  document.getElementById("phase-value").textContent = degrees + "°";
  drawDot(); moveBeam();
}
function showPlaying() { play.textContent = state.playing ? "Pause" : "Play"; }
let last = 0;
function tick(now) {
  if (state.playing) {
    state.phase = (state.phase + Math.min(now - last, 100) / 1000 * (exactFrequency(state.w, state.a) || 0)) % (2 * Math.PI);
    if (state.view === "simple") turn(Math.min(now - last, 100) / 1000);
    else showPhase();
    last = now;
    requestAnimationFrame(tick);
  }
}
function start() { last = performance.now(); requestAnimationFrame(tick); }
play.addEventListener("click", () => { state.playing = !state.playing; showPlaying(); if (state.playing) start(); });
phaseInput.addEventListener("input", () => { state.playing = false; showPlaying(); state.phase = phaseInput.value * Math.PI / 180; showPhase(); });
