// A chart of one curve per model, with names, marks and a box that tells numbers.

const LETTERS = 15;  // pixels from one line of words to the next

class Chart {
  constructor(id, {x, y, margin = {left: 52, right: 50, top: 28, bottom: 36}, label}) {
    this.host = document.getElementById(id);
    this.svg = node("svg", {role: "img", "aria-label": label}, this.host);
    this.clip = node("rect", {}, node("clipPath", {id: id + "-clip"}, node("defs", {}, this.svg)));
    const layer = clipped => node("g", clipped ? {"clip-path": `url(#${id}-clip)`} : {}, this.svg);
    this.back = layer(); this.curves = layer(true); this.front = layer(true); this.labels = layer(); this.marks = layer(); this.over = layer(true);
    this.readout = document.createElement("div");
    this.readout.className = "readout";
    this.host.append(this.readout);
    this.names = {x, y}; this.margin = margin; this.paths = {}; this.key = "";
  }
  /** Measure, and redraw the axes if anything about them is new. */
  frame(xDomain, yDomain, decorate, yTicks = null) {
    const {left, right, top, bottom} = this.margin;
    const width = Math.max(left + right + 1, this.host.clientWidth), height = Math.max(top + bottom + 1, this.host.clientHeight);  // hidden, it has none
    const key = JSON.stringify([width, height, xDomain, yDomain]);
    if (key === this.key) return false;
    this.key = key;
    Object.assign(this, {width, height, xDomain, yDomain, x0: left, x1: width - right, y0: height - bottom, y1: top});
    for (const [n, v] of Object.entries({x: this.x0, y: this.y1, width: this.x1 - this.x0, height: this.y0 - this.y1}))
      this.clip.setAttribute(n, v);
    this.back.replaceChildren();
    if (decorate) decorate(this.back);
    for (const [v, text] of ticks(...xDomain, this.x1 - this.x0, 58)) {
      const x = this.x(v);
      node("line", {class: "grid", x1: x, x2: x, y1: this.y0, y2: this.y1}, this.back);
      node("text", {class: "along", x, y: this.y0 + 16, "text-anchor": "middle"}, this.back, text);
    }
    for (const [v, text] of yTicks ?? ticks(...yDomain, this.y0 - this.y1, 42)) {
      const y = this.y(v);
      node("line", {class: "grid", x1: this.x0, x2: this.x1, y1: y, y2: y}, this.back);
      node("text", {x: this.x0 - 6, y: y + 4, "text-anchor": "end"}, this.back, text);
    }
    node("path", {class: "axis", fill: "none", d: `M${this.x0},${this.y1}V${this.y0}H${this.x1}`}, this.back);
    node("text", {class: "title", x: this.x1, y: this.y0 + 31, "text-anchor": "end"}, this.back, this.names.x);
    this.yTitle = node("text", {class: "title", x: 2, y: 13}, this.back);
    write(this.yTitle, this.names.y);
    return true;
  }
  x(v) { return this.x0 + (v - this.xDomain[0]) / (this.xDomain[1] - this.xDomain[0]) * (this.x1 - this.x0); }
  y(v) { return this.y0 - (v - this.yDomain[0]) / (this.yDomain[1] - this.yDomain[0]) * (this.y0 - this.y1); }
  invertX(px) { return this.xDomain[0] + (px - this.x0) / (this.x1 - this.x0) * (this.xDomain[1] - this.xDomain[0]); }
  inside(y) { return y >= this.yDomain[0] && y <= this.yDomain[1]; }
  /** Draw one curve per model from [x, y] values; the exact one above others, own ones above it. */
  draw(curves) {
    for (const m of Object.keys(this.paths)) if (!(m in curves)) { this.paths[m].remove(); delete this.paths[m]; }
    const order = [...Object.keys(curves).filter(m => !ORDER.includes(m)), ...ORDER];
    for (const m of [...order].reverse()) {
      if (!(m in curves)) continue;
      let path = this.paths[m];
      if (!path) {
        path = this.paths[m] = node("path", {class: m === "exact" ? "curve exact" : "curve", "data-model": m, style: colors(m), "stroke-dasharray": dashes(m)});
        const above = order.slice(0, order.indexOf(m)).reverse().find(o => this.paths[o]);
        this.curves.insertBefore(path, above ? this.paths[above] : null);
      }
      path.setAttribute("d", this.line(curves[m]));
    }
  }
  /** The path through [x, y] values, interrupted where there is none. */
  line(points) {
    let d = "", pen = "M";
    for (const [x, y] of points) {
      if (!Number.isFinite(y)) { pen = "M"; continue; }
      d += pen + this.x(x).toFixed(2) + "," + Math.max(-9999, Math.min(9999, this.y(y))).toFixed(2);
      pen = "L";
    }
    return d;
  }
  /** Name each curve where it ends or leaves the frame. */
  name(curves) {
    this.labels.replaceChildren();
    const right = [], edge = [];
    for (const m of ORDER) {
      const ends = (curves[m] ?? []).filter(p => Number.isFinite(p[1])), last = ends.at(-1);
      if (!last) continue;
      if (this.inside(last[1])) right.push({m, at: this.y(last[1]), x: this.x(last[0])});
      else edge.push({m, up: last[1] > this.yDomain[1], x: this.x(this.#leaves(ends))});
    }
    right.sort((p, q) => p.at - q.at);
    spread(right.map(p => p.at), LETTERS, this.y1 + 4, this.y0 - 4).forEach((y, i) => {
      const {m, at, x} = right[i];
      if (Math.abs(y - at) > 2 || x < this.x1 - 2) node("path", {class: "leader", fill: "none", style: colors(m), d: `M${x + 1},${at}L${this.x1 + 8},${y}`}, this.labels);
      node("text", {class: "name", style: colors(m), x: this.x1 + 10, y: y + 4}, this.labels, m);
    });
    const taken = [];
    for (const {m, up, x} of edge.sort((p, q) => p.x - q.x)) {
      const text = node("text", {class: "name halo", style: colors(m)}, this.labels, m + (up ? " ↑" : " ↓"));
      const width = widthOf(text), left = Math.max(this.x0 + 3, Math.min(x + 5, this.x1 - 3 - width));
      let row = 0;
      while (taken.some(t => t.up === up && t.row === row && left < t.end)) row++;
      taken.push({up, row, end: left + width + 4});
      text.setAttribute("x", left);
      text.setAttribute("y", up ? this.y1 + 12 + LETTERS * row : this.y0 - 6 - LETTERS * row);
    }
  }
  /** Where a curve whose end is not in the frame has left it. */
  #leaves(ends) {
    let j = ends.length - 1;
    while (j > 0 && !this.inside(ends[j - 1][1])) j--;
    if (j === 0) return ends[0][0];
    const [p, q] = [ends[j - 1], ends[j]], bound = this.yDomain[q[1] > this.yDomain[1] ? 1 : 0];
    return p[0] + (bound - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
  }
  /** Rule a line at a value of the x-axis, and say it there in place of the ticks it would cover. */
  mark(value, label) {
    this.marks.replaceChildren();
    if (this.said) this.said();
    const x = this.x(value);
    node("line", {class: "now", x1: x, x2: x, y1: this.y0 + 4, y2: this.y1}, this.marks);
    const text = node("text", {class: "here", y: this.y0 + 16, "text-anchor": "middle"}, this.marks, label), half = widthOf(text) / 2;
    const at = Math.max(this.x0 + half - 20, Math.min(this.width - half, x));
    text.setAttribute("x", at);
    for (const tick of this.back.querySelectorAll(".along")) {
      const covered = Math.abs(tick.getAttribute("x") - at) < half + widthOf(tick) / 2 + 6;
      tick.setAttribute("visibility", covered ? "hidden" : "visible");
    }
  }
  /** Report the pointer, in pixels of the plot; null when it has left. */
  listen(move, pick) {
    const at = event => { const box = this.svg.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    this.svg.addEventListener("pointermove", e => { move(at(e)); if (pick && e.buttons & 1) pick(at(e)); });
    this.svg.addEventListener("pointerdown", e => { move(at(e)); if (pick && e.pointerType !== "touch") pick(at(e)); });
    if (pick) this.svg.addEventListener("click", e => pick(at(e)));
    this.svg.addEventListener("pointerleave", e => { if (e.pointerType !== "touch") move(null); });  // a finger lifted leaves the numbers
    document.addEventListener("pointerdown", e => { if (!this.host.contains(e.target)) move(null); });
  }
  /** Let Tab reach the chart, and arrows move `key` of the state over a grid; `move` shows the numbers, `tells` says them. */
  step(key, grid, move, tells) {
    const steps = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10, Home: -Infinity, End: Infinity};
    const show = () => move([this.x(grid[state[key]]), (this.y0 + this.y1) / 2]);
    for (const [n, v] of Object.entries({tabindex: 0, role: "slider", "aria-label": `${this.svg.getAttribute("aria-label")}; arrow keys move the mark`, "aria-valuemin": 0, "aria-valuemax": grid.length - 1}))
      this.svg.setAttribute(n, v);
    this.svg.addEventListener("focus", () => { if (this.svg.matches(":focus-visible")) show(); });
    this.svg.addEventListener("blur", () => move(null));
    this.svg.addEventListener("keydown", e => {
      if (!(e.key in steps) || e.ctrlKey || e.altKey || e.metaKey) return;
      e.preventDefault();
      set({[key]: Math.max(0, Math.min(grid.length - 1, state[key] + steps[e.key]))});
      show(); this.said();
    });
    this.said = () => {
      this.svg.setAttribute("aria-valuenow", state[key]);
      const [title, lines] = tells(state[key]);
      this.svg.setAttribute("aria-valuetext", [title, ...lines.map(([, left, right]) => `${left} ${right}`)].join(", "));
    };
  }
  /** Show a box of lines [model or null, text, text] beside a place. */
  tell(place, title, lines) {
    this.readout.style.display = place ? "block" : "none";
    if (!place) return;
    this.readout.replaceChildren();
    const head = document.createElement("b");
    head.textContent = title;
    this.readout.append(head);
    for (const [m, name, text] of lines) {
      const row = document.createElement("div"), left = document.createElement("i"), value = document.createElement("span");
      left.textContent = name; value.textContent = text;
      row.style.cssText = m ? colors(m) : "--c:inherit";
      row.append(left, value);
      this.readout.append(row);
    }
    const {offsetWidth: w, offsetHeight: h} = this.readout;
    const x = place[0] + 14 + w > this.width ? place[0] - 14 - w : place[0] + 14;
    this.readout.style.left = Math.max(0, x) + "px";
    this.readout.style.top = Math.max(0, Math.min(this.height - h, place[1] - h / 2)) + "px";
  }
}
