// The numbers at the present speed and amplitude.

const rows = {};
function makeRows() {
  const body = document.getElementById("rows");
  for (const m of [...ORDER, "FE"]) {
    const row = document.createElement("tr"), head = document.createElement("th"), label = document.createElement("label");
    const box = Object.assign(document.createElement("input"), {type: "checkbox"}), text = document.createElement("span");
    const swatch = node("svg", {width: 24, height: 10, style: colors(m)});
    if (m === "FE") node("circle", {class: "point", cx: 12, cy: 5, r: 3.6}, swatch);
    else node("line", {class: m === "exact" ? "curve exact" : "curve", x1: 0, x2: 24, y1: 5, y2: 5, "stroke-dasharray": dashes(m)}, swatch);
    text.textContent = m === "FE" ? "finite elements, points only" : m;
    row.title = ABOUT[m] ?? ""; row.dataset.model = m; head.scope = "row";
    label.append(box, swatch, text); head.append(label); row.append(head);
    if (m === "FE") head.colSpan = 5;
    else for (const name of ["linear", "lambda", "frequency", "error"]) row.append(Object.assign(document.createElement("td"), {className: name}));
    box.addEventListener("change", () => {
      const hide = new Set(state.hide);
      if (box.checked) hide.delete(m); else hide.add(m);
      set({hide});
    });
    body.append(row);
    rows[m] = {row, box, cells: [...row.querySelectorAll("td")]};
  }
}
function showNumbers() {
  const {w, a} = state, truth = exactFrequency(w, a);
  for (const [m, {row, box, cells}] of Object.entries(rows)) {
    box.checked = !state.hide.has(m);
    row.classList.toggle("off", !box.checked);
    if (m === "FE") continue;
    const f = frequency(m, w, a);
    cells[0].textContent = fixed(linear(m, w), 4);
    cells[1].textContent = fixed(lambda(m, w), 5);
    cells[2].textContent = fixed(f, 4);
    const error = 100 * (f / truth - 1);
    cells[3].textContent = m === "exact" ? "" : (error > 0.0005 ? "+" : "") + fixed(error, 3);
  }
  const warnings = [];
  if (D.a[a] > PAPER_BOUND + 1e-9) warnings.push(`a > ${PAPER_BOUND}, beyond the paper's own bound for the reduced models.`);
  if (D.omega[w] > 2 * D.exact_omega_n[w]) warnings.push("ω is above twice the natural frequency, where models of one mode are beyond their range.");
  const from = /from a = ([\d.]+)/.exec(DATA.notes[w]);
  if (from && D.a[a] > +from[1] - 1e-9) warnings.push("Exact orbit, " + DATA.notes[w] + ".");
  const text = warnings.join(" "), place = document.getElementById("warning");
  if (place.textContent !== text) place.textContent = text;
}
