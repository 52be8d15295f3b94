// Drawing: nodes, ticks, and a chart of one curve per model.

const SVG = "http://www.w3.org/2000/svg";
function node(tag, attributes = {}, parent = null, text = null) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== null) made.textContent = text;
  if (parent) parent.append(made);
  return made;
}
/** Write a label, its subscripts after an underscore each. */
function write(text, label) {
  if (text.dataset.label === label) return;
  text.dataset.label = label;
  text.replaceChildren();
  for (const [, sub, part] of label.matchAll(/(_?)([A-Za-z]+|[^_A-Za-z]+)/g))
    node("tspan", sub ? {"font-size": "80%", dy: 3} : {}, text, part).after(...(sub ? [node("tspan", {dy: -3}, null, "\u200b")] : []));
}
const minus = text => text.replace("-", "−");
const fixed = (x, digits) => Number.isFinite(x) ? minus((Math.abs(x) < 0.5 * 10 ** -digits ? 0 : x).toFixed(digits)) : "–";
const stroke = m => `color-mix(in srgb, ${LOOK[m]?.[0] ?? "#8a8f96"}, white var(--lift))`;
const ink = m => `color-mix(in srgb, ${LOOK[m]?.[0] ?? "#8a8f96"}, var(--towards) var(--darken))`;
const colors = m => `--s:${stroke(m)};--c:${ink(m)}`;
const dashes = m => LOOK[m]?.[1] ?? "1 2";

function ticks(low, high, room) {
  const rough = (high - low) / Math.max(2, room), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(s => s * power >= 0.999 * rough);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), values = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; k++) values.push(k * step);
  return values.map(v => [v, fixed(v, digits)]);
}

class Chart {
  constructor(id, {x, y, margin = {left: 52, right: 46, top: 28, bottom: 36}, label}) {
    this.host = document.getElementById(id);
    this.svg = node("svg", {role: "img", "aria-label": label}, this.host);
    this.clip = node("rect", {}, node("clipPath", {id: id + "-clip"}, node("defs", {}, this.svg)));
    const layer = clipped => node("g", clipped ? {"clip-path": `url(#${id}-clip)`} : {}, this.svg);
    this.back = layer(); this.curves = layer(true); this.front = layer(true); this.labels = layer(); this.over = layer(true);
    this.readout = document.createElement("div");
    this.readout.className = "readout";
    this.host.append(this.readout);
    this.names = {x, y}; this.margin = margin; this.paths = {}; this.key = "";
  }
  /** Measure, and redraw the axes if anything about them is new. */
  frame(xDomain, yDomain, decorate) {
    const {left, right, top, bottom} = this.margin, width = this.host.clientWidth, height = this.host.clientHeight;
    const key = JSON.stringify([width, height, xDomain, yDomain]);
    if (key === this.key) return false;
    this.key = key;
    Object.assign(this, {width, height, xDomain, yDomain, x0: left, x1: width - right, y0: height - bottom, y1: top});
    for (const [n, v] of Object.entries({x: this.x0, y: this.y1, width: Math.max(0, this.x1 - this.x0), height: Math.max(0, this.y0 - this.y1)}))
      this.clip.setAttribute(n, v);
    this.back.replaceChildren();
    if (decorate) decorate(this.back);
    for (const [v, text] of ticks(...xDomain, (this.x1 - this.x0) / 70)) {
      const x = this.x(v);
      node("line", {class: "grid", x1: x, x2: x, y1: this.y0, y2: this.y1}, this.back);
      node("text", {x, y: this.y0 + 16, "text-anchor": "middle"}, this.back, text);
    }
    for (const [v, text] of ticks(...yDomain, (this.y0 - this.y1) / 45)) {
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
  /** Draw one curve per model from [x, y] values; the exact one on top. */
  draw(curves) {
    for (const m of Object.keys(this.paths)) if (!(m in curves)) { this.paths[m].remove(); delete this.paths[m]; }
    for (const m of [...ORDER].reverse()) {
      if (!(m in curves)) continue;
      let path = this.paths[m];
      if (!path) {
        path = this.paths[m] = node("path", {class: m === "exact" ? "curve exact" : "curve", "data-model": m, style: colors(m), "stroke-dasharray": dashes(m)});
        const above = ORDER.slice(0, ORDER.indexOf(m)).reverse().find(o => this.paths[o]);
        this.curves.insertBefore(path, above ? this.paths[above] : null);
      }
      let d = "", pen = "M";
      for (const [x, y] of curves[m]) {
        if (!Number.isFinite(y)) { pen = "M"; continue; }
        d += pen + this.x(x).toFixed(1) + "," + Math.max(-9999, Math.min(9999, this.y(y))).toFixed(1);
        pen = "L";
      }
      path.setAttribute("d", d);
    }
  }
  /** Name each curve where it ends or leaves the frame. */
  name(curves) {
    this.labels.replaceChildren();
    const right = [], edge = [];
    for (const m of ORDER) {
      if (!(m in curves)) continue;
      const ends = curves[m].filter(p => Number.isFinite(p[1]));
      if (!ends.length) continue;
      const inside = y => y >= this.yDomain[0] && y <= this.yDomain[1];
      const last = ends[ends.length - 1];
      if (inside(last[1])) { right.push({m, at: this.y(last[1]), y: this.y(last[1]), x: this.x(last[0])}); continue; }
      const up = last[1] > this.yDomain[1], bound = this.yDomain[up ? 1 : 0];
      let j = ends.length - 1;
      while (j > 0 && !inside(ends[j - 1][1])) j--;
      let x = ends[0][0];
      if (j > 0) { const [p, q] = [ends[j - 1], ends[j]]; x = p[0] + (bound - p[1]) / (q[1] - p[1]) * (q[0] - p[0]); }
      edge.push({m, up, x: this.x(x)});
    }
    right.sort((p, q) => p.at - q.at);
    const gap = 13, low = this.y1 + 4, high = this.y0 - 2;
    for (let pass = 0; pass < 40; pass++)
      for (let i = 0; i < right.length; i++) {
        right[i].y = Math.min(high, Math.max(low, right[i].y));
        if (i && right[i].y - right[i - 1].y < gap) {
          const push = (gap - right[i].y + right[i - 1].y) / 2;
          right[i - 1].y -= push; right[i].y += push;
        }
      }
    for (const {m, at, y, x} of right) {
      if (Math.abs(y - at) > 2 || x < this.x1 - 2) node("path", {class: "leader", fill: "none", style: colors(m), d: `M${x + 1},${at}L${this.x1 + 8},${y}`}, this.labels);
      node("text", {class: "name", style: colors(m), x: this.x1 + 10, y: y + 4}, this.labels, m);
    }
    edge.sort((p, q) => p.x - q.x);
    const taken = [];
    for (const {m, up, x} of edge) {
      let row = 0;
      const left = Math.min(x + 5, this.x1 - 34);
      while (taken.some(t => t.up === up && t.row === row && left < t.end)) row++;
      taken.push({up, row, end: left + 36});
      node("text", {class: "name halo", style: colors(m), x: left, y: up ? this.y1 + 12 + 14 * row : this.y0 - 6 - 14 * row}, this.labels, m + (up ? " ↑" : " ↓"));
    }
  }
  /** Report the pointer, in pixels of the plot; null when it has left. */
  listen(move, pick) {
    const at = event => { const box = this.svg.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    this.svg.addEventListener("pointermove", e => { move(at(e)); if (pick && e.buttons & 1) pick(at(e)); });
    this.svg.addEventListener("pointerdown", e => { move(at(e)); if (pick && e.pointerType !== "touch") pick(at(e)); });
    if (pick) this.svg.addEventListener("click", e => pick(at(e)));
    this.svg.addEventListener("pointerleave", () => move(null));
    document.addEventListener("pointerdown", e => { if (!this.host.contains(e.target)) move(null); });
  }
  invertX(px) { return this.xDomain[0] + (px - this.x0) / (this.x1 - this.x0) * (this.xDomain[1] - this.xDomain[0]); }
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
