"use strict";
// Puts the page together: choices, keys, tables.

/** @param {string} id @returns {any} */
function byId(id) { return document.getElementById(id); }

/** @param {HTMLElement} parent @param {string} name @param {string} [text] @returns {any} */
function append(parent, name, text) {
  const element = document.createElement(name);
  if (text !== undefined) element.textContent = text;
  parent.appendChild(element);
  return element;
}

/** @param {HTMLSelectElement} select @param {string[]} texts */
function fill(select, texts) {
  select.textContent = "";
  texts.forEach((text, i) => { append(select, "option", text).value = String(i); });
}

/** What a line, mark or colour says.
 * @type {Object<string, string>} */
const kindWords = {stable: "stable under dead load", driven: "held as driven, unstable under dead load", unstable: "unstable",
                   critical: "critical, stability ends here", unknown: "stability not known", moving: "a jump",
                   mixed: "with a less stable one on it"};

class ReportPage {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.run = page.runs[0];
    this.branch = this.row = 0;
    this.plays = false;
    /** Number of the motion at a special point that is played, -1: none. */ this.moves = -1;
    /** @type {MechanismView | null} */ this.view = null;
    /** @type {MapView | null} */ this.map = null;
    this.shownTables = "";
    this.diagram = new Diagram(byId("diagram"), (branch, row) => { this.stop(); this.go(branch, row); });
    byId("title").textContent = page.title || page.case;
    byId("subtitle").textContent = `${page.case}, springfold ${page.version}`;
    byId("made").textContent = `Made by springfold ${page.version} from ${page.case}, hash ${page.hash}.`;
    fill(byId("run"), page.runs.map(r => `${r.study}, run ${r.run}${r.label ? `: ${r.label}` : ""}`));
    this.listen();
    if (page.runs.length) this.showRun(Math.max(0, page.runs.findIndex(r => r.branches.some(b => b.rows > 1))));
  }

  listen() {
    byId("run").addEventListener("change", () => this.showRun(Number(byId("run").value)));
    byId("branch").addEventListener("change", () => this.go(Number(byId("branch").value), 0));
    byId("row").addEventListener("input", () => { this.stop(); this.go(this.branch, Number(byId("row").value)); });
    byId("others").addEventListener("change", () => this.showAxes());
    byId("perspective").addEventListener("change", () => this.look());
    byId("colour").addEventListener("change", () => {
      if (this.map) this.map.choose(Number(byId("colour").value));
      this.showAxes();
    });
    this.listenToTurns();
    for (const id of ["x", "y"]) byId(id).addEventListener("change", () => this.showAxes());
    byId("play").addEventListener("click", () => this.plays ? this.stop() : this.play());
    byId("reset").addEventListener("click", () => this.reset());
    document.addEventListener("keydown", event => {
      const target = /** @type {HTMLElement} */ (event.target);
      if (["SELECT", "INPUT", "BUTTON"].includes(target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (this.key(event.key, event.shiftKey ? 10 : 1)) event.preventDefault();
    });
  }

  /** A mechanism in space is turned with the mouse: half a turn for the width of the picture. */
  listenToTurns() {
    const svg = byId("mechanism");
    svg.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      if (this.view && this.view.parts.dimension === 3) svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      if (!this.view || !svg.hasPointerCapture(event.pointerId)) return;
      const width = svg.getBoundingClientRect().width;
      this.view.turn(Math.PI * event.movementX / width, Math.PI * event.movementY / width);
      this.drawPosture();
    });
  }

  reset() {
    if (this.view) { this.view.turnBack(); this.drawPosture(); }
    this.showAxes();
  }

  /** Perspective or not. */
  look() {
    if (!this.view) return;
    this.view.isPerspective = byId("perspective").checked && this.view.parts.dimension === 3;
    this.view.fit();
    this.drawPosture();
  }

  /** @param {string} key @param {number} by @returns {boolean} */
  key(key, by) {
    const map = this.map, line = map ? map.wide : 0, plane = map ? map.wide * map.tall : 0;
    const last = this.run.branches.length ? this.run.branches[this.branch].rows - 1 : 0;
    switch (key) {
      case "ArrowRight": this.stop(); this.go(this.branch, this.row + by); return true;
      case "ArrowLeft": this.stop(); this.go(this.branch, this.row - by); return true;
      case "Home": this.stop(); this.go(this.branch, 0); return true;
      case "End": this.stop(); this.go(this.branch, last); return true;
      case "n": this.stop(); this.special(1); return true;
      case "p": this.stop(); this.special(-1); return true;
      case " ": if (this.plays) this.stop(); else this.play(); return true;
      case "ArrowUp": if (map) this.go(0, this.row + by * line); return map !== null;
      case "ArrowDown": if (map) this.go(0, this.row - by * line); return map !== null;
      case "PageUp": if (map) this.go(0, this.row + plane); return map !== null;
      case "PageDown": if (map) this.go(0, this.row - plane); return map !== null;
      case "b": if (this.run.branches.length) { this.stop(); this.go((this.branch + 1) % this.run.branches.length, 0); } return true;
      case "r": this.reset(); return true;
      case "v": byId("perspective").checked = !byId("perspective").checked; this.look(); return true;
      case "m": this.vibrate(this.moves + 1); return true;
    }
    return false;
  }

  /**
   * The next special point of the branch.
   * @param {number} way */
  special(way) {
    if (!this.run.branches.length) return;
    const rows = this.run.branches[this.branch].events.map(e => e.row).sort((a, b) => way * (a - b));
    const next = rows.find(row => way * (row - this.row) > 0);
    if (next !== undefined) this.go(this.branch, next);
  }

  /** @param {number} number */
  showRun(number) {
    this.stop();
    this.run = this.page.runs[number];
    const run = this.run;
    this.branch = this.row = 0;
    byId("run").value = String(number);
    fill(byId("x"), run.quantities.map(q => q.title));
    fill(byId("y"), run.quantities.map(q => q.title));
    const column = (/** @type {string} */ name) => String(Math.max(0, columnOf(run, name)));
    byId("x").value = column(run.axes[0]);
    byId("y").value = column(run.axes[1]);
    this.map = run.map && run.map.axes.length > 1 && run.branches.length ? new MapView(run, run.map) : null;
    fill(byId("colour"), this.map ? run.quantities.map(q => q.title) : []);
    if (this.map) byId("colour").value = String(this.map.column);
    byId("colour-choice").hidden = !this.map;
    byId("x").disabled = byId("y").disabled = this.map !== null;
    byId("others-choice").hidden = this.otherRuns().length === 0;
    fill(byId("branch"), run.branches.map(b => b.name));
    this.view = run.mechanisms.length ? new MechanismView(byId("mechanism"), run) : null;
    if (!this.view) byId("mechanism").textContent = "";
    const isSpatial = this.view !== null && this.view.parts.dimension === 3;
    byId("perspective-choice").hidden = !isSpatial;
    byId("mechanism").classList.toggle("turns", isSpatial);
    this.look();
    this.diagram.branch = this.diagram.row = 0;
    this.showAxes();
    this.showTables();
    byId("parts").textContent = this.view ? this.view.words() : "";
    this.go(0, run.branches.length ? run.branches[0].start : 0);
  }

  /** Runs of the same study, whose curves stand behind those of this one; none where there are very many. */
  otherRuns() {
    const most = 60;
    const others = this.page.runs.filter(r => r !== this.run && r.study === this.run.study && !r.map &&
                                              r.quantities.length === this.run.quantities.length);
    return others.length < most ? others : [];
  }

  showAxes() {
    this.diagram.show(this.run, Number(byId("x").value), Number(byId("y").value), byId("others").checked ? this.otherRuns() : [],
                      this.map);
    this.showKey();
  }

  /** The lines and marks that the diagram has, each with what it means; of a map its colours. */
  showKey() {
    const key = byId("key");
    key.textContent = this.map ? this.map.words() : "";
    if (this.map) { append(key, "span").className = "ramp"; return; }
    const lines = [...kindsOfLines, "mixed"].filter(kind => this.diagram.kinds.has(kind));
    for (const kind of lines) this.addSample(key, kind === "mixed" ? ["mixed", "stable"] : [kind], "M0,5H44", kindWords[kind]);
    const points = this.diagram.plots.filter(p => p.branch.form === "points").flatMap(p => p.kinds);
    for (const kind of kindsOfLines.filter(kind => points.includes(kind))) this.addSample(key, [kind], "", kindWords[kind]);
  }

  /** @param {HTMLElement} key @param {string[]} kinds @param {string} path  of lines; empty: a mark @param {string} words */
  addSample(key, kinds, path, words) {
    const entry = append(key, "span"), image = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    entry.className = "entry";
    entry.dataset.kind = kinds[0];
    image.setAttribute("viewBox", path ? "0 0 44 10" : "0 0 14 14");
    for (const kind of kinds) {
      const mark = document.createElementNS("http://www.w3.org/2000/svg", path ? "path" : "circle");
      const attributes = path ? {class: `curve ${kind}`, d: path} : {class: `special ${kind}`, cx: 7, cy: 7, r: 5};
      for (const [name, value] of Object.entries(attributes)) mark.setAttribute(name, String(value));
      image.appendChild(mark);
    }
    entry.appendChild(image);
    entry.appendChild(document.createTextNode(` ${words} `));
  }

  /** The special points of all runs of the study; of a sweep beside the values that it varies. */
  showTables() {
    const run = this.run, events = byId("events"), parameters = byId("parameters"), files = byId("files");
    for (const element of [parameters, files]) element.textContent = "";
    if (this.shownTables !== run.study) {
      this.shownTables = run.study;
      events.textContent = "";
      this.fillEvents(events, this.page.runs.filter(r => r.study === run.study));
      byId("special").hidden = events.tBodies[0].rows.length === 0;
    }
    for (const name of Object.keys(run.parameters)) {
      const line = append(parameters, "tr");
      append(line, "td", this.withUnit(name));
      append(line, "td", String(run.parameters[name]));
    }
    for (const file of new Set([...run.branches.map(b => b.file), run.table, "events.csv", "summary.json"])) {
      if (!file) continue;
      const link = append(append(files, "li"), "a", file);
      link.href = file.split("/").map(encodeURIComponent).join("/");
    }
  }

  /**
   * A parameter with the unit that the case gives it.
   * @param {string} name @returns {string} */
  withUnit(name) {
    const unit = this.page.units[name];
    return unit ? `${name} [${unit}]` : name;
  }

  /** @param {HTMLElement} table @param {Run[]} runs */
  fillEvents(table, runs) {
    const names = ["lambda", "deflection", "force", "index", "index_force", "K_eig1"].filter(n => runs.some(r => columnOf(r, n) >= 0));
    const varied = runs.length > 1 ? this.run.varied : [];
    const head = append(append(table, "thead"), "tr"), body = append(table, "tbody");
    for (const text of ["point", ...(runs.length > 1 ? ["run"] : []), ...varied.map(n => this.withUnit(n)), "branch", ...names.map(n => this.run.quantities.find(q => q.name === n)?.title ?? n), "what"]) append(head, "th", text);
    for (const run of runs)
      run.branches.forEach((branch, k) => branch.events.forEach(event => {
        const line = append(body, "tr"), number = this.page.runs.indexOf(run);
        line.dataset.run = number;
        line.dataset.branch = k;
        line.dataset.row = event.row;
        append(line, "td", event.label);
        if (runs.length > 1) append(line, "td", String(run.run));
        for (const name of varied) append(line, "td", brief(run.parameters[name] ?? NaN));
        append(line, "td", branch.name);
        for (const name of names) append(line, "td", wordsAt(run, branch, event.row, columnOf(run, name)));
        append(line, "td", event.detail);
        line.addEventListener("click", () => {
          this.stop();
          if (this.run !== run) this.showRun(number);
          this.go(k, event.row);
        });
      }));
  }

  drawPosture() {
    const b = this.run.branches[this.branch];
    if (this.view && b) this.view.draw(b, this.row, stabilityAt(this.run, b, this.row));
  }

  /** @param {number} branch @param {number} row */
  go(branch, row) {
    const run = this.run;
    this.moves = -1;
    document.body.classList.toggle("no-rows", !run.branches.length);
    if (!run.branches.length) {
      byId("point").textContent = run.start ? `No start point: ${run.start}` : "Of this run the table of its study has a row, and no curve was kept.";
      byId("values").textContent = byId("posture").textContent = byId("key").textContent = "";
      delete byId("values").dataset.run;
      return;
    }
    this.branch = branch;
    const b = run.branches[branch];
    this.row = Math.max(0, Math.min(row, b.rows - 1));
    const slider = byId("row");
    slider.max = String(b.rows - 1);
    slider.value = String(this.row);
    byId("branch").value = String(branch);
    this.diagram.go(branch, this.row);
    const stability = stabilityAt(run, b, this.row);
    if (this.view) this.view.draw(b, this.row, stability);
    const status = b.status ? b.status.texts[b.status.of[this.row]] : "";
    byId("shown").textContent = `${run.study}, run ${run.run}${run.label ? `: ${run.label}` : ""}`;
    byId("posture").textContent = `${b.name}, row ${this.row + 1} of ${b.rows}: ${stability === "moving" ? "not at rest" : kindWords[stability]}${status ? ` (${status})` : ""}.`;
    this.showPoint();
    this.showValues();
  }

  /** The special points in this row, in words. */
  showPoint() {
    const place = byId("point"), b = this.run.branches[this.branch];
    place.textContent = "";
    for (const event of b.events.filter(e => e.row === this.row)) {
      append(place, "h2", `${event.label}: ${event.detail || event.code}`);
      append(place, "p", event.sentence);
      const values = ["lambda", "deflection", "force"].map(n => this.run.quantities.findIndex(q => q.name === n))
          .filter(i => i >= 0 && wordsAt(this.run, b, this.row, i) !== "")
          .map(i => { const q = this.run.quantities[i]; return `${q.title} = ${wordsAt(this.run, b, this.row, i)}${q.unit ? ` ${q.unit}` : ""}`; });
      if (values.length) append(place, "p", values.join(", "));
      const eigenvalues = ["K_eig1", "K_eig2", "K_eig3"].map(n => wordsAt(this.run, b, this.row, columnOf(this.run, n)))
          .filter(text => text !== "");
      if (eigenvalues.length) append(place, "p", `Eigenvalues of the stiffness: ${eigenvalues.join(", ")}`);
      if (event.stiffness) append(place, "p", `Stiffness: ${event.stiffness.map(r => r.map(v => brief(v)).join("  ")).join(";  ")}`);
    }
    this.motionsHere().forEach(({title}, number) => {
      const button = append(place, "button", title);
      button.type = "button";
      button.addEventListener("click", () => this.vibrate(number));
    });
    for (const line of document.querySelectorAll("#events tbody tr")) {
      const data = /** @type {HTMLElement} */ (line).dataset;
      line.classList.toggle("here", Number(data.run) === this.page.runs.indexOf(this.run) && Number(data.branch) === this.branch && Number(data.row) === this.row);
    }
  }

  showValues() {
    const table = byId("values"), b = this.run.branches[this.branch];
    if (table.dataset.run !== `${this.run.study}/${this.run.run}`) {
      table.textContent = "";
      table.dataset.run = `${this.run.study}/${this.run.run}`;
      for (const q of this.run.quantities) {
        const line = append(table, "tr");
        append(line, "td", q.title + (q.unit ? ` [${q.unit}]` : ""));
        append(line, "td").dataset.quantity = q.name;
      }
    }
    this.run.quantities.forEach((_, i) => {
      const value = valueAt(this.run, b, this.row, i), cell = table.rows[i].cells[1];
      cell.textContent = wordsAt(this.run, b, this.row, i);
      cell.dataset.value = Number.isNaN(value) ? "" : String(value);
    });
  }

  play() {
    if (!this.run.branches.length) return;
    this.plays = true;
    byId("play").textContent = "Stop";
    byId("play").setAttribute("aria-pressed", "true");
    const rows = this.run.branches[this.branch].rows, seconds = 8;
    if (this.row >= rows - 1) this.row = 0;
    const began = performance.now(), first = this.row;
    const frame = (/** @type {number} */ now) => {
      if (!this.plays) return;
      const row = first + Math.floor((now - began) / 1000 / seconds * rows);
      this.go(this.branch, row);
      if (row >= rows - 1) this.stop();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  stop() {
    this.plays = false;
    byId("play").textContent = "Play";
    byId("play").setAttribute("aria-pressed", "false");
  }

  /**
   * What the mechanism can be moved along at the special points of this row: the mode in which it buckles, and the branch.
   * @returns {{title: string, motion: string}[]} */
  motionsHere() {
    const b = this.run.branches[this.branch], modes = [], ways = [];
    for (const event of b && this.view ? b.events.filter(e => e.row === this.row) : []) {
      const several = (event.modes || []).length > 1;
      for (const [k, motion] of (event.modes || []).entries())
        modes.push({title: `Show the buckling mode${several ? ` ${k + 1}` : ""}`, motion});
      if (event.motion) ways.push({title: event.code === "LP" ? "Show the buckling mode" : "Show the motion along the branch", motion: event.motion});
    }
    return [...modes, ...ways].filter(({motion}) => numbersOf(motion).some(v => Math.abs(v) > 0));
  }

  /**
   * Moves the mechanism to and fro along a motion at a special point, much enlarged; the same once more ends it.
   * @param {number} number */
  vibrate(number) {
    this.stop();
    const b = this.run.branches[this.branch], view = this.view, row = this.row, branch = this.branch;
    const chosen = this.motionsHere()[number];
    if (!chosen || !view || this.moves === number) {
      this.moves = -1;
      this.drawPosture();
      return;
    }
    const motion = numbersOf(chosen.motion), d = view.parts.dimension;
    let largest = 0;
    for (let i = 0; i < motion.length; i += d) largest = Math.max(largest, Math.hypot(...motion.subarray(i, i + d)));
    const amplitude = 0.08 * view.size / largest, began = performance.now();
    this.moves = number;
    const frame = (/** @type {number} */ now) => {
      if (this.moves !== number || this.row !== row || this.branch !== branch || this.view !== view) return;
      view.draw(b, row, stabilityAt(this.run, b, row), motion, amplitude * Math.sin((now - began) / 350));
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

new ReportPage(JSON.parse(byId("data").textContent));
