// What the person has chosen; the address keeps it.

// In the middle of what there is: for the paper's beam 6 rad/s, in 3 s.
const START = {w: nearest(D.omega, D.fe_omega[nearest(D.fe_omega, FASTEST / 2)]), a: nearest(D.a, 0.3), t: nearest(D.exact_ramp_time, [...D.ramp_time].sort((p, q) => p - q)[D.ramp_time.length >> 1]), scale: "close", norm: "own", view: "simple", hide: new Set(["P3", "P4", "P5"])};
const state = {...START, hide: new Set(START.hide), phase: Math.PI / 3, sample: 0, playing: !matchMedia("(prefers-reduced-motion: reduce)").matches};
function nearest(grid, value) {
  let best = 0;
  for (let i = 1; i < grid.length; i++) if (Math.abs(grid[i] - value) < Math.abs(grid[best] - value)) best = i;
  return best;
}
const shown = () => ORDER.filter(m => !state.hide.has(m));
function hash() {
  return "#" + new URLSearchParams({omega: plain(D.omega[state.w]), a: plain(D.a[state.a]), T: plain(D.exact_ramp_time[state.t]), scale: state.scale, norm: state.norm, view: state.view,
    hide: ORDER.concat("FE").filter(m => state.hide.has(m)).join(".")});
}
function restore() {
  const given = new URLSearchParams(location.hash.slice(1));
  const number = (key, grid, otherwise) => {
    const value = parseFloat(given.get(key));
    return Number.isFinite(value) ? nearest(grid, value) : otherwise;
  };
  // A link to certain charts shows them; with nothing said, a slow turn that both beams survive.
  state.view = ["simple", "expert"].includes(given.get("view")) ? given.get("view") : [...given].length ? "expert" : "simple";
  state.w = number("omega", D.omega, state.view === "simple" ? nearest(D.omega, 0.7 * D.exact_omega_n[0]) : START.w);
  state.a = number("a", D.a, START.a);
  state.t = number("T", D.exact_ramp_time, START.t);
  state.scale = ["close", "all"].includes(given.get("scale")) ? given.get("scale") : START.scale;
  state.norm = ["own", "exact"].includes(given.get("norm")) ? given.get("norm") : START.norm;
  state.hide = given.has("hide") ? new Set(given.get("hide").split(".").filter(m => ORDER.includes(m) || m === "FE")) : new Set(START.hide);
}
let remembering = 0;
function remember() {  // not at every step of a slider: browsers limit how often the address may change
  document.getElementById("link").href = hash();
  clearTimeout(remembering);
  remembering = setTimeout(() => { try { history.replaceState(null, "", hash()); } catch { /* a sandboxed frame */ } }, 150);
}
