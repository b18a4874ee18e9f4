"use strict";
// What springfold wrote into the page, as numbers.

/**
 * @typedef {{name: string, unit: string}} Quantity
 * @typedef {{label: string, code: string, row: number, detail: string, sentence: string, motion?: string,
 *            stiffness?: number[][]}} SpecialPoint
 * @typedef {{file: string, rows: number, start: number, stops: string[], values: string, points: string,
 *            springs: string, loads: string, events: SpecialPoint[]}} WrittenBranch
 * @typedef {{dimension: number, points: number, right: number[], up: number[], chains: string[],
 *            links: {from: number, to: number, chain: number, rail: boolean}[],
 *            joints: {name: string, shape: string, role: string, at: number, axis: number}[],
 *            springs: {name: string, line: boolean, from: number, at: number, to: number}[],
 *            stops: {spring: number, at: number, tip: number, slide: boolean}[],
 *            bodies: {name: string, origin: number, corners: number[]}[],
 *            loads: {name: string, at: number, moment: boolean, direction: boolean, weight: boolean}[],
 *            base: {at: number, towards: number}[], names: {name: string, at: number}[]}} Parts
 * @typedef {{study: string, run: number, label: string, kind: string, control: string,
 *            parameters: Object<string, number>, start: string, doubts: string[], quantities: Quantity[],
 *            branches: WrittenBranch[], mechanism?: Parts}} Run
 * @typedef {{version: string, title: string, case: string, hash: string, runs: Run[]}} Page
 * @typedef {{values: Float64Array, points: Float64Array, springs: Float64Array, loads: Float64Array}} Numbers
 */

/** @param {string} text @returns {Float64Array} */
function numbersOf(text) {
  const bytes = atob(text);
  const view = new DataView(new ArrayBuffer(bytes.length));
  for (let i = 0; i < bytes.length; ++i) view.setUint8(i, bytes.charCodeAt(i));
  const numbers = new Float64Array(bytes.length / 8);
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
               springs: numbersOf(branch.springs), loads: numbersOf(branch.loads)};
    decoded.set(branch, numbers);
  }
  return numbers;
}

/** @param {Run} run @param {string} name @returns {number} */
function columnOf(run, name) {
  return run.quantities.findIndex(q => q.name === name);
}

/** @param {Run} run @param {WrittenBranch} branch @param {number} row @param {number} column */
function valueAt(run, branch, row, column) {
  return column < 0 ? NaN : numbersIn(branch).values[row * run.quantities.length + column];
}

/** Stability of a row: a class of the style sheet.
 * @param {Run} run @param {WrittenBranch} branch @param {number} row */
function stabilityAt(run, branch, row) {
  const driven = valueAt(run, branch, row, columnOf(run, "index"));
  const dead = valueAt(run, branch, row, columnOf(run, "index_force"));
  const constrained = valueAt(run, branch, row, columnOf(run, "index_driven"));
  if (driven > 0) return constrained === 0 ? "driven" : "unstable";
  if (Number.isNaN(dead)) return "unknown";
  if (dead === 0) return "stable";
  return driven === 0 ? "driven" : "unstable";
}

/** @param {number} value */
function brief(value) {
  return Number.isNaN(value) ? "" : String(Number(value.toPrecision(7)));
}
