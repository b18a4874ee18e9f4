"use strict";
// A map as coloured nodes: one plane of it, over its first two axes.

/** Dark to light, told apart by the colour-blind and in grey: cividis (Nuñez, Anderton, Renslow 2018), nine of its colours. */
const rampColours = [[0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120],
                     [166, 157, 117], [200, 184, 102], [254, 232, 56]];

/** @param {number} part from 0 to 1 @returns {number[]} */
function rampColour(part) {
  const at = Math.max(0, Math.min(1, part)) * (rampColours.length - 1), i = Math.min(Math.floor(at), rampColours.length - 2);
  return rampColours[i].map((c, k) => Math.round(c + (at - i) * (rampColours[i + 1][k] - c)));
}

class MapView {
  /** @param {Run} run @param {WrittenMap} map */
  constructor(run, map) {
    this.run = run;
    this.map = map;
    this.wide = map.axes[0].points;
    this.tall = map.axes[1].points;
    this.column = Math.max(0, columnOf(run, map.quantity));
    this.low = this.high = 0;
    this.beyond = 0;
    this.slice = -1;
    this.address = "";
    this.choose(this.column);
  }

  /** Colours run between the 2nd and the 98th hundredth of what is finite: few nodes beside a singularity would take them all.
   * @param {number} column */
  choose(column) {
    this.column = column;
    this.slice = -1;
    const all = this.run.branches.flatMap(b => b.form === "nodes" ? [...valuesAlong(this.run, b, column)] : []);
    const finite = Float64Array.from(all.filter(Number.isFinite)).sort();
    const last = finite.length - 1;
    this.low = last >= 0 ? finite[Math.floor(0.02 * last)] : 0;
    this.high = last >= 0 ? finite[Math.ceil(0.98 * last)] : 0;
    this.beyond = all.filter(v => v < this.low || v > this.high).length;
  }

  /** Value of a place of an axis.
   * @param {number} axis @param {number} place */
  at(axis, place) {
    const {from, to, points} = this.map.axes[axis];
    return points === 1 ? from : (from * (points - 1 - place) + to * place) / (points - 1);
  }

  /** Number of the plane in which a node lies.
   * @param {number} row */
  sliceOf(row) { return Math.floor(row / (this.wide * this.tall)); }

  /** The node of a plane that is nearest to these values of the axes.
   * @param {number} slice @param {number} x @param {number} y */
  nodeNear(slice, x, y) {
    const place = (/** @type {number} */ axis, /** @type {number} */ value) => {
      const {from, to, points} = this.map.axes[axis];
      return to === from ? 0 : Math.max(0, Math.min(points - 1, Math.round((value - from) / (to - from) * (points - 1))));
    };
    return (slice * this.tall + place(1, y)) * this.wide + place(0, x);
  }

  /** A plane as an address of a picture, one pixel for a node.
   * @param {WrittenBranch} branch @param {number} slice */
  picture(branch, slice) {
    if (slice === this.slice) return this.address;
    const canvas = document.createElement("canvas"), values = valuesAlong(this.run, branch, this.column);
    canvas.width = this.wide;
    canvas.height = this.tall;
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    const pixels = context.createImageData(this.wide, this.tall);
    const turnedX = this.at(0, 0) > this.at(0, this.wide - 1), turnedY = this.at(1, 0) > this.at(1, this.tall - 1);
    for (let j = 0; j < this.tall; ++j)
      for (let i = 0; i < this.wide; ++i) {
        const value = values[(slice * this.tall + j) * this.wide + i];
        const row = turnedY ? j : this.tall - 1 - j, column = turnedX ? this.wide - 1 - i : i;
        if (Number.isNaN(value)) continue;
        const part = this.high > this.low ? (value - this.low) / (this.high - this.low) : 0.5;
        pixels.data.set([...rampColour(part), 255], 4 * (row * this.wide + column));
      }
    context.putImageData(pixels, 0, 0);
    this.slice = slice;
    this.address = canvas.toDataURL();
    return this.address;
  }

  /** Corners of the picture in values of the axes: half a cell around the outer nodes. */
  frame() {
    const reach = (/** @type {number} */ axis) => {
      const last = this.map.axes[axis].points - 1, a = this.at(axis, 0), b = this.at(axis, last);
      const half = last > 0 ? Math.abs(b - a) / last / 2 : 0.5;
      return [Math.min(a, b) - half, Math.max(a, b) + half];
    };
    return {x: reach(0), y: reach(1)};
  }

  /** What the colours mean, in words. */
  words() {
    const others = this.map.axes.slice(2).map(a => a.name).join(", ");
    return `${titleOf(this.run, this.column)}: dark ${brief(this.low)}, light ${brief(this.high)}; ` +
           (this.beyond ? `${this.beyond} nodes lie beyond and have the colour of the nearer end; ` : "") +
           `nodes without colour have no value${others ? `. A plane of ${others}` : ""}.`;
  }
}
