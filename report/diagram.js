"use strict";
// The curves of a run: any two quantities as axes, zoom, special points, the row under the cursor. A map: its nodes.

/** @type {any} D3 3.5 has no types of its own. */
const d3 = /** @type {any} */ (window)["d3"];

/**
 * A list of rows as it is drawn.
 * @typedef {{run: Run, branch: WrittenBranch, number: number, x: Float64Array, y: Float64Array, kinds: string[],
 *            special: Uint8Array, between: number[][]}} Plot
 * @typedef {{kind: string, plot: Plot, path: string, spots: number[]}} Line
 * @typedef {{path: string, style: string}} Stroke
 */

/** Kinds of lines from the most stable on, and those of marks: classes of the style sheet. */
const kindsOfLines = ["stable", "unknown", "driven", "unstable", "moving"];

/** @param {number[]} spots */
function pathOf(spots) {
  const places = [];
  for (let i = 0; i < spots.length; i += 2) places.push(`${spots[i].toFixed(1)},${spots[i + 1].toFixed(1)}`);
  return `M${places.join("L")}`;
}

/** @param {Run} run @param {number} number @param {number} xColumn @param {number} yColumn @returns {Plot} */
function plotOf(run, number, xColumn, yColumn) {
  const branch = run.branches[number];
  const along = (/** @type {number} */ column) => {
    const q = run.quantities[column], rounding = q ? q.rounding : 0;
    return valuesAlong(run, branch, column).map(v => Math.abs(v) <= rounding ? 0 : v);
  };
  const special = new Uint8Array(branch.rows + 1);
  for (const event of branch.events) special[event.row] = 1;
  const x = along(xColumn), y = along(yColumn);
  return {run, branch, number, x, y, kinds: stabilitiesAlong(run, branch), special, between: pointsBetween(run, branch, x, y)};
}

/** @type {number[]} */ const nothingBetween = [];

/** Numbers of ticks in as few digits as they have, 0 where only rounding is left.
 * @param {any} scale @returns {(value: number) => string} */
function ticksOf(scale) {
  const [low, high] = scale.domain(), rounding = 1e-9 * Math.abs(high - low);
  return value => String(Math.abs(value) < rounding ? 0 : Number(value.toPrecision(12)));
}

class Diagram {
  /** @param {SVGSVGElement} svg @param {(branch: number, row: number) => void} choose */
  constructor(svg, choose) {
    this.svg = svg;
    this.choose = choose;
    this.width = 560;
    this.height = 420;
    this.edges = {left: 70, right: 14, top: 26, bottom: 44};
    /** @type {Run | null} */ this.run = null;
    /** @type {Plot[]} */ this.plots = [];
    /** @type {Plot[]} */ this.others = [];
    /** @type {MapView | null} */ this.map = null;
    /** Kinds of lines of the whole diagram; "mixed": one lies on a more stable one. @type {Set<string>} */ this.kinds = new Set();
    this.branch = this.row = 0;
    d3.select(svg).attr("viewBox", `0 0 ${this.width} ${this.height}`);
    this.x = d3.scale.linear().range([this.edges.left, this.width - this.edges.right]);
    this.y = d3.scale.linear().range([this.height - this.edges.bottom, this.edges.top]);
    this.zoom = d3.behavior.zoom().scaleExtent([0.5, 1e6]).on("zoom", () => this.redraw());
    const root = d3.select(svg);
    const id = "inside";
    const inside = {x: this.edges.left, y: this.edges.top, width: this.width - this.edges.left - this.edges.right,
                    height: this.height - this.edges.top - this.edges.bottom};
    root.append("clipPath").attr("id", id).append("rect").attr(inside);
    this.xAxis = root.append("g").attr("class", "axis").attr("transform", `translate(0,${this.height - this.edges.bottom})`);
    this.yAxis = root.append("g").attr("class", "axis").attr("transform", `translate(${this.edges.left},0)`);
    this.xLabel = root.append("text").attr("x", this.width - this.edges.right).attr("y", this.height - 8).attr("text-anchor", "end");
    this.yLabel = root.append("text").attr("x", 6).attr("y", 13);
    const plane = root.append("g");
    this.image = plane.append("g").attr("clip-path", `url(#${id})`).append("image").attr("class", "nodes")
        .attr("preserveAspectRatio", "none").attr("display", "none");
    const sheet = plane.append("rect").attr("class", "sheet").attr("fill", "transparent").attr(inside);
    this.curves = plane.append("g").attr("clip-path", `url(#${id})`).attr("pointer-events", "none");
    this.marks = plane.append("g").attr("clip-path", `url(#${id})`);
    this.labels = plane.append("g").attr("class", "labels").attr("pointer-events", "none");
    this.cursor = plane.append("circle").attr("class", "cursor").attr("r", 5);
    this.hover = plane.append("g").attr("class", "labels hover").attr("pointer-events", "none").attr("display", "none");
    this.hover.append("circle").attr("r", 4);
    this.hover.append("text");
    plane.call(this.zoom).on("dblclick.zoom", null);
    this.follow(/** @type {SVGRectElement} */ (sheet.node()));
  }

  /**
   * Dragging moves along the branch, once for each frame; with shift it moves the diagram. Over a map nothing has to be held;
   * over curves the mouse alone shows the values of the nearest row.
   * @param {SVGRectElement} sheet */
  follow(sheet) {
    let drags = false;
    /** @type {{clientX: number, clientY: number} | null} */ let wanted = null;
    const want = (/** @type {{clientX: number, clientY: number}} */ event) => {
      if (!wanted) requestAnimationFrame(() => { const at = wanted; wanted = null; if (at) this.chooseNear(at); });
      wanted = {clientX: event.clientX, clientY: event.clientY};
    };
    sheet.addEventListener("mousedown", event => {
      if (event.shiftKey) return;
      event.stopPropagation();
      event.preventDefault();
      this.svg.focus();
      drags = true;
      this.hover.attr("display", "none");
      want(event);
    });
    /** @type {MouseEvent | null} */ let over = null;
    sheet.addEventListener("mousemove", event => {
      if (event.buttons) return;
      if (this.map) return want(event);
      if (!over) requestAnimationFrame(() => { const at = over; over = null; if (at && !drags) this.showNear(at); });
      over = event;
    });
    this.svg.addEventListener("mouseleave", () => { over = null; this.hover.attr("display", "none"); });
    window.addEventListener("mousemove", event => { if (drags) want(event); });
    window.addEventListener("mouseup", () => { drags = false; });
    sheet.addEventListener("touchmove", event => {
      if (event.touches.length !== 1) return;
      event.stopPropagation();
      event.preventDefault();
      want(event.touches[0]);
    }, {passive: false});
  }

  /** A place of the screen in the diagram.
   * @param {{clientX: number, clientY: number}} event */
  placeOf(event) {
    const frame = this.svg.getBoundingClientRect();
    return {px: (event.clientX - frame.left) * this.width / frame.width, py: (event.clientY - frame.top) * this.height / frame.height};
  }

  /**
   * The row whose mark is nearest on the screen; null where there is none.
   * @param {number} px @param {number} py */
  nearest(px, py) {
    const [x, y] = [this.line(this.x), this.line(this.y)];
    let best = Infinity, branch = this.branch, row = this.row;
    for (const plot of this.plots) {
      // A drag along a branch is not to end in a jump that begins there.
      if (plot.branch.form === "jump" && plot.number !== this.branch) continue;
      for (let i = 0; i < plot.branch.rows; ++i) {
        const dx = x.begin + x.slope * plot.x[i] - px, dy = y.begin + y.slope * plot.y[i] - py;
        const away = dx * dx + dy * dy;
        if (away < best) { best = away; branch = plot.number; row = i; }
      }
    }
    return best < Infinity ? {branch, row} : null;
  }

  /** @param {{clientX: number, clientY: number}} event */
  chooseNear(event) {
    const {px, py} = this.placeOf(event);
    if (this.map) return this.choose(0, this.map.nodeNear(this.map.sliceOf(this.row), this.x.invert(px), this.y.invert(py)));
    const near = this.nearest(px, py);
    if (near) this.choose(near.branch, near.row);
  }

  /** The values of the row nearest to the mouse, beside it.
   * @param {{clientX: number, clientY: number}} event */
  showNear(event) {
    const {px, py} = this.placeOf(event), near = this.run && this.nearest(px, py);
    const spot = near ? this.spot(near.branch, near.row) : [NaN, NaN];
    const seen = Number.isFinite(spot[0] + spot[1]) && Math.hypot(spot[0] - px, spot[1] - py) < 60;
    this.hover.attr("display", seen ? null : "none");
    if (!near || !seen) return;
    const plot = this.plots[near.branch], isRight = spot[0] > this.width / 2;
    const words = `${brief(plot.x[near.row])}, ${brief(plot.y[near.row])}`;
    this.hover.select("circle").attr("cx", spot[0]).attr("cy", spot[1]);
    this.hover.select("text").text(this.plots.length > 1 ? `${words} (${plot.branch.name})` : words)
        .attr("text-anchor", isRight ? "end" : "start").attr("x", spot[0] + (isRight ? -9 : 9))
        .attr("y", Math.max(this.edges.top + 12, spot[1] - 9));
  }

  /** A linear scale as a straight line: D3's own calls take far longer on many rows.
   * @param {any} scale */
  line(scale) {
    const begin = scale(0);
    return {begin, slope: scale(1) - begin};
  }

  /** @param {number} branch @param {number} row */
  spot(branch, row) {
    const plot = this.plots[branch];
    return plot ? [this.x(plot.x[row]), this.y(plot.y[row])] : [NaN, NaN];
  }

  /** @param {Run} run @param {number} xColumn @param {number} yColumn @param {Run[]} others  drawn behind it
   * @param {MapView | null} map */
  show(run, xColumn, yColumn, others, map) {
    this.run = run;
    this.map = map;
    this.plots = run.branches.map((_, k) => plotOf(run, k, xColumn, yColumn));
    this.others = others.flatMap(o => o.branches.map((_, k) => plotOf(o, k, xColumn, yColumn)).filter(p => p.branch.form === "curve"));
    const all = [...this.plots, ...this.others], frame = map && map.frame();
    this.x.domain(frame ? frame.x : this.reach(all.map(p => p.x)));
    this.y.domain(frame ? frame.y : this.reach(all.map(p => p.y)));
    this.zoom.x(this.x).y(this.y);
    this.xLabel.text(titleOf(run, xColumn));
    this.yLabel.text(titleOf(run, yColumn));
    this.kinds = this.redraw();
  }

  /** From the least to the largest value, with room.
   * @param {Float64Array[]} lists */
  reach(lists) {
    let low = Infinity, high = -Infinity, size = 0;
    for (const list of lists)
      for (const v of list) {
        if (!Number.isFinite(v)) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    if (!(low <= high)) { low = 0; high = 1; }
    size = Math.max(Math.abs(low), Math.abs(high));
    // What differs by rounding alone is one value.
    const room = high - low > 1e-12 * size ? 0.05 * (high - low) : 0.5 * size || 1;
    return [low - room, high + room];
  }

  /** Lines of one stability each; rows that lie on each other on the screen are left out.
   * @param {Plot} plot @param {Line[]} lines */
  addLines(plot, lines) {
    if (plot.branch.form !== "curve" && plot.branch.form !== "jump") return;
    const x = this.line(this.x), y = this.line(this.y), last = plot.branch.rows - 1;
    /** @type {string[]} */ let path = [];
    /** @type {number[]} */ let spots = [];
    const {special, kinds} = plot;
    let kind = "", lastX = 0, lastY = 0;
    const end = () => { if (path.length > 1) lines.push({kind, plot, path: path.join("L"), spots}); path = []; spots = []; };
    let ax = NaN, ay = NaN, bx = x.begin + x.slope * plot.x[0], by = y.begin + y.slope * plot.y[0];
    for (let i = 0; i < last; ++i) {
      ax = bx;
      ay = by;
      bx = x.begin + x.slope * plot.x[i + 1];
      by = y.begin + y.slope * plot.y[i + 1];
      if (!Number.isFinite(ax + ay + bx + by)) { end(); continue; }
      const isSpecial = special[i] === 1, comesSpecial = special[i + 1] === 1;
      // A special point belongs to both sides: the row behind it says what follows.
      const now = kinds[isSpecial && !comesSpecial ? i + 1 : i];
      if (now !== kind || path.length === 0) {
        end();
        kind = now;
        path.push(`M${ax.toFixed(1)},${ay.toFixed(1)}`);
        spots.push(ax, ay);
        lastX = ax;
        lastY = ay;
      }
      const between = plot.between.length > 0 ? plot.between[i] : nothingBetween;
      for (let k = 0; k < between.length; k += 2) {
        const px = x.begin + x.slope * between[k], py = y.begin + y.slope * between[k + 1];
        if (Math.abs(px - lastX) + Math.abs(py - lastY) < 0.7) continue;
        path.push(`${px.toFixed(1)},${py.toFixed(1)}`);
        spots.push(px, py);
        lastX = px;
        lastY = py;
      }
      const ends = i + 1 === last || comesSpecial || kinds[i + 1] !== kind;
      if (!ends && Math.abs(bx - lastX) + Math.abs(by - lastY) < 0.7) continue;
      path.push(`${bx.toFixed(1)},${by.toFixed(1)}`);
      spots.push(bx, by);
      lastX = bx;
      lastY = by;
    }
    end();
  }

  /** What is drawn of lines: dashes that lie on a line are not drawn again. The branch that is shown comes first, then those of
   * this run.
   * @param {Line[]} lines @returns {Stroke[]} */
  strokes(lines) {
    /** @type {Map<Plot, number>} */ const numbers = new Map();
    for (const {plot} of lines) if (!numbers.has(plot)) numbers.set(plot, numbers.size);
    const placeOf = (/** @type {Plot} */ plot) => plot.run !== this.run ? 2 : plot.number === this.branch ? 0 : 1;
    const seen = withoutOverlaps(lines.map(l => ({curve: numbers.get(l.plot) ?? 0, place: placeOf(l.plot),
                                                  rank: Math.max(0, kindsOfLines.indexOf(l.kind)), spots: l.spots})), this.width, this.height);
    /** @type {Stroke[]} */ const bands = [];
    /** @type {Stroke[]} */ const strokes = [];
    lines.forEach((line, i) => {
      const place = placeOf(line.plot), style = `curve ${line.kind}${["", " other", " run"][place]}`;
      if (place < 2) for (const spots of seen[i].beneath) bands.push({path: pathOf(spots), style: "curve mixed"});
      if (seen[i].isWhole) strokes.push({path: line.path, style});
      else for (const spots of seen[i].stretches) strokes.push({path: pathOf(spots), style});
    });
    return [...bands, ...strokes];
  }

  /** @returns {Set<string>} kinds of its lines */
  redraw() {
    if (!this.run) return new Set();
    this.hover.attr("display", "none");
    this.xAxis.call(d3.svg.axis().scale(this.x).orient("bottom").ticks(6).tickFormat(ticksOf(this.x)));
    this.yAxis.call(d3.svg.axis().scale(this.y).orient("left").ticks(6).tickFormat(ticksOf(this.y)));
    /** @type {Line[]} */ const lines = [];
    for (const plot of this.others) this.addLines(plot, lines);
    for (const plot of this.plots) this.addLines(plot, lines);
    const strokes = this.strokes(lines);
    const drawn = this.curves.selectAll("path").data(strokes);
    drawn.enter().append("path");
    drawn.exit().remove();
    drawn.attr("d", (/** @type {Stroke} */ s) => s.path).attr("class", (/** @type {Stroke} */ s) => s.style);
    this.redrawNodes();
    this.mark();
    this.label(lines);
    return new Set([...lines.map(l => l.kind), ...(strokes.some(s => s.style === "curve mixed") ? ["mixed"] : [])]);
  }

  /** Names of special points beside them, where there is room.
   * @param {Line[]} lines */
  label(lines) {
    const room = {left: this.edges.left, top: 0, right: this.width, bottom: this.height - this.edges.bottom};
    const spots = this.plots.flatMap(plot => plot.branch.events.map(event => ({text: event.label, spot: this.spot(plot.number, event.row)})))
        .filter(({spot}) => spot[0] >= room.left && spot[0] <= room.right && spot[1] >= room.top && spot[1] <= room.bottom);
    /** @type {Box[]} */ const boxes = spots.map(({spot: [x, y]}) => ({left: x - 5, right: x + 5, top: y - 5, bottom: y + 5}));
    /** @type {number[]} */ const dots = [];
    for (const line of lines)
      if (line.plot.run === this.run)
        for (let i = 1; i < line.spots.length / 2; ++i) addDots(line.spots[2 * i - 2], line.spots[2 * i - 1], line.spots[2 * i], line.spots[2 * i + 1], dots);
    /** @type {{x: number, y: number, at: number[], text: string}[]} */ const placed = [];
    for (const {text, spot} of spots) {
      // Branches that cross have the same point.
      if (placed.some(p => p.text === text && Math.hypot(p.at[0] - spot[0], p.at[1] - spot[1]) < 1)) continue;
      const place = placeOfName(spot[0], spot[1], text, dots, boxes, room);
      if (!place) continue;
      placed.push({x: place.x, y: place.y, at: spot, text});
      boxes.push(place.box);
    }
    const drawn = this.labels.selectAll("text").data(placed);
    drawn.enter().append("text");
    drawn.exit().remove();
    drawn.attr("x", (/** @type {any} */ p) => p.x).attr("y", (/** @type {any} */ p) => p.y).text((/** @type {any} */ p) => p.text);
  }

  redrawNodes() {
    const run = this.run, map = this.map;
    if (!run || !map) { this.image.attr("display", "none"); return; }
    const {x, y} = map.frame();
    this.image.attr("display", null).attr("x", this.x(x[0])).attr("width", this.x(x[1]) - this.x(x[0]))
        .attr("y", this.y(y[1])).attr("height", this.y(y[0]) - this.y(y[1]))
        .attr("href", map.picture(run.branches[0], map.sliceOf(this.row)));
  }

  mark() {
    /** @type {{plot: Plot, row: number, event: SpecialPoint | null}[]} */
    const points = [];
    for (const plot of this.plots) {
      const named = new Set();
      for (const event of plot.branch.events) { points.push({plot, row: event.row, event}); named.add(event.row); }
      if (plot.branch.form !== "points") continue;
      for (let row = 0; row < plot.branch.rows; ++row) if (!named.has(row)) points.push({plot, row, event: null});
    }
    const marks = this.marks.selectAll("circle").data(points);
    marks.enter().append("circle").attr("r", 5).append("title");
    marks.exit().remove();
    marks.attr("class", (/** @type {any} */ p) => {
      const states = p.plot.branch.form === "points" ? ` ${p.plot.kinds[p.row]}` : "";
      return `special${states}${p.plot.number === this.branch && p.row === this.row ? " here" : ""}`;
    })
        .attr("cx", (/** @type {any} */ p) => this.spot(p.plot.number, p.row)[0] || -99)
        .attr("cy", (/** @type {any} */ p) => this.spot(p.plot.number, p.row)[1] || -99)
        .attr("data-label", (/** @type {any} */ p) => p.event ? p.event.label : "")
        .on("mousedown", () => d3.event.stopPropagation())
        .on("click", (/** @type {any} */ p) => this.choose(p.plot.number, p.row))
        .select("title").text((/** @type {any} */ p) => p.event ? `${p.event.label} ${p.event.detail}` : p.plot.branch.name);
    this.moveCursor();
  }

  moveCursor() {
    const map = this.map, here = this.spot(this.branch, this.row);
    if (map) {  // where the node was asked for, also where it has no values
      const i = this.row % map.wide, j = Math.floor(this.row / map.wide) % map.tall;
      here[0] = this.x(map.at(0, i));
      here[1] = this.y(map.at(1, j));
    }
    const seen = Number.isFinite(here[0]) && Number.isFinite(here[1]);
    this.cursor.attr("display", seen ? null : "none").attr("cx", seen ? here[0] : 0).attr("cy", seen ? here[1] : 0);
  }

  /** @param {number} branch @param {number} row */
  go(branch, row) {
    const map = this.map, isOther = branch !== this.branch || (map && map.sliceOf(row) !== map.sliceOf(this.row));
    const wasMarked = this.isMarked(this.branch, this.row);
    this.branch = branch;
    this.row = row;
    if (isOther) this.redraw();
    else if (wasMarked || this.isMarked(branch, row)) this.mark();
    else this.moveCursor();
  }

  /** @param {number} branch @param {number} row */
  isMarked(branch, row) {
    const plot = this.plots[branch];
    return plot && (plot.branch.form === "points" || plot.special[row] === 1);
  }
}
