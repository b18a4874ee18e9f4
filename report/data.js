"use strict";
// What springfold wrote into the page, as numbers.

/**
 * @typedef {{name: string, title: string, unit: string, rounding: number}} Quantity
 * @typedef {{label: string, code: string, row: number, detail: string, sentence: string, motion?: string, modes?: string[],
 *            stiffness?: number[][]}} SpecialPoint
 * @typedef {{name: string, form: string, file: string, rows: number, start: number, values: string, points: string,
 *            springs: string, loads: string, outlines: string, layout: number[] | null, status: {texts: string[], of: number[]} | null,
 *            rests: number[], events: SpecialPoint[]}} WrittenBranch
 * @typedef {{dimension: number, points: number, right: number[], up: number[], chains: string[],
 *            links: {from: number, to: number, chain: number, rail: boolean}[],
 *            joints: {name: string, shape: string, role: string, at: number, axis: number}[],
 *            springs: {name: string, line: boolean, from: number, at: number, to: number, member: string}[],
 *            outlines: {name: string, corners: number[]}[],
 *            stops: {spring: number, at: number, tip: number, slide: boolean}[],
 *            bodies: {name: string, origin: number, corners: number[]}[],
 *            loads: {name: string, at: number, moment: boolean, direction: boolean, weight: boolean}[],
 *            base: {at: number, towards: number}[], names: {name: string, at: number}[]}} Parts
 * @typedef {{name: string, from: number, to: number, points: number}} MapAxis
 * @typedef {{axes: MapAxis[], quantity: string}} WrittenMap
 * @typedef {{study: string, run: number, label: string, kind: string, along: string, control: string,
 *            parameters: Object<string, number>, varied: string[], start: string, table: string, doubts: string[],
 *            axes: string[], map: WrittenMap | null, quantities: Quantity[],
 *            branches: WrittenBranch[], mechanisms: Parts[]}} Run
 * @typedef {{version: string, title: string, case: string, hash: string, units: Object<string, string>, runs: Run[]}} Page
 * @typedef {{values: Float64Array, points: Float64Array, springs: Float64Array, loads: Float64Array, outlines: Float64Array}} Numbers
 */

const isLittleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

/** @param {string} text @returns {Float64Array} */
function numbersOf(text) {
  const bytes = atob(text), plain = new Uint8Array(bytes.length);
  for (let i = 0; i < bytes.length; ++i) plain[i] = bytes.charCodeAt(i);
  if (isLittleEndian) return new Float64Array(plain.buffer);
  const view = new DataView(plain.buffer), numbers = new Float64Array(bytes.length / 8);
  for (let i = 0; i < numbers.length; ++i) numbers[i] = view.getFloat64(8 * i, true);
  return numbers;
}

/** @type {WeakMap<WrittenBranch, Numbers>} */
const decoded = new WeakMap();

/** @param {WrittenBranch} branch @returns {Numbers} */
function numbersIn(branch) {
  let numbers = decoded.get(branch);
  if (!numbers) {
    numbers = {values: numbersOf(branch.values), points: numbersOf(branch.points),
               springs: numbersOf(branch.springs), loads: numbersOf(branch.loads), outlines: numbersOf(branch.outlines)};
    decoded.set(branch, numbers);
  }
  return numbers;
}

/**
 * Which parts a row has (-1: no posture is known), and where its numbers begin in each array.
 * @typedef {{layout: number[], points: number[], springs: number[], loads: number[], outlines: number[]}} Offsets
 * @type {WeakMap<WrittenBranch, Offsets>} */
const offsetsOf = new WeakMap();

/** @param {Run} run @param {WrittenBranch} branch @returns {Offsets} */
function offsetsIn(run, branch) {
  const known = offsetsOf.get(branch);
  if (known) return known;
  const layout = branch.layout || Array(branch.rows).fill(0);
  /** @type {Offsets} */ const offsets = {layout, points: [], springs: [], loads: [], outlines: []};
  let points = 0, springs = 0, loads = 0, outlines = 0;
  for (const number of layout) {
    offsets.points.push(points);
    offsets.springs.push(springs);
    offsets.loads.push(loads);
    offsets.outlines.push(outlines);
    if (number < 0) continue;
    const parts = run.mechanisms[number];
    points += parts.dimension * parts.points;
    springs += 2 * parts.springs.length;
    loads += 3 * parts.loads.length;
    outlines += parts.outlines.length;
  }
  offsetsOf.set(branch, offsets);
  return offsets;
}

/** @param {Run} run @param {string} name @returns {number} */
function columnOf(run, name) {
  return run.quantities.findIndex(q => q.name === name);
}

/** "deflection [m]"; what drives along a rotation is called a moment.
 * @param {Run} run @param {number} column */
function titleOf(run, column) {
  const q = run.quantities[column];
  return q ? q.title + (q.unit ? ` [${q.unit}]` : "") : "";
}

/** @param {Run} run @param {WrittenBranch} branch @param {number} row @param {number} column */
function valueAt(run, branch, row, column) {
  return column < 0 ? NaN : numbersIn(branch).values[row * run.quantities.length + column];
}

/** One quantity along all rows.
 * @param {Run} run @param {WrittenBranch} branch @param {number} column */
function valuesAlong(run, branch, column) {
  const all = numbersIn(branch).values, width = run.quantities.length;
  return Float64Array.from({length: branch.rows}, (_, row) => column < 0 ? NaN : all[row * width + column]);
}

/** Stability of a row: a class of the style sheet.
 * @param {Run} run @param {WrittenBranch} branch @param {number} row */
function stabilityAt(run, branch, row) {
  if (branch.form === "jump") return "moving";
  // Where an eigenvalue is zero its own count says nothing.
  const counted = countedAt(run, branch, row), singular = ["LP", "BP", "TP", "SC"];
  const isSingular = branch.events.some(e => e.row === row && singular.includes(e.code));
  const ends = isSingular && counted !== "unstable" && [row - 1, row + 1].some(i => i >= 0 && i < branch.rows && countedAt(run, branch, i) === "stable");
  return ends ? "critical" : counted;
}

/** As the columns of unstable modes say.
 * @param {Run} run @param {WrittenBranch} branch @param {number} row */
function countedAt(run, branch, row) {
  const driven = valueAt(run, branch, row, columnOf(run, "index"));
  const dead = valueAt(run, branch, row, columnOf(run, "index_force"));
  const constrained = valueAt(run, branch, row, columnOf(run, "index_driven"));
  return stabilityOf(driven, dead, constrained);
}

/** @param {number} driven @param {number} dead @param {number} constrained */
function stabilityOf(driven, dead, constrained) {
  if (driven > 0) return constrained === 0 ? "driven" : "unstable";
  if (Number.isNaN(dead)) return "unknown";
  if (dead === 0) return "stable";
  return driven === 0 ? "driven" : "unstable";
}

/** Stability along all rows.
 * @param {Run} run @param {WrittenBranch} branch @returns {string[]} */
function stabilitiesAlong(run, branch) {
  if (branch.form === "jump") return Array(branch.rows).fill("moving");
  const [driven, dead, constrained] = ["index", "index_force", "index_driven"].map(n => valuesAlong(run, branch, columnOf(run, n)));
  return Array.from({length: branch.rows}, (_, i) => stabilityOf(driven[i], dead[i], constrained[i]));
}

/** @param {number} value @param {number} [rounding]  what is no larger is zero */
function brief(value, rounding) {
  if (Number.isNaN(value)) return "";
  return Math.abs(value) <= (rounding || 0) ? "0" : String(Number(value.toPrecision(7)));
}

/** A value in words.
 * @param {Run} run @param {WrittenBranch} branch @param {number} row @param {number} column */
function wordsAt(run, branch, row, column) {
  if (column < 0) return "";
  const value = valueAt(run, branch, row, column), {name, rounding} = run.quantities[column];
  const isLeast = ["index", "index_force", "index_pose"].includes(name) && value >= 1 && branch.rests.includes(row);
  return isLeast ? ">= 1" : brief(value, rounding);
}
