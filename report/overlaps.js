"use strict";
// Dashed lines that lie on lines: their dashes would fill each other's gaps and look like one solid line. As the figures have it
// (src/drawing/overlaps.cpp).

/**
 * A line of one style on the screen. Lines are drawn by their place, then by their rank; rank 0 is solid and never covered.
 * @typedef {{curve: number, place: number, rank: number, spots: number[]}} RankedLine
 * @typedef {{isWhole: boolean, stretches: number[][], beneath: number[][]}} SeenLine
 *   whole: drawn as it is; else what is drawn of it, and where it lies on a line of a lower rank
 */

// All in units of the diagram, about a pixel.
/** Lines are looked at in pieces of about this length. */ const pieceLength = 3;
/** Nearer lines lie on each other. */ const nearLines = 2;
/** Of the grid in which near pieces are looked up. */ const cellSize = 4;
/** About one period of the shorter dashes, and more than a crossing. */ const shortestOverlap = 18;
/** Along one curve: nearer pieces belong to the same turn. */ const sameTurn = 40;
/** Nearer ones of one turn run back on the same way. */ const sameWay = 0.5;
/** Sine of the largest angle between lines that lie on each other. */ const nearlyParallel = 0.25;
/** Dots of a motion lie on dots alone: they say nothing about stability. */ const rankOfMotions = 4;

/** Pieces that are drawn, found by their places. */
class DrawnPieces {
  constructor() {
    /** @type {Map<number, number[]>} numbers of pieces in a cell */ this.cells = new Map();
    /** @type {number[]} middle, direction, curve, way along it, rank: seven numbers each */ this.all = [];
  }

  /** @param {number} i @param {number} j */
  cell(i, j) { return 65536 * i + j; }

  /** @param {number[]} piece */
  add(piece) {
    const cell = this.cell(Math.floor(piece[0] / cellSize), Math.floor(piece[1] / cellSize)), there = this.cells.get(cell);
    if (there) there.push(this.all.length); else this.cells.set(cell, [this.all.length]);
    this.all.push(...piece);
  }

  /** 0: nothing that is drawn covers the piece, 1: a line of its rank does, 2: one of a lower rank.
   * @param {number[]} piece */
  coverOf([x, y, dx, dy, curve, along, rank]) {
    const i = Math.floor(x / cellSize), j = Math.floor(y / cellSize), {all} = this;
    let cover = 0;
    for (let di = -1; di <= 1; ++di)
      for (let dj = -1; dj <= 1; ++dj)
        for (const k of this.cells.get(this.cell(i + di, j + dj)) || []) {
          const gx = all[k] - x, gy = all[k + 1] - y;
          if (all[k + 6] > rank || (rank === rankOfMotions && all[k + 6] < rank)) continue;
          const across = Math.abs(gx * dy - gy * dx), isBack = all[k + 2] * dx + all[k + 3] * dy < 0;
          if (all[k + 4] === curve && Math.abs(all[k + 5] - along) < sameTurn && (all[k + 6] !== rank || !isBack || across >= sameWay)) continue;
          if (across >= nearLines || Math.hypot(gx, gy) >= cellSize) continue;
          if (Math.abs(all[k + 2] * dy - all[k + 3] * dx) >= nearlyParallel) continue;
          if (all[k + 6] < rank) return 2;
          cover = 1;
        }
    return cover;
  }
}

/** The part of a straight line that lies in the picture, as shares of it; empty where the second is not larger (Liang, Barsky 1984).
 * @param {number} ax @param {number} ay @param {number} dx @param {number} dy @param {number} width @param {number} height */
function shareInside(ax, ay, dx, dy, width, height) {
  let from = 0, to = 1;
  for (const [at, way, size] of [[ax, dx, width], [ay, dy, height]]) {
    if (way === 0) { if (at < 0 || at > size) to = -1; continue; }
    const a = -at / way, b = (size - at) / way;
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
  }
  return [from, to];
}

/** A line cut into pieces; what lies outside the picture is none of them (null).
 * @param {RankedLine} line @param {number} width @param {number} height @param {number} along way from the curve's begin */
function cutLine({curve, rank, spots}, width, height, along) {
  /** @type {number[]} x and y by turns, one spot more than pieces */ const ends = [spots[0], spots[1]];
  /** @type {(number[] | null)[]} */ const pieces = [];
  /** @type {number[]} of pieces */ const lengths = [];
  for (let i = 2; i < spots.length; i += 2) {
    const ax = spots[i - 2], ay = spots[i - 1], dx = spots[i] - ax, dy = spots[i + 1] - ay, length = Math.hypot(dx, dy);
    const [from, to] = shareInside(ax, ay, dx, dy, width, height);
    const add = (/** @type {number} */ begin, /** @type {number} */ end, /** @type {boolean} */ isSeen) => {
      const t = (begin + end) / 2;
      pieces.push(isSeen && length > 0 ? [ax + t * dx, ay + t * dy, dx / length, dy / length, curve, along + t * length, rank] : null);
      lengths.push((end - begin) * length);
      ends.push(end === 1 ? spots[i] : ax + end * dx, end === 1 ? spots[i + 1] : ay + end * dy);
    };
    if (!(to > from)) add(0, 1, false);
    else {
      const count = Math.max(1, Math.ceil((to - from) * length / pieceLength));
      if (from > 0) add(0, from, false);
      for (let k = 0; k < count; ++k) add(from + (to - from) * k / count, k + 1 === count ? to : from + (to - from) * (k + 1) / count, true);
      if (to < 1) add(to, 1, false);
    }
    along += length;
  }
  return {ends, pieces, lengths};
}

/** Covers that are too short to be more than a crossing do not count.
 * @param {number[]} covers @param {number[]} lengths */
function dropShort(covers, lengths) {
  for (let begin = 0, end = 0; begin < covers.length; begin = end) {
    let length = 0;
    for (end = begin; end < covers.length && (covers[end] === 0) === (covers[begin] === 0); ++end) length += lengths[end];
    if (covers[begin] !== 0 && end - begin < covers.length && length < shortestOverlap) covers.fill(0, begin, end);
  }
}

/**
 * Two curves that lie on each other lose their stability at one place: there the end of one's stable line comes near the begin
 * of the other's unstable line, which lies on a line like itself (1), not on a more stable one (2).
 * @param {number[]} covers @param {number[]} lengths */
function dropShortBetter(covers, lengths) {
  for (let begin = 0, end = 0; begin < covers.length; begin = end) {
    let length = 0;
    for (end = begin; end < covers.length && covers[end] === covers[begin]; ++end) length += lengths[end];
    if (covers[begin] === 2 && (covers[begin - 1] === 1 || covers[end] === 1) && length < shortestOverlap) covers.fill(1, begin, end);
  }
}

/** @param {number[]} ends @param {number[]} covers @returns {SeenLine} */
function seenOf(ends, covers) {
  /** @type {SeenLine} */ const seen = {isWhole: covers.every(c => c === 0), stretches: [], beneath: []};
  for (let begin = 0, end = 0; !seen.isWhole && begin < covers.length; begin = end) {
    for (end = begin; end < covers.length && covers[end] === covers[begin]; ++end);
    if (covers[begin] !== 1) (covers[begin] === 0 ? seen.stretches : seen.beneath).push(ends.slice(2 * begin, 2 * end + 2));
  }
  return seen;
}

/** What is drawn of each line.
 * @param {RankedLine[]} lines  those of one curve follow each other along it @param {number} width @param {number} height
 * @returns {SeenLine[]} */
function withoutOverlaps(lines, width, height) {
  /** @type {SeenLine[]} */ const seen = lines.map(() => ({isWhole: true, stretches: [], beneath: []}));
  if (lines.every(l => l.rank === 0)) return seen;
  /** @type {Map<number, number>} */ const ways = new Map();
  const begins = lines.map(({curve, spots}) => {
    const begin = ways.get(curve) || 0;
    let way = begin;
    for (let i = 2; i < spots.length; i += 2) way += Math.hypot(spots[i] - spots[i - 2], spots[i + 1] - spots[i - 1]);
    ways.set(curve, way);
    return begin;
  });
  const drawn = new DrawnPieces(), order = lines.map((_, i) => i);
  order.sort((a, b) => lines[a].place - lines[b].place || lines[a].rank - lines[b].rank || a - b);
  for (const i of order) {
    const {ends, pieces, lengths} = cutLine(lines[i], width, height, begins[i]);
    const covers = pieces.map(piece => {
      const cover = piece && lines[i].rank > 0 ? drawn.coverOf(piece) : 0;
      if (piece) drawn.add(piece);
      return cover;
    });
    dropShort(covers, lengths);
    dropShortBetter(covers, lengths);
    seen[i] = seenOf(ends, covers);
  }
  return seen;
}
