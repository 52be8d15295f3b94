// The numbers at the present speed and amplitude.

const rows = {};
function makeRows() {
  const body = document.getElementById("rows");
  for (const m of [...ORDER, "FE"]) {
    const row = document.createElement("tr"), head = document.createElement("th"), label = document.createElement("label");
    const box = Object.assign(document.createElement("input"), {type: "checkbox"}), text = document.createElement("span");
    const swatch = node("svg", {width: 21, height: 10, style: colors(m)});
    if (m === "FE") node("circle", {class: "point", cx: 10.5, cy: 5, r: 3.6}, swatch);
    else node("line", {class: m === "exact" ? "curve exact" : "curve", x1: 0, x2: 21, y1: 5, y2: 5, "stroke-dasharray": dashes(m)}, swatch);
    text.textContent = m === "FE" ? "finite elements, points only" : m;
    row.dataset.model = m; head.scope = "row";
    if (m in ABOUT)
      for (const [tag, words] of [["dt", m], ["dd", ABOUT[m]]]) document.getElementById("letters").append(Object.assign(document.createElement(tag), {textContent: words}));
    label.append(box, swatch, text); head.append(label); row.append(head);
    if (m === "FE") head.colSpan = 6;
    else for (const name of ["linear", "linear-error", "lambda", "frequency", "shift-error"]) row.append(Object.assign(document.createElement("td"), {className: name}));
    box.addEventListener("change", () => {
      const hide = new Set(state.hide);
      if (box.checked) hide.delete(m); else hide.add(m);
      set({hide});
    });
    body.append(row);
    rows[m] = {row, box, cells: [...row.querySelectorAll("td")]};
  }
}
/** A difference in percent, with its sign. */
const percent = x => (x > 5e-6 ? "+" : "") + fixed(100 * x, 3);
/** Errors of ω_n and of the shift ω_NL/ω_n - 1, whose sum is that of ω_NL to first order: in the sum two errors may cancel. */
const linearError = (m, w) => linear(m, w) / linear("exact", w) - 1;
const shiftError = (m, w, a) => frequency(m, w, a) / linear(m, w) - exactFrequency(w, a) / linear("exact", w);
let saying = 0;
function showNumbers() {
  const {w, a} = state;
  for (const [m, {row, box, cells}] of Object.entries(rows)) {
    box.checked = !state.hide.has(m);
    row.classList.toggle("off", !box.checked);
    if (m === "FE") continue;
    const errors = m === "exact" ? ["", ""] : [percent(linearError(m, w)), percent(shiftError(m, w, a))];
    [fixed(linear(m, w), 4), errors[0], fixed(lambda(m, w), 5), fixed(frequency(m, w, a), 4), errors[1]].forEach((text, i) => { cells[i].textContent = text; });
  }
  const at = `ω = ${fixed(D.omega[w], 2)} rad/s, a = ${fixed(D.a[a], 2)}`;
  document.getElementById("state").textContent = at;
  clearTimeout(saying);  // at rest only, for those who listen
  saying = setTimeout(() => {
    document.getElementById("said").textContent = `${at}: exact ω_n ${fixed(linear("exact", w), 4)} rad/s, λ_ω ${fixed(lambda("exact", w), 5)}, ` +
      `ω_NL ${fixed(exactFrequency(w, a), 4)} rad/s`;
  }, 500);
  const warnings = [];
  if (D.a[a] > PAPER_BOUND + 1e-9) warnings.push(`a > ${PAPER_BOUND}, beyond the paper's own bound for the reduced models.`);
  if (D.omega[w] > 2 * D.exact_omega_n[w]) warnings.push("ω is above twice the natural frequency, where models of one mode are beyond their range.");
  const from = /from a = ([\d.]+)/.exec(DATA.notes[w]);
  if (from && D.a[a] > +from[1] - 1e-9) warnings.push("Exact orbit, " + DATA.notes[w] + ".");
  if (!Number.isFinite(exactFrequency(w, a))) warnings.push("No exact orbit was found at this amplitude.");
  const text = warnings.join(" "), place = document.getElementById("warning");
  if (place.textContent !== text) place.textContent = text;
}
