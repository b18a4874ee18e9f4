"use strict";
// Points between the rows of a curve, so that few rows look like the curve that they lie on. Rows stay what they are.

/** Branches of more rows are fine enough. */
const mostBentRows = 2000;
/** Pieces of a step. */
const piecesOfAStep = 8;

/**
 * Cubics over the arc length, or along a path of commands without corners, between rows, with the slopes of the parabola through
 * a row and its neighbours, never across a row at which a spring switches; none where there is neither.
 * @param {Run} run @param {WrittenBranch} branch @param {Float64Array} x @param {Float64Array} y
 * @returns {number[][]} x and y by turns, for each step */
function pointsBetween(run, branch, x, y) {
  const column = columnOf(run, run.along);
  if (column < 0 || branch.form !== "curve" || branch.rows < 3 || branch.rows > mostBentRows) return [];
  const s = valuesAlong(run, branch, column), rows = branch.rows, last = rows - 1, near = 1e-6 * Math.abs(s[last] - s[0]);
  const kinks = new Set(branch.events.filter(e => ["SA", "CL", "KB"].includes(e.code)).flatMap(e => [e.row, e.row + 1]));
  const turns = new Set(branch.events.map(e => e.row));
  const smooth = (/** @type {number} */ i) => i >= 0 && i < last && s[i + 1] - s[i] > near && Number.isFinite(x[i] + y[i] + x[i + 1] + y[i + 1]);
  const chord = (/** @type {Float64Array} */ v, /** @type {number} */ i) => (v[i + 1] - v[i]) / (s[i + 1] - s[i]);
  /** Slope at a row that lies between two smooth steps; NaN elsewhere. */
  const inner = (/** @type {Float64Array} */ v, /** @type {number} */ i) => {
    if (kinks.has(i) || !smooth(i - 1) || !smooth(i)) return NaN;
    const g = s[i] - s[i - 1], h = s[i + 1] - s[i], a = chord(v, i - 1), b = chord(v, i);
    return turns.has(i) && a * b < 0 ? 0 : (h * a + g * b) / (g + h);
  };
  const coordinate = (/** @type {Float64Array} */ v, /** @type {number} */ i, /** @type {number} */ t) => {
    const c = chord(v, i), h = s[i + 1] - s[i], u = 1 - t;
    let p = inner(v, i), q = inner(v, i + 1);
    if (Number.isNaN(p)) p = Number.isNaN(q) ? c : 2 * c - q;
    if (Number.isNaN(q)) q = 2 * c - p;
    return u * u * (1 + 2 * t) * v[i] + t * t * (3 - 2 * t) * v[i + 1] + h * u * t * (u * p - t * q);
  };
  return Array.from({length: last}, (_, i) => {
    const spots = [];
    for (let k = 1; smooth(i) && k < piecesOfAStep; ++k) spots.push(coordinate(x, i, k / piecesOfAStep), coordinate(y, i, k / piecesOfAStep));
    return spots;
  });
}
