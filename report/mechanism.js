"use strict";
// The mechanism in one row, drawn from the positions that springfold wrote.

const svgSpace = "http://www.w3.org/2000/svg";

/** @typedef {{x: number, y: number}} Spot */

/** @param {string} stability */
function hasColour(stability) { return ["stable", "driven", "unstable", "critical"].includes(stability); }

/** Distance of the eye in sizes of the mechanism, as in springfold's own drawings. */
const eyeDistance = 2.5;

class MechanismView {
  /** @param {SVGSVGElement} svg @param {Run} run  with a mechanism */
  constructor(svg, run) {
    this.svg = svg;
    this.run = run;
    this.parts = run.mechanisms[0];
    this.width = 560;
    this.height = 420;
    this.scale = this.size = 1;
    this.middle = [0, 0];
    this.centre = [0, 0, 0];
    /** @type {number[][]} */ this.corners = [];
    this.right = this.parts.right;
    this.up = this.parts.up;
    this.isPerspective = false;
    this.largestLoad = 0;
    /** @type {Spot[][]} */ this.arrows = [];
    /** Is there a spring, or what is on an outline, that does not act in some row? */ this.hasIdle = false;
    svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.measure(run);
    this.fit();
  }

  /**
   * The box around all rows of all branches, in space: one scale for all of them.
   * @param {Run} run */
  measure(run) {
    const d = this.parts.dimension, low = [0, 0, 0].fill(Infinity), high = [0, 0, 0].fill(-Infinity);
    this.largestLoad = 0;
    const used = run.mechanisms.map(parts => {
      const points = new Set();
      for (const p of [...parts.links, ...parts.springs]) points.add(p.from).add(p.to);
      for (const p of [...parts.bodies, ...parts.outlines]) for (const i of p.corners) points.add(i);
      return [...points].map(i => d * i);
    });
    const forces = run.mechanisms.map(parts => parts.loads.flatMap((load, i) => load.direction ? [] : [3 * i]));
    for (const branch of run.branches) {
      const {points, loads, springs, outlines} = numbersIn(branch), offsets = offsetsIn(run, branch);
      for (let i = 0; i < springs.length && !this.hasIdle; i += 2) this.hasIdle = springs[i] === 0;
      this.hasIdle ||= outlines.includes(0);
      for (let row = 0; row < branch.rows; ++row) {
        if (offsets.layout[row] < 0) continue;
        for (const offset of used[offsets.layout[row]])
          for (let k = 0; k < d; ++k) {
            const v = points[offsets.points[row] + offset + k];
            if (v < low[k]) low[k] = v;
            if (v > high[k]) high[k] = v;
          }
        for (const offset of forces[offsets.layout[row]])
          this.largestLoad = Math.max(this.largestLoad, sizeOf(loads, offsets.loads[row] + offset) || 0);
      }
    }
    if (d === 2) low[2] = high[2] = 0;
    if (!low.every(Number.isFinite)) { low.fill(0); high.fill(0); }
    this.centre = low.map((v, k) => (v + high[k]) / 2);
    this.size = Math.hypot(...low.map((v, k) => high[k] - v)) || 1;
    this.corners = [0, 1, 2, 3, 4, 5, 6, 7].map(i => [0, 1, 2].map(k => (i >> k) & 1 ? high[k] : low[k]));
  }

  /** The box fills the picture as it is looked at. */
  fit() {
    const seen = this.corners.map(([x, y, z]) => this.project(x, y, z));
    const reach = (/** @type {number} */ k) => [Math.min(...seen.map(s => s[k])), Math.max(...seen.map(s => s[k]))];
    const [left, right] = reach(0), [low, high] = reach(1), margin = 60;
    const across = Math.max((right - left) / (this.width - 2 * margin), (high - low) / (this.height - 2 * margin));
    this.scale = across > 0 && Number.isFinite(across) ? 1 / across : 1;
    this.middle = [(left + right) / 2, (low + high) / 2];
  }

  /** Turns what is seen about the picture's axes [rad]; lengths keep together, so that views stay perpendicular.
   * @param {number} aside @param {number} upwards */
  turn(aside, upwards) {
    const out = cross(this.right, this.up);
    const right = unit(this.right.map((r, k) => Math.cos(aside) * r - Math.sin(aside) * out[k]));
    const behind = cross(right, this.up);
    const up = this.up.map((u, k) => Math.cos(upwards) * u - Math.sin(upwards) * behind[k]);
    const along = right.reduce((sum, r, k) => sum + r * up[k], 0);
    this.right = right;
    this.up = unit(up.map((u, k) => u - along * right[k]));
    this.fit();
  }

  /** Back to how it was looked at first. */
  turnBack() {
    this.right = this.parts.right;
    this.up = this.parts.up;
    this.fit();
  }

  /** A place in the picture's plane [length]: orthographic, or as the eye sees it from the front.
   * @param {number} x @param {number} y @param {number} z */
  project(x, y, z) {
    const v = [x - this.centre[0], y - this.centre[1], z - this.centre[2]], seen = this.turned(v[0], v[1], v[2]);
    if (!this.isPerspective) return seen;
    const out = cross(this.right, this.up), eye = eyeDistance * this.size;
    const near = eye / (eye - (out[0] * v[0] + out[1] * v[1] + out[2] * v[2]));
    return [near * seen[0], near * seen[1]];
  }

  /**
   * World vector to the picture's axes.
   * @param {number} x @param {number} y @param {number} z */
  turned(x, y, z) {
    const r = this.right, u = this.up;
    return [r[0] * x + r[1] * y + r[2] * z, u[0] * x + u[1] * y + u[2] * z];
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
    const numbers = numbersIn(branch), offsets = offsetsIn(this.run, branch), layout = offsets.layout[row];
    if (layout < 0) {
      this.add("text", {x: 20, y: 30}).textContent = "no posture in this row";
      return;
    }
    this.parts = this.run.mechanisms[layout];
    const parts = this.parts, d = parts.dimension, first = offsets.points[row], springs = offsets.springs[row], loads = offsets.loads[row];
    /** @param {number} i @returns {Spot} */
    const at = i => {
      const moves = motion && motion.length === d * parts.points;
      const place = [0, 1, 2].map(k => k >= d ? 0 : numbers.points[first + d * i + k] +
                                                   (moves ? (factor || 0) * motion[d * i + k] : 0));
      return this.spot(this.project(place[0], place[1], place[2]));
    };
    for (const body of parts.bodies)
      this.add("polygon", {points: hullOf(body.corners.map(at)).map(s => `${s.x.toFixed(2)},${s.y.toFixed(2)}`).join(" "),
                           fill: "var(--body)", stroke: `var(--${hasColour(stability) ? stability : "ink"})`, "stroke-width": 2}, body.name);
    for (const base of parts.base) this.drawBase(at(base.at), at(base.towards), reachOf(parts, at, at(base.at)));
    for (const link of parts.links)
      this.line([at(link.from), at(link.to)], link.rail
        ? {stroke: "var(--grey)", "stroke-dasharray": "5 3"}
        : {stroke: `var(--${hasColour(stability) ? stability : "ink"})`, "stroke-width": 3, "stroke-linecap": "round"},
                "chain " + parts.chains[link.chain]);
    parts.outlines.forEach((outline, i) => {
      // No numbers at all: what is on outlines acts in every row.
      const acts = numbers.outlines.length === 0 || numbers.outlines[offsets.outlines[row] + i] > 0;
      this.add(outline.corners.length > 2 ? "polygon" : "polyline",
               {points: outline.corners.map(at).map(s => `${s.x.toFixed(2)},${s.y.toFixed(2)}`).join(" "), class: "outline",
                fill: "none", stroke: acts ? "var(--spring)" : "var(--grey)", "stroke-width": 1.2, "stroke-dasharray": acts ? "5 3" : "3 2"},
               `spring or pressure ${outline.name}${acts ? "" : ", does not act"}`);
    });
    parts.springs.forEach((spring, i) => {
      const k = springs + 2 * i;
      const acts = numbers.springs[k] > 0, force = numbers.springs[k + 1];
      // Bars, and springs where there is no link that could show stability.
      const shows = spring.line && (spring.member || parts.links.every((link) => link.rail));
      const colour = !shows ? "spring" : hasColour(stability) ? stability : "ink";
      const width = spring.member === "strut" ? 4.5 : spring.member === "bar" ? 3 : 1.8;
      /** @type {Object<string, string | number>} */
      const ink = acts ? {stroke: `var(--${colour})`, "stroke-width": width} : {stroke: "var(--grey)", "stroke-dasharray": "3 2"};
      const title = `${spring.member || "spring"} ${spring.name}${acts ? "" : ", does not act"}, force ${brief(force)}`;
      const from = at(spring.from), to = at(spring.to);
      if (spring.member) this.line([from, to], ink, title);
      else if (spring.line && Math.hypot(to.x - from.x, to.y - from.y) < shortestCoil)
        this.add("circle", {cx: to.x, cy: to.y, r: 8, fill: "none", ...ink}, title);
      else if (spring.line) this.line(coilOf(from, to), ink, title);
      else this.line(spiralOf(at(spring.at), at(spring.from), at(spring.to)), ink, title);
    });
    for (const stop of parts.stops) {
      const acts = numbers.springs[springs + 2 * stop.spring] > 0;
      const a = at(stop.at), b = at(stop.tip), long = Math.hypot(b.x - a.x, b.y - a.y) || 1;
      const u = {x: (b.x - a.x) / long, y: (b.y - a.y) / long};
      const ends = stop.slide ? [{x: a.x - 9 * u.y, y: a.y + 9 * u.x}, {x: a.x + 9 * u.y, y: a.y - 9 * u.x}]
                              : [{x: a.x + 14 * u.x, y: a.y + 14 * u.y}, {x: a.x + 25 * u.x, y: a.y + 25 * u.y}];
      this.line(ends, {stroke: acts ? "var(--unstable)" : "var(--grey)", "stroke-width": 2});
    }
    for (const joint of parts.joints) this.drawJoint(joint, at(joint.at), at(joint.axis));
    this.arrows = [];
    parts.loads.forEach((load, i) => this.drawLoad(load, numbers.loads, loads, loads + 3 * i, at(load.at)));
    for (const body of parts.bodies) {
      const o = at(body.origin), k = first + d * body.origin;
      const mark = this.add("circle", {cx: o.x, cy: o.y, r: 2, fill: "var(--ink)", "data-body": body.name,
                                       "data-x": numbers.points[k], "data-y": numbers.points[k + 1]});
      if (d === 3) mark.setAttribute("data-z", String(numbers.points[k + 2]));
    }
    this.drawNames(at);
  }

  /** What the marks mean that occur. */
  words() {
    const parts = this.run.mechanisms, some = (/** @type {(p: Parts) => boolean} */ holds) => parts.some(holds);
    const words = [];
    if (some(p => p.joints.some(j => j.role === "actuated"))) words.push("filled joints are actuated");
    if (some(p => p.joints.some(j => j.role === "preloaded"))) words.push("green joints have a spring");
    if (some(p => p.springs.some(s => s.member === "cable") && p.springs.some(s => s.member === "strut"))) words.push("thin lines are cables, thick ones struts");
    if (this.hasIdle) words.push("grey dashes: a spring that does not act");
    if (some(p => p.outlines.length > 0)) words.push("green dashes: areas, lines or planes that springs and pressures act on");
    if (some(p => p.loads.length > 0)) words.push("arrows: loads, dashed where the study only drives");
    return words.length ? `In the picture ${words.join("; ")}.` : "";
  }

  /** Bodies have names, where these cover no link and no other name.
   * @param {(point: number) => Spot} at */
  drawNames(at) {
    /** @type {number[]} */ const dots = [];
    /** @type {Box[]} */ const boxes = [];
    const room = {left: 0, top: 0, right: this.width, bottom: this.height};
    for (const part of [...this.parts.links, ...this.parts.springs]) {
      const a = at(part.from), b = at(part.to);
      addDots(a.x, a.y, b.x, b.y, dots);
    }
    for (const [a, b] of this.arrows) addDots(a.x, a.y, b.x, b.y, dots);
    for (const body of this.parts.bodies) {
      const o = at(body.origin), place = placeOfName(o.x, o.y, body.name, dots, boxes, room);
      if (!place) continue;
      boxes.push(place.box);
      this.add("text", {x: place.x, y: place.y}).textContent = body.name;
    }
  }

  /** @param {Spot} at @param {Spot} towards @param {number} reach of what is drawn at the place, beyond which it is seen */
  drawBase(at, towards, reach) {
    const dx = at.x - towards.x, dy = at.y - towards.y;
    const away = Math.abs(dx) > Math.abs(dy) ? {x: Math.sign(dx), y: 0} : {x: 0, y: Math.sign(dy) || 1};
    const c = {x: at.x + reach * away.x, y: at.y + reach * away.y}, along = {x: -away.y, y: away.x};
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

  /** @param {Parts["loads"][0]} load @param {Float64Array} loads @param {number} first  of the row @param {number} k  of the load
   * @param {Spot} at */
  drawLoad(load, loads, first, k, at) {
    const size = sizeOf(loads, k);
    if (!(size > 0) || (!load.direction && !(this.largestLoad > 0))) return;
    const acts = this.parts.loads.some((other, j) => !other.direction && other.at === load.at && sizeOf(loads, first + 3 * j) > 0);
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
    this.arrows.push([begin, tip]);
    const back = {x: tip.x - 8 * u.x, y: tip.y - 8 * u.y};
    this.line([{x: back.x - 4 * u.y, y: back.y + 4 * u.x}, tip, {x: back.x + 4 * u.y, y: back.y - 4 * u.x}], {...ink, "stroke-dasharray": "none"}, title);
  }
}

/** Of a vector within an array.
 * @param {Float64Array} all @param {number} at */
function sizeOf(all, at) { return Math.hypot(all[at], all[at + 1], all[at + 2]); }

/** @param {number[]} a @param {number[]} b */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {number[]} v */
function unit(v) {
  const long = Math.hypot(...v) || 1;
  return v.map(c => c / long);
}

/** How far joints and spirals at a place reach, with their lines [pixel].
 * @param {Parts} parts @param {(point: number) => Spot} at @param {Spot} place */
function reachOf(parts, at, place) {
  const isThere = (/** @type {number} */ point) => Math.hypot(at(point).x - place.x, at(point).y - place.y) < 1;
  const springs = parts.springs.filter(spring => !spring.line && isThere(spring.at)).map(() => spiralRadius + 2);
  const slides = parts.joints.filter(joint => joint.shape === "prismatic" && isThere(joint.at)).map(() => 10);
  return Math.max(7, ...springs, ...slides);
}

/** Of the outer end of a spiral [pixel]. */
const spiralRadius = 13;

/** Pixels: below it a coil is a blot, and a ring stands for it. */
const shortestCoil = 8;

/** @param {Spot} from @param {Spot} to @returns {Spot[]} */
function coilOf(from, to) {
  const dx = to.x - from.x, dy = to.y - from.y, long = Math.hypot(dx, dy);
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
    const t = i / 40, r = 7 + (spiralRadius - 7) * t, a = from + t * sweep;
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
