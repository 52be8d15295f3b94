// Controls, and what is drawn when.

const omegaInput = document.getElementById("omega"), amplitudeInput = document.getElementById("amplitude");
Object.assign(omegaInput, {min: 0, max: W - 1, step: 1});
Object.assign(amplitudeInput, {min: 0, max: A - 1, step: 1});
omegaInput.addEventListener("input", () => set({w: +omegaInput.value}));
amplitudeInput.addEventListener("input", () => set({a: +amplitudeInput.value}));
for (const v of D.fe_omega) {
  const jump = Object.assign(document.createElement("button"), {textContent: plain(v), title: `ω = ${plain(v)} rad/s`});
  jump.dataset.omega = v;
  jump.addEventListener("click", () => set({w: nearest(D.omega, v)}));
  document.getElementById("jumps").append(jump);
}
for (const key of ["scale", "norm"])
  for (const button of document.querySelectorAll(`[data-${key}]`))
    button.addEventListener("click", () => set({[key]: button.dataset[key]}));
document.getElementById("blade").textContent = DATA.blade;
document.getElementById("mesh").textContent = `Finite elements: ${DATA.elements} cables in Exudyn, spun up in ` +
  `${Math.min(...D.ramp_time)} to ${Math.max(...D.ramp_time)} s, over the mesh's own natural frequency.`;

function showControls() {
  const omega = fixed(D.omega[state.w], 2) + " rad/s", amplitude = fixed(D.a[state.a], 2);
  omegaInput.value = state.w; amplitudeInput.value = state.a;
  omegaInput.setAttribute("aria-valuetext", omega); amplitudeInput.setAttribute("aria-valuetext", amplitude);
  document.getElementById("omega-value").textContent = omega;
  document.getElementById("amplitude-value").textContent = amplitude;
  rampInput.value = state.t; rampInput.setAttribute("aria-valuetext", `${plain(T())} s`);
  document.getElementById("ramp-value").textContent = `${plain(T())} s`;
  for (const button of document.querySelectorAll("#jumps button")) button.setAttribute("aria-pressed", Math.abs(button.dataset.omega - D.omega[state.w]) < 1e-9);
  for (const key of ["scale", "norm", "view"])
    for (const button of document.querySelectorAll(`button[data-${key}]`)) button.setAttribute("aria-pressed", button.dataset[key] === state[key]);
}
// Beside the charts where there is room, else below; on a phone the table is folded above them. Tab follows what is seen.
const wide = matchMedia("(min-width: 1181px)"), phone = matchMedia("(max-width: 700px)");
const numbers = document.querySelector(".numbers"), words = document.querySelector(".words"), aside = document.querySelector(".side"), main = document.querySelector("main");
function arrange() {
  (wide.matches || phone.matches ? aside : main).append(numbers);
  (wide.matches ? aside : main).append(words);
  numbers.open = !phone.matches;
}
for (const width of [wide, phone]) width.addEventListener("change", arrange);
arrange();
// On paper everything is open, on white, and drawings scale to the sheet.
let folded = [];
window.addEventListener("beforeprint", () => {
  document.documentElement.classList.add("printing");
  for (const plot of document.querySelectorAll(".plot")) plot.firstElementChild.setAttribute("viewBox", `0 0 ${plot.clientWidth} ${plot.clientHeight}`);
  folded = [...document.querySelectorAll(".numbers, .letters")].filter(e => !e.open);
  for (const e of folded) e.open = true;
});
window.addEventListener("afterprint", () => {
  document.documentElement.classList.remove("printing");
  for (const plot of document.querySelectorAll(".plot")) plot.firstElementChild.removeAttribute("viewBox");
  for (const e of folded) e.open = false;
});
function drawAll() {
  showControls(); showNumbers(); drawBackbone(); drawOrbit(); drawSoftening(); markSpeed(); drawBeam(); showPhase(); drawSpinUp(); drawLeft(); tellSpeed(); showView(); drawTurning();
}
let waiting = false, changed = new Set(), spun = -1;
/** Change the state; what depends on it is drawn once, in the next frame. */
function set(change) {
  for (const [key, value] of Object.entries(change)) if (state[key] !== value) { state[key] = value; changed.add(key); }
  if (!changed.size) return;
  showControls(); showNumbers(); remember();
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    const any = (...keys) => keys.some(key => changed.has(key));
    if (state.view === "expert") {  // what is hidden is drawn when it gets its size
      if (any("w", "a", "hide", "scale", "norm")) drawBackbone();
      if (any("w", "a", "hide")) drawOrbit();
      if (any("scale", "hide")) drawSoftening();
      if (any("w", "hide", "scale")) markSpeed();
      if (any("w", "a")) drawBeam();
    }
    if (any("t", "hide") || spun !== speed()) { drawSpinUp(); drawLeft(); }
    if (any("w", "t", "hide")) tellSpeed();
    if (any("w", "t", "view")) showView();
    if (any("w", "a")) drawTurning();
    spun = speed();
    changed.clear();
    waiting = false;
  });
}
window.addEventListener("hashchange", () => { restore(); drawAll(); });
const resized = new ResizeObserver(() => { if (!document.documentElement.classList.contains("printing")) drawAll(); });
for (const plot of document.querySelectorAll(".plot")) resized.observe(plot);
restore();
makeRows();
drawAll();
showPlaying();
if (state.playing) start();
document.documentElement.dataset.ready = performance.now().toFixed(0);
