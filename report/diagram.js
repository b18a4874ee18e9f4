"use strict";
// The curves of a run: any two quantities as axes, zoom, special points, the row under the cursor.

/** @type {any} D3 3.5 has no types of its own. */
const d3 = /** @type {any} */ (window)["d3"];

class Diagram {
  /** @param {SVGSVGElement} svg @param {(branch: number, row: number) => void} choose */
  constructor(svg, choose) {
    this.svg = svg;
    this.choose = choose;
    this.width = 560;
    this.height = 420;
    this.edges = {left: 70, right: 14, top: 12, bottom: 44};
    /** @type {Run | null} */ this.run = null;
    this.xColumn = this.yColumn = this.branch = this.row = 0;
    d3.select(svg).attr("viewBox", `0 0 ${this.width} ${this.height}`);
    this.x = d3.scale.linear().range([this.edges.left, this.width - this.edges.right]);
    this.y = d3.scale.linear().range([this.height - this.edges.bottom, this.edges.top]);
    this.zoom = d3.behavior.zoom().scaleExtent([0.5, 1e6]).on("zoom", () => this.redraw());
    const root = d3.select(svg);
    const id = "inside";
    root.append("clipPath").attr("id", id).append("rect").attr("x", this.edges.left).attr("y", this.edges.top)
        .attr("width", this.width - this.edges.left - this.edges.right)
        .attr("height", this.height - this.edges.top - this.edges.bottom);
    this.xAxis = root.append("g").attr("class", "axis").attr("transform", `translate(0,${this.height - this.edges.bottom})`);
    this.yAxis = root.append("g").attr("class", "axis").attr("transform", `translate(${this.edges.left},0)`);
    this.xLabel = root.append("text").attr("x", this.width - this.edges.right).attr("y", this.height - 8).attr("text-anchor", "end");
    this.yLabel = root.append("text").attr("x", 6).attr("y", 11);
    const plane = root.append("g");
    this.plane = plane;
    const sheet = plane.append("rect").attr("x", this.edges.left).attr("y", this.edges.top).attr("fill", "transparent")
        .attr("width", this.width - this.edges.left - this.edges.right)
        .attr("height", this.height - this.edges.top - this.edges.bottom);
    this.curves = plane.append("g").attr("clip-path", `url(#${id})`).attr("pointer-events", "none");
    this.marks = plane.append("g").attr("clip-path", `url(#${id})`);
    this.cursor = plane.append("circle").attr("class", "cursor").attr("r", 5);
    plane.call(this.zoom).on("dblclick.zoom", null);
    this.follow(/** @type {SVGRectElement} */ (sheet.node()));
  }

  /**
   * Dragging moves along the branch; with shift it moves the diagram.
   * @param {SVGRectElement} sheet */
  follow(sheet) {
    let drags = false;
    sheet.addEventListener("mousedown", event => {
      if (event.shiftKey) return;
      event.stopPropagation();
      event.preventDefault();
      this.svg.focus();
      drags = true;
      this.chooseNear(event);
    });
    window.addEventListener("mousemove", event => { if (drags) this.chooseNear(event); });
    window.addEventListener("mouseup", () => { drags = false; });
    sheet.addEventListener("touchmove", event => {
      if (event.touches.length !== 1) return;
      event.stopPropagation();
      event.preventDefault();
      this.chooseNear(event.touches[0]);
    }, {passive: false});
  }

  /**
   * The row whose mark is nearest on the screen.
   * @param {{clientX: number, clientY: number}} event */
  chooseNear(event) {
    if (!this.run) return;
    const frame = this.svg.getBoundingClientRect();
    const px = (event.clientX - frame.left) * this.width / frame.width;
    const py = (event.clientY - frame.top) * this.height / frame.height;
    let best = Infinity, branch = this.branch, row = this.row;
    this.run.branches.forEach((b, k) => {
      for (let i = 0; i < b.rows; ++i) {
        const spot = this.spot(k, i);
        const away = (spot[0] - px) ** 2 + (spot[1] - py) ** 2;
        if (away < best) { best = away; branch = k; row = i; }
      }
    });
    if (best < Infinity) this.choose(branch, row);
  }

  /** @param {number} branch @param {number} row */
  spot(branch, row) {
    const run = /** @type {Run} */ (this.run);
    return [this.x(valueAt(run, run.branches[branch], row, this.xColumn)),
            this.y(valueAt(run, run.branches[branch], row, this.yColumn))];
  }

  /** @param {Run} run @param {number} xColumn @param {number} yColumn */
  show(run, xColumn, yColumn) {
    this.run = run;
    this.xColumn = xColumn;
    this.yColumn = yColumn;
    for (const [scale, column] of [[this.x, xColumn], [this.y, yColumn]]) {
      let low = Infinity, high = -Infinity;
      for (const branch of run.branches)
        for (let i = 0; i < branch.rows; ++i) {
          const v = valueAt(run, branch, i, column);
          if (!Number.isFinite(v)) continue;
          low = Math.min(low, v);
          high = Math.max(high, v);
        }
      if (!(low <= high)) { low = 0; high = 1; }
      const room = 0.05 * (high - low) || 0.5 * Math.abs(low) || 1;
      scale.domain([low - room, high + room]);
    }
    this.zoom.x(this.x).y(this.y);
    const name = (/** @type {number} */ column) => {
      const q = run.quantities[column];
      return q ? q.name + (q.unit ? ` [${q.unit}]` : "") : "";
    };
    this.xLabel.text(name(xColumn));
    this.yLabel.text(name(yColumn));
    this.redraw();
  }

  /** Lines of one stability each; rows that lie on each other on the screen are left out. */
  redraw() {
    const run = this.run;
    if (!run) return;
    this.xAxis.call(d3.svg.axis().scale(this.x).orient("bottom").ticks(6));
    this.yAxis.call(d3.svg.axis().scale(this.y).orient("left").ticks(6));
    /** @type {{kind: string, branch: number, path: string}[]} */
    const lines = [];
    run.branches.forEach((branch, k) => {
      const special = new Set(branch.events.map(e => e.row));
      let path = "", kind = "", last = [NaN, NaN];
      for (let i = 0; i + 1 < branch.rows; ++i) {
        const a = this.spot(k, i), b = this.spot(k, i + 1);
        if (!(Number.isFinite(a[0]) && Number.isFinite(a[1]) && Number.isFinite(b[0]) && Number.isFinite(b[1]))) {
          if (path) lines.push({kind, branch: k, path});
          path = "";
          continue;
        }
        // A special point belongs to both sides: the row behind it says what follows.
        const now = stabilityAt(run, branch, special.has(i) && !special.has(i + 1) ? i + 1 : i);
        if (now !== kind || !path) {
          if (path) lines.push({kind, branch: k, path});
          kind = now;
          path = `M${a[0].toFixed(1)},${a[1].toFixed(1)}`;
          last = a;
        }
        const ends = i + 2 === branch.rows || special.has(i + 1);
        if (!ends && Math.abs(b[0] - last[0]) + Math.abs(b[1] - last[1]) < 0.7) continue;
        path += `L${b[0].toFixed(1)},${b[1].toFixed(1)}`;
        last = b;
      }
      if (path) lines.push({kind, branch: k, path});
    });
    const drawn = this.curves.selectAll("path").data(lines);
    drawn.enter().append("path");
    drawn.exit().remove();
    drawn.attr("d", (/** @type {any} */ l) => l.path)
        .attr("class", (/** @type {any} */ l) => `curve ${l.kind}${l.branch === this.branch ? "" : " other"}`);
    this.mark();
  }

  mark() {
    const run = this.run;
    if (!run) return;
    /** @type {{branch: number, event: SpecialPoint}[]} */
    const points = [];
    run.branches.forEach((branch, k) => branch.events.forEach(event => points.push({branch: k, event})));
    const marks = this.marks.selectAll("circle").data(points);
    marks.enter().append("circle").attr("r", 5).append("title");
    marks.exit().remove();
    marks.attr("class", (/** @type {any} */ p) => `special${p.branch === this.branch && p.event.row === this.row ? " here" : ""}`)
        .attr("cx", (/** @type {any} */ p) => this.spot(p.branch, p.event.row)[0] || -99)
        .attr("cy", (/** @type {any} */ p) => this.spot(p.branch, p.event.row)[1] || -99)
        .attr("data-label", (/** @type {any} */ p) => p.event.label)
        .on("mousedown", () => d3.event.stopPropagation())
        .on("click", (/** @type {any} */ p) => this.choose(p.branch, p.event.row))
        .select("title").text((/** @type {any} */ p) => `${p.event.label} ${p.event.detail}`);
    const spot = this.spot(this.branch, this.row);
    const seen = Number.isFinite(spot[0]) && Number.isFinite(spot[1]);
    this.cursor.attr("display", seen ? null : "none").attr("cx", seen ? spot[0] : 0).attr("cy", seen ? spot[1] : 0);
  }

  /** @param {number} branch @param {number} row */
  go(branch, row) {
    const other = branch !== this.branch;
    this.branch = branch;
    this.row = row;
    if (other) this.redraw();
    else this.mark();
  }
}
