// A person's own table of (a, omega_NL) or of (t, q): read, or refused in one sentence. Nothing leaves the page.

/** What a column may be called, here or by `rotbeam backbone`, and its units as multiples of ours: |q|/L, rad/s, s, q/L. */
const LENGTHS = {m: 1 / DATA.length, mm: 1e-3 / DATA.length}, OF_LENGTH = {"": 1, "-": 1, "1": 1, l: 1};
const SPEEDS = {"": 1, "rad/s": 1, hz: 2 * Math.PI, "1/s": 1};
const COLUMN = {
  a: {names: ["a", "amplitude", "a/l", "amplitude a/l", "|q|/l"], units: {...OF_LENGTH, ...LENGTHS}},
  omega_NL: {names: ["omega_nl", "ω_nl", "frequency", "omega_nl exact", "eq. 41 exactly", "exact beam"], units: SPEEDS},
  omega: {names: ["omega", "ω", "speed"], units: SPEEDS},
  omega_n: {names: ["omega_n", "ω_n"], units: SPEEDS},
  t: {names: ["t", "time"], units: {"": 1, s: 1, ms: 1e-3}},
  q: {names: ["q"], units: {"": LENGTHS.m, ...LENGTHS, l: 1, "-": 1, "1": 1}},
  "q/L": {names: ["q/l"], units: OF_LENGTH},
};
const MOST_BYTES = 50e6, WIDEST = 3, MOST_NAMES = 8;
const cut = text => text.length > 40 ? text.slice(0, 39) + "…" : text;

class Refused extends Error {}
const refuse = sentence => { throw new Refused(sentence); };

/** Split a row at its commas, semicolons or tabs; quotes may hold them. */
function cellsOf(line, separator) {
  const cells = [];
  let cell = "", quotes = false;
  for (const c of line) {
    if (c === '"') quotes = !quotes;
    else if (c === separator && !quotes) { cells.push(cell.trim()); cell = ""; }
    else cell += c;
  }
  return [...cells, cell.trim()];
}
/** Which known column a heading is, and what its unit is in ours. */
function columnOf(heading) {
  const [, name, inSquare, inRound] = /^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))?$/.exec(heading);
  const [key, known] = Object.entries(COLUMN).find(([, {names}]) => names.includes(name.trim().toLowerCase())) ?? [];
  if (!key) return null;
  const unit = (inSquare ?? inRound ?? "").trim();
  if (!Object.hasOwn(known.units, unit.toLowerCase()))
    refuse(`column "${heading}" is in "${unit}": give it in ${Object.keys(known.units).filter(u => u && !["-", "1", "1/s"].includes(u)).map(u => ({l: "L", hz: "Hz"})[u] ?? u).join(" or ")}`);
  return {key, heading, scale: known.units[unit.toLowerCase()]};
}
/** Read a table: its rows [values by column], in our units. */
function readTable(text) {
  if (/[\0\ufffd]/.test(text)) refuse("it is no text: export the table as CSV");
  const lines = text.split(/\r\n?|\n/).map((line, i) => [line, i + 1]).filter(([line]) => line.trim() && !line.startsWith("#"));
  if (!lines.length) refuse("it is empty: give a row of column names and rows of numbers");
  const head = lines[0][0], separator = [",", ";", "\t"].reduce((best, c) => head.split(c).length > head.split(best).length ? c : best);
  const headings = cellsOf(head, separator), columns = headings.map(columnOf), has = key => columns.some(c => c?.key === key);
  const wanted = has("a") && has("omega_NL") ? ["a", "omega_NL", "omega", "omega_n"] : has("t") && (has("q/L") || has("q")) ? ["t", has("q/L") ? "q/L" : "q"]
    : refuse(`its columns are ${headings.slice(0, MOST_NAMES).map(h => `"${cut(h)}"`).join(", ")}${headings.length > MOST_NAMES ? ` and ${headings.length - MOST_NAMES} more` : ""}: ` +
      `name them a and omega_NL, or t and q (or q/L)${headings.length > 1 ? "" : ", with commas between"}`);
  const first = columns.find(c => c?.key === "omega_NL");  // a model's frequency, and behind it the exact one, is no doubt
  const used = columns.flatMap((c, i) => c && wanted.includes(c.key) && (c.key !== "omega_NL" || c === first || c.heading === first.heading) ? [{...c, i}] : []);
  for (const {key} of used) if (used.filter(c => c.key === key).length > 1) refuse(`more than one column is ${key}: keep one`);
  const rows = [];
  let without = 0;
  for (const [line, number] of lines.slice(1)) {
    const cells = cellsOf(line, separator);
    if (used.every(({i}) => !cells[i])) continue;
    if (used.some(({i}) => cells[i]?.toLowerCase() === "nan")) { without++; continue; }  // there is no answer
    const row = {line: number};
    for (const {key, heading, scale, i} of used) {
      const value = cells[i] ? Number(cells[i]) : NaN;
      if (!Number.isFinite(value)) refuse(`line ${number} has "${cut(cells[i] ?? "")}" under "${heading}", which is no number: write it with a decimal point`);
      row[key] = scale * value;
    }
    rows.push(row);
  }
  if (!rows.length) refuse("it has column names and no row of numbers");
  return {rows, kind: wanted[0] === "a" ? "points" : "history", headings: used.map(c => c.heading), without};
}
/** Refuse what cannot be meant. */
function checked({rows, kind, headings, without}) {
  if (kind === "history" && rows.length < 2) refuse("it has one row of numbers: a line needs two");
  rows.forEach((row, i) => {
    if (kind === "points") {
      if (row.a < 0) refuse(`line ${row.line}: a = ${row.a} is negative: a is the peak of |q|/L`);
      if (!(row.omega_NL > 0)) refuse(`line ${row.line}: omega_NL = ${row.omega_NL} rad/s is not positive`);
      if (row.omega_n !== undefined && !(row.omega_n > 0)) refuse(`line ${row.line}: omega_n = ${row.omega_n} rad/s is not positive`);
    } else if (i && row.t <= rows[i - 1].t) refuse(`line ${row.line}: the time goes from ${rows[i - 1].t} to ${row.t} s: sort the rows by time`);
  });
  const key = kind === "points" ? "a" : "q" in rows[0] ? "q" : "q/L", most = rows.reduce((m, row) => Math.max(m, Math.abs(row[key])), 0);
  const heading = headings.find(h => columnOf(h).key === key);
  if (most > WIDEST) refuse(`"${heading}" reaches ${+most.toPrecision(3)} times the length of the beam: name its unit, ${key}${key === "q/L" ? " or q [m]" : " [m] or [mm]"}`);
  return {rows, kind, headings, key, without};
}
