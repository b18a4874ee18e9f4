"use strict";
// The mechanism in one row, drawn from the positions that springfold wrote.

const svgSpace = "http://www.w3.org/2000/svg";

/** @typedef {{x: number, y: number}} Spot */

class MechanismView {
  /** @param {SVGSVGElement} svg @param {Run} run @param {Parts} parts */
  constructor(svg, run, parts) {
    this.svg = svg;
    this.parts = parts;
    this.width = 560;
    this.height = 420;
    this.scale = this.size = 1;
    this.middle = [0, 0];
    this.largestLoad = 0;
    svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.fit(run);
  }

  /**
   * One scale for all rows of all branches.
   * @param {Run} run */
  fit(run) {
    let left = Infinity, right = -Infinity, low = Infinity, high = -Infinity;
    this.largestLoad = 0;
    const used = new Set();
    for (const p of this.parts.links) used.add(p.from).add(p.to);
    for (const p of this.parts.springs) used.add(p.from).add(p.to);
    for (const p of this.parts.bodies) for (const i of p.corners) used.add(i);
    for (const branch of run.branches) {
      const numbers = numbersIn(branch);
      for (let row = 0; row < branch.rows; ++row) {
        for (const i of used) {
          const [x, y] = this.seen(numbers.points, row, i);
          if (Number.isNaN(x)) continue;
          left = Math.min(left, x); right = Math.max(right, x);
          low = Math.min(low, y); high = Math.max(high, y);
        }
        for (let i = 0; i < this.parts.loads.length; ++i)
          if (!this.parts.loads[i].direction)
            this.largestLoad = Math.max(this.largestLoad, this.loadSize(numbers.loads, row, i) || 0);
      }
    }
    const margin = 60;
    const across = Math.max((right - left) / (this.width - 2 * margin), (high - low) / (this.height - 2 * margin));
    this.scale = across > 0 && Number.isFinite(across) ? 1 / across : 1;
    this.middle = [(left + right) / 2, (low + high) / 2];
    this.size = Math.hypot(right - left, high - low) || 1;
  }

  /** @param {Float64Array} loads @param {number} row @param {number} i */
  loadSize(loads, row, i) {
    const at = 3 * (row * this.parts.loads.length + i);
    return Math.hypot(loads[at], loads[at + 1], loads[at + 2]);
  }

  /**
   * World vector to the picture's axes.
   * @param {number} x @param {number} y @param {number} z */
  turned(x, y, z) {
    const r = this.parts.right, u = this.parts.up;
    return [r[0] * x + r[1] * y + r[2] * z, u[0] * x + u[1] * y + u[2] * z];
  }

  /** @param {Float64Array} points @param {number} row @param {number} i */
  seen(points, row, i) {
    const d = this.parts.dimension, at = d * (row * this.parts.points + i);
    return this.turned(points[at], points[at + 1], d === 3 ? points[at + 2] : 0);
  }

  /** @param {number[]} seen @returns {Spot} */
  spot(seen) {
    return {x: this.width / 2 + this.scale * (seen[0] - this.middle[0]),
            y: this.height / 2 - this.scale * (seen[1] - this.middle[1])};
  }

  /** @param {string} name @param {Object<string, string|number>} attributes @param {string} [title] */
  add(name, attributes, title) {
    const element = document.createElementNS(svgSpace, name);
    for (const key of Object.keys(attributes)) element.setAttribute(key, String(attributes[key]));
    if (title) {
      const words = document.createElementNS(svgSpace, "title");
      words.textContent = title;
      element.appendChild(words);
    }
    this.svg.appendChild(element);
    return element;
  }

  /** @param {Spot[]} spots @param {Object<string, string|number>} attributes @param {string} [title] */
  line(spots, attributes, title) {
    const points = spots.map(s => `${s.x.toFixed(2)},${s.y.toFixed(2)}`).join(" ");
    this.add("polyline", {points, fill: "none", ...attributes}, title);
  }

  /** @param {WrittenBranch} branch @param {number} row @param {string} stability
   * @param {Float64Array} [motion] of all points, to be added @param {number} [factor] of it */
  draw(branch, row, stability, motion, factor) {
    while (this.svg.firstChild) this.svg.removeChild(this.svg.firstChild);
    const numbers = numbersIn(branch), parts = this.parts, d = parts.dimension;
    if (Number.isNaN(numbers.points[d * row * parts.points])) {
      this.add("text", {x: 20, y: 30}).textContent = "no posture in this row";
      return;
    }
    /** @param {number} i @returns {Spot} */
    const at = i => {
      const seen = this.seen(numbers.points, row, i);
      if (motion && motion.length === d * parts.points) {
        const by = this.turned(motion[d * i], motion[d * i + 1], d === 3 ? motion[d * i + 2] : 0);
        seen[0] += (factor || 0) * by[0];
        seen[1] += (factor || 0) * by[1];
      }
      return this.spot(seen);
    };
    for (const body of parts.bodies)
      this.add("polygon", {points: hullOf(body.corners.map(at)).map(s => `${s.x.toFixed(2)},${s.y.toFixed(2)}`).join(" "),
                           fill: "var(--body)", stroke: `var(--${stability === "unknown" ? "ink" : stability})`, "stroke-width": 2}, body.name);
    for (const base of parts.base) this.drawBase(at(base.at), at(base.towards));
    for (const link of parts.links)
      this.line([at(link.from), at(link.to)], link.rail
        ? {stroke: "var(--grey)", "stroke-dasharray": "5 3"}
        : {stroke: `var(--${stability === "unknown" ? "ink" : stability})`, "stroke-width": 3, "stroke-linecap": "round"},
                "chain " + parts.chains[link.chain]);
    parts.springs.forEach((spring, i) => {
      const k = 2 * (row * parts.springs.length + i);
      const acts = numbers.springs[k] > 0, force = numbers.springs[k + 1];
      // Bars between nodes, perhaps on rollers: there is no link that could show stability.
      const shows = spring.line && parts.links.every((link) => link.rail);
      const colour = !shows ? "spring" : stability === "unknown" ? "ink" : stability;
      /** @type {Object<string, string | number>} */
      const ink = acts ? {stroke: `var(--${colour})`, "stroke-width": 1.8} : {stroke: "var(--grey)", "stroke-dasharray": "3 2"};
      const title = `spring ${spring.name}${acts ? "" : ", does not act"}, force ${brief(force)}`;
      if (spring.line) this.line(coilOf(at(spring.from), at(spring.to)), ink, title);
      else this.line(spiralOf(at(spring.at), at(spring.from), at(spring.to)), ink, title);
    });
    for (const stop of parts.stops) {
      const acts = numbers.springs[2 * (row * parts.springs.length + stop.spring)] > 0;
      const a = at(stop.at), b = at(stop.tip), long = Math.hypot(b.x - a.x, b.y - a.y) || 1;
      const u = {x: (b.x - a.x) / long, y: (b.y - a.y) / long};
      const ends = stop.slide ? [{x: a.x - 9 * u.y, y: a.y + 9 * u.x}, {x: a.x + 9 * u.y, y: a.y - 9 * u.x}]
                              : [{x: a.x + 14 * u.x, y: a.y + 14 * u.y}, {x: a.x + 25 * u.x, y: a.y + 25 * u.y}];
      this.line(ends, {stroke: acts ? "var(--unstable)" : "var(--grey)", "stroke-width": 2});
    }
    for (const joint of parts.joints) this.drawJoint(joint, at(joint.at), at(joint.axis));
    parts.loads.forEach((load, i) => this.drawLoad(load, i, numbers.loads, row, at(load.at)));
    for (const body of parts.bodies) {
      const o = at(body.origin), k = d * (row * parts.points + body.origin);
      const mark = this.add("circle", {cx: o.x, cy: o.y, r: 2, fill: "var(--ink)", "data-body": body.name,
                                       "data-x": numbers.points[k], "data-y": numbers.points[k + 1]});
      if (d === 3) mark.setAttribute("data-z", String(numbers.points[k + 2]));
      this.add("text", {x: o.x + 9, y: o.y - 9}).textContent = body.name;
    }
  }

  /** @param {Spot} at @param {Spot} towards */
  drawBase(at, towards) {
    const dx = at.x - towards.x, dy = at.y - towards.y;
    const away = Math.abs(dx) > Math.abs(dy) ? {x: Math.sign(dx), y: 0} : {x: 0, y: Math.sign(dy) || 1};
    const c = {x: at.x + 7 * away.x, y: at.y + 7 * away.y}, along = {x: -away.y, y: away.x};
    this.line([-10, 10].map(s => ({x: c.x + s * along.x, y: c.y + s * along.y})), {stroke: "var(--grey)", "stroke-width": 1.5});
    for (let s = -8; s <= 10; s += 5)
      this.line([{x: c.x + s * along.x, y: c.y + s * along.y},
                 {x: c.x + (s - 4) * along.x + 6 * away.x, y: c.y + (s - 4) * along.y + 6 * away.y}], {stroke: "var(--grey)"});
  }

  /** @param {Parts["joints"][0]} joint @param {Spot} at @param {Spot} axis */
  drawJoint(joint, at, axis) {
    const ink = {fill: joint.role === "actuated" ? "var(--ink)" : "var(--paper)", "stroke-width": 1.5,
                 stroke: joint.role === "preloaded" ? "var(--spring)" : joint.role === "virtual" ? "var(--grey)" : "var(--ink)"};
    const title = joint.name || "free to turn";
    if (joint.shape === "prismatic") {
      const turn = Math.atan2(axis.y - at.y, axis.x - at.x) * 180 / Math.PI;
      this.add("rect", {x: -8, y: -5, width: 16, height: 10, transform: `translate(${at.x.toFixed(2)},${at.y.toFixed(2)}) rotate(${turn.toFixed(2)})`, ...ink}, title);
    } else if (joint.shape === "elastic") {
      this.add("rect", {x: -4, y: -4, width: 8, height: 8, transform: `translate(${at.x.toFixed(2)},${at.y.toFixed(2)}) rotate(45)`, ...ink}, title);
    } else {
      const radius = joint.shape === "pin" ? 4 : joint.shape === "spherical" ? 6.5 : 5;
      this.add("circle", {cx: at.x, cy: at.y, r: radius, ...ink}, title);
      if (joint.shape === "spherical") this.add("circle", {cx: at.x, cy: at.y, r: 2.5, fill: ink.stroke}, title);
      if (joint.shape !== "universal") return;
      this.line([{x: at.x - 5, y: at.y}, {x: at.x + 5, y: at.y}], {stroke: ink.stroke}, title);
      this.line([{x: at.x, y: at.y - 5}, {x: at.x, y: at.y + 5}], {stroke: ink.stroke}, title);
    }
  }

  /** @param {Parts["loads"][0]} load @param {number} i @param {Float64Array} loads @param {number} row @param {Spot} at */
  drawLoad(load, i, loads, row, at) {
    const k = 3 * (row * this.parts.loads.length + i), size = this.loadSize(loads, row, i);
    if (!(size > 0) || (!load.direction && !(this.largestLoad > 0))) return;
    const acts = this.parts.loads.some((other, j) => !other.direction && other.at === load.at && this.loadSize(loads, row, j) > 0);
    if (load.direction && acts) return;
    const ink = {stroke: "var(--load)", "stroke-width": load.weight ? 1.2 : 2, "stroke-dasharray": load.direction ? "4 3" : "none"};
    const title = load.direction ? "direction of the study" : `${load.name || (load.moment ? "moment" : "force")} ${brief(size)}`;
    const seen = this.turned(loads[k] / size, loads[k + 1] / size, loads[k + 2] / size);
    const long = load.direction ? 40 : 20 + 40 * size / this.largestLoad;
    const u = {x: seen[0], y: -seen[1]};
    if (load.moment || Math.hypot(u.x, u.y) < 0.2) {
      this.add("circle", {cx: at.x, cy: at.y, r: 13, fill: "none", ...ink}, title);
      return;
    }
    const begin = {x: at.x + 8 * u.x, y: at.y + 8 * u.y}, tip = {x: at.x + (8 + long) * u.x, y: at.y + (8 + long) * u.y};
    this.line([begin, tip], ink, title);
    const back = {x: tip.x - 8 * u.x, y: tip.y - 8 * u.y};
    this.line([{x: back.x - 4 * u.y, y: back.y + 4 * u.x}, tip, {x: back.x + 4 * u.y, y: back.y - 4 * u.x}], {...ink, "stroke-dasharray": "none"}, title);
  }
}

/** @param {Spot} from @param {Spot} to @returns {Spot[]} */
function coilOf(from, to) {
  const dx = to.x - from.x, dy = to.y - from.y, long = Math.hypot(dx, dy);
  if (long < 8) return [from, to];
  const side = Math.min(7, 0.3 * long), n = {x: -dy / long * side, y: dx / long * side};
  const spots = [from, {x: from.x + 0.18 * dx, y: from.y + 0.18 * dy}];
  for (let i = 0; i < 12; ++i) {
    const t = 0.18 + 0.64 * (i + 0.5) / 12, s = i % 2 === 0 ? 1 : -1;
    spots.push({x: from.x + t * dx + s * n.x, y: from.y + t * dy + s * n.y});
  }
  spots.push({x: from.x + 0.82 * dx, y: from.y + 0.82 * dy}, to);
  return spots;
}

/** @param {Spot} centre @param {Spot} begin @param {Spot} end @returns {Spot[]} */
function spiralOf(centre, begin, end) {
  const from = Math.atan2(centre.y - begin.y, begin.x - centre.x), to = Math.atan2(centre.y - end.y, end.x - centre.x);
  let sweep = Math.atan2(Math.sin(to - from), Math.cos(to - from));
  sweep += sweep < 0 ? -2 * Math.PI : 2 * Math.PI;
  return Array.from({length: 41}, (_, i) => {
    const t = i / 40, r = 7 + 6 * t, a = from + t * sweep;
    return {x: centre.x + r * Math.cos(a), y: centre.y - r * Math.sin(a)};
  });
}

/**
 * Convex hull, Andrew's monotone chain.
 * @param {Spot[]} spots @returns {Spot[]} */
function hullOf(spots) {
  const sorted = spots.slice().sort((a, b) => a.x - b.x || a.y - b.y);
  if (sorted.length < 3) return sorted;
  /** @type {Spot[]} */
  const around = [];
  for (const pass of [sorted, sorted.slice().reverse()]) {
    const first = around.length;
    for (const p of pass) {
      for (;;) {
        const a = around[around.length - 2], b = around[around.length - 1];
        if (around.length < first + 2 || (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) break;
        around.pop();
      }
      around.push(p);
    }
    around.pop();
  }
  return around;
}
