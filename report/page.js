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

class ReportPage {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.run = page.runs[0];
    this.branch = this.row = 0;
    this.plays = this.moves = false;
    /** @type {MechanismView | null} */ this.view = null;
    this.diagram = new Diagram(byId("diagram"), (branch, row) => { this.stop(); this.go(branch, row); });
    byId("title").textContent = page.title || page.case;
    byId("subtitle").textContent = `${page.case}, springfold ${page.version}`;
    byId("made").textContent = `Made by springfold ${page.version} from ${page.case}, hash ${page.hash}.`;
    fill(byId("run"), page.runs.map(r => `${r.study}, run ${r.run}${r.label ? `: ${r.label}` : ""}`));
    this.listen();
    this.showRun(Math.max(0, page.runs.findIndex(r => r.branches.some(b => b.rows > 1))));
  }

  listen() {
    byId("run").addEventListener("change", () => this.showRun(Number(byId("run").value)));
    byId("branch").addEventListener("change", () => this.go(Number(byId("branch").value), 0));
    byId("row").addEventListener("input", () => { this.stop(); this.go(this.branch, Number(byId("row").value)); });
    for (const id of ["x", "y"]) byId(id).addEventListener("change", () => this.showAxes());
    byId("play").addEventListener("click", () => this.plays ? this.stop() : this.play());
    byId("reset").addEventListener("click", () => this.showAxes());
    document.addEventListener("keydown", event => {
      const target = /** @type {HTMLElement} */ (event.target);
      if (["SELECT", "INPUT", "BUTTON"].includes(target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (this.key(event.key, event.shiftKey ? 10 : 1)) event.preventDefault();
    });
  }

  /** @param {string} key @param {number} by @returns {boolean} */
  key(key, by) {
    const last = this.run.branches.length ? this.run.branches[this.branch].rows - 1 : 0;
    switch (key) {
      case "ArrowRight": this.stop(); this.go(this.branch, this.row + by); return true;
      case "ArrowLeft": this.stop(); this.go(this.branch, this.row - by); return true;
      case "Home": this.stop(); this.go(this.branch, 0); return true;
      case "End": this.stop(); this.go(this.branch, last); return true;
      case "n": this.stop(); this.special(1); return true;
      case "p": this.stop(); this.special(-1); return true;
      case " ": if (this.plays) this.stop(); else this.play(); return true;
      case "r": this.showAxes(); return true;
      case "m": this.vibrate(); return true;
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
    byId("run").value = String(number);
    fill(byId("x"), run.quantities.map(q => q.name));
    fill(byId("y"), run.quantities.map(q => q.name));
    const first = (/** @type {string[]} */ names) => Math.max(0, ...names.map(n => columnOf(run, n)).filter(c => c >= 0).slice(0, 1));
    byId("x").value = String(first(["deflection", "path", "lambda"]));
    byId("y").value = String(first(columnOf(run, "deflection") >= 0 ? ["force", "lambda"] : ["lambda", "energy"]));
    fill(byId("branch"), run.branches.map((_, i) => `branch ${i + 1}`));
    this.view = run.mechanism ? new MechanismView(byId("mechanism"), run, run.mechanism) : null;
    if (!this.view) byId("mechanism").textContent = "";
    this.diagram.branch = 0;
    this.showAxes();
    this.showTables();
    this.go(0, run.branches.length ? run.branches[0].start : 0);
  }

  showAxes() {
    this.diagram.show(this.run, Number(byId("x").value), Number(byId("y").value));
  }

  showTables() {
    const run = this.run, events = byId("events"), parameters = byId("parameters"), files = byId("files");
    for (const element of [events, parameters, files]) element.textContent = "";
    const shown = ["lambda", "deflection", "force", "index", "index_force", "K_eig1"].filter(n => columnOf(run, n) >= 0);
    const head = append(append(events, "thead"), "tr"), body = append(events, "tbody");
    for (const text of ["point", "branch", ...shown, "what"]) append(head, "th", text);
    run.branches.forEach((branch, k) => branch.events.forEach(event => {
      const line = append(body, "tr");
      line.dataset.branch = k;
      line.dataset.row = event.row;
      append(line, "td", event.label);
      append(line, "td", String(k + 1));
      for (const name of shown) append(line, "td", brief(valueAt(run, branch, event.row, columnOf(run, name))));
      append(line, "td", event.detail);
      line.addEventListener("click", () => { this.stop(); this.go(k, event.row); });
    }));
    for (const name of Object.keys(run.parameters)) {
      const line = append(parameters, "tr");
      append(line, "td", name);
      append(line, "td", String(run.parameters[name]));
    }
    for (const file of [...run.branches.map(b => b.file), "events.csv", "summary.json"]) {
      const link = append(append(files, "li"), "a", file);
      link.href = file.split("/").map(encodeURIComponent).join("/");
    }
  }

  /** @param {number} branch @param {number} row */
  go(branch, row) {
    const run = this.run;
    this.moves = false;
    if (!run.branches.length) {
      byId("point").textContent = run.start ? `No start point: ${run.start}` : "Rows of this kind of study are in its CSV files.";
      byId("values").textContent = byId("posture").textContent = "";
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
    const words = {stable: "stable under dead load", driven: "held as driven, unstable under dead load",
                   unstable: "unstable", unknown: "stability not known"};
    byId("posture").textContent = `Row ${this.row + 1} of ${b.rows}: ${words[stability]}.`;
    byId("key").textContent = "Solid: stable under dead load. Long dashes: held as driven, unstable under dead load. Short dashes: unstable.";
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
      const eigenvalues = ["K_eig1", "K_eig2", "K_eig3"].map(n => valueAt(this.run, b, this.row, columnOf(this.run, n)))
          .filter(v => !Number.isNaN(v)).map(brief);
      if (eigenvalues.length) append(place, "p", `Eigenvalues of the stiffness: ${eigenvalues.join(", ")}`);
      if (event.stiffness) append(place, "p", `Stiffness: ${event.stiffness.map(r => r.map(brief).join("  ")).join(";  ")}`);
      if (!event.motion || !this.view) continue;
      const button = append(place, "button", event.code === "LP" ? "Show the buckling mode" : "Show the motion along the branch");
      button.type = "button";
      button.addEventListener("click", () => this.vibrate());
    }
    for (const line of document.querySelectorAll("#events tbody tr")) {
      const data = /** @type {HTMLElement} */ (line).dataset;
      line.classList.toggle("here", Number(data.branch) === this.branch && Number(data.row) === this.row);
    }
  }

  showValues() {
    const table = byId("values"), b = this.run.branches[this.branch];
    if (table.dataset.run !== `${this.run.study}/${this.run.run}`) {
      table.textContent = "";
      table.dataset.run = `${this.run.study}/${this.run.run}`;
      for (const q of this.run.quantities) {
        const line = append(table, "tr");
        append(line, "td", q.name + (q.unit ? ` [${q.unit}]` : ""));
        append(line, "td").dataset.quantity = q.name;
      }
    }
    this.run.quantities.forEach((_, i) => {
      const value = valueAt(this.run, b, this.row, i), cell = table.rows[i].cells[1];
      cell.textContent = brief(value);
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

  /** Moves the mechanism to and fro along the branch's direction at a special point, much enlarged. */
  vibrate() {
    this.stop();
    const b = this.run.branches[this.branch], view = this.view, row = this.row, branch = this.branch;
    const event = b && b.events.find(e => e.row === row && e.motion);
    if (!event || !event.motion || !view) return;
    if (this.moves) { this.moves = false; view.draw(b, row, stabilityAt(this.run, b, row)); return; }
    const motion = numbersOf(event.motion);
    let largest = 0;
    for (const v of motion) largest = Math.max(largest, Math.abs(v));
    if (!(largest > 0)) return;
    const amplitude = 0.08 * view.size / largest, began = performance.now();
    this.moves = true;
    const frame = (/** @type {number} */ now) => {
      if (!this.moves || this.row !== row || this.branch !== branch || this.view !== view) return;
      view.draw(b, row, stabilityAt(this.run, b, row), motion, amplitude * Math.sin((now - began) / 350));
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

new ReportPage(JSON.parse(byId("data").textContent));
