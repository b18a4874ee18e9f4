// The HTML page in a real browser: node page_test.mjs CHROMIUM FOLDER [SCREENSHOTS] [--renew]
// FOLDER holds the results of the cases toggle, figure, dome, truss, follower, platform and long, each with report.html; scripts/browser-test.sh makes
// it. SCREENSHOTS: a folder for what was seen, to be looked at. --renew keeps it as what later runs are compared with.
// Ends with 0 if all holds.
import {mkdirSync, readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {openTab, startBrowser} from "./browser.mjs";
import {differenceFromKept, tolerance} from "./pictures.mjs";

const words = process.argv.slice(2).filter(w => w !== "--renew"), renew = process.argv.includes("--renew");
const [chromium, folder, screenshots] = words;
const browser = startBrowser(chromium);
const finish = async code => { await browser.end(); process.exit(code); };
const limit = setTimeout(() => { console.error("no answer within 120 s"); finish(1); }, 120000);

let failures = 0;
const expect = (holds, sentence) => {
  console.log(`${holds ? "ok    " : "FAILED"} ${sentence}`);
  if (!holds) ++failures;
};

// The tab that is opened last is in front: only there frames are drawn.
const empty = await openTab(browser), tab = await openTab(browser);
const {value, mouse, key, at} = tab;

/** Compares with what is kept; another picture must not pass for it. */
async function expectPicture(name, selector, other) {
  const png = await tab.picture(selector);
  if (screenshots) {
    mkdirSync(screenshots, {recursive: true});
    writeFileSync(join(screenshots, `${name}.png`), Buffer.from(png, "base64"));
  }
  const share = await differenceFromKept(empty, name, png, renew);
  expect(share <= tolerance, `${name} looks as it is kept: ${(100 * share).toFixed(2)} % of it differ`);
  if (!other) return;
  const wrong = await differenceFromKept(empty, name, other, false);
  expect(wrong > tolerance, `another posture does not: ${(100 * wrong).toFixed(2)} %`);
}

/** The CSV file of the first list: what the page must show. */
async function tableOf(place) {
  const file = await value("document.querySelector('#files a').getAttribute('href')");
  const [head, ...lines] = readFileSync(join(place, decodeURIComponent(file)), "utf8").trim().split("\n").map(l => l.split(","));
  return {head, lines, at: (row, name) => lines[row][head.indexOf(name)]};
}
const row = () => value("Number(document.getElementById('row').value)");

/** The row that is shown when all events have been worked off. */
async function settledRow() {
  for (let before = NaN;;) {
    await tab.settle();
    const now = await row();
    if (now === before) return now;
    before = now;
  }
}

/** Values shown equal the table's, the body is drawn where its coordinates say; in words what does not hold. */
async function disagreement(table, names, body) {
  const i = await settledRow();
  for (const name of names) {
    const shown = await value(`document.querySelector('#values td[data-quantity=${JSON.stringify(name)}]').dataset.value`);
    if (Number(shown) !== Number(table.at(i, name))) return `${name}: ${shown}, not ${table.at(i, name)}`;
  }
  const place = await value(`(d => [d.x, d.y, d.z])(document.querySelector('#mechanism [data-body=${body}]').dataset)`);
  for (const [k, axis] of ["x", "y", "z"].entries())
    if (place[k] !== undefined && Math.abs(Number(place[k]) - Number(table.at(i, `${body}.${axis}`))) > 1e-9) return `${body}.${axis} is drawn at ${place[k]}`;
  return "";
}

async function curve() {
  const place = join(folder, "toggle"), began = await tab.load(join(place, "report.html"));
  console.log(`       interactive after ${Math.round(began)} ms`);
  expect(began < 1000, "the page is interactive within a second");
  const table = await tableOf(place), names = ["lambda", "deflection", "force", "crank.foot", "rod.slider", "knee.x", "energy"];
  expect(await disagreement(table, names, "knee") === "", "the first row shown has the values and the place of the CSV file");
  expect(await value("document.querySelectorAll('#mechanism *').length > 20"), "the mechanism is drawn");
  expect(await value(`(() => { const box = s => document.querySelector(s).getBoundingClientRect(), sheet = box("#diagram rect.sheet");
    const name = [...document.querySelectorAll("#diagram > text")].find(t => t.textContent.startsWith("force")).getBoundingClientRect();
    const tick = [...document.querySelectorAll("#diagram .tick text")].map(t => t.getBoundingClientRect().height);
    return name.bottom <= sheet.top - Math.max(...tick) / 2 + 1; })()`), "a number at the top of the upper axis would not touch its name");
  const before = await row(), beforePicture = await tab.picture("main");
  await mouse("mousePressed", await at("#diagram", 0.3, 0.5));
  const rows = new Set();
  for (const x of [0.35, 0.45, 0.55, 0.65, 0.8]) {
    await mouse("mouseMoved", await at("#diagram", x, 0.5), {buttons: 1});
    await tab.settle();
    rows.add(await row());
    const trouble = await disagreement(table, names, "knee");
    expect(trouble === "", `dragged to row ${await row()}: values and place are those of the CSV file ${trouble}`);
  }
  await mouse("mouseReleased", await at("#diagram", 0.8, 0.5));
  expect(rows.size >= 3 && !rows.has(before), "dragging moves along the branch");

  await tab.click(await at('#diagram circle[data-label="LP1"]'));
  expect(table.at(await row(), "event") === "LP1", "a click on LP1 goes to its row");
  expect((await value("document.getElementById('point').textContent")).includes("has an extremum here"), "its sentence is shown");
  expect(await disagreement(table, names, "knee") === "", "its values are those of the CSV file");
  await expectPicture("limit-point", "main", beforePicture);
  await tab.tell("Emulation.setEmulatedMedia", {features: [{name: "prefers-color-scheme", value: "dark"}]});
  await expectPicture("limit-point-dark", "main");
  await tab.tell("Emulation.setEmulatedMedia", {features: []});

  const here = await row();
  await value("document.getElementById('diagram').focus()");
  await key("ArrowRight");
  expect(await row() === here + 1, "the right arrow goes one row on");
  await key("End");
  expect(await row() === table.lines.length - 1, "End goes to the last row");
  await key("p", "KeyP");
  expect(table.at(await row(), "event") !== "", "p goes to a special point");
  await tab.choose("y", "energy");
  expect(await value("[...document.querySelectorAll('#diagram > text')].some(t => t.textContent.startsWith('energy'))"), "any quantity can be an axis");
  await key("b", "KeyB");
  expect((await value("document.getElementById('posture').textContent")).startsWith("jump J1 from LP1"), "b goes on to the motion of the jump");
  await key("End");
  expect((await value("document.getElementById('point').textContent")).includes("Energy released"), "the end of a jump says what it releases");
  await key("Home");
  await value("document.getElementById('play').click()");
  await new Promise(good => setTimeout(good, 400));
  expect(await row() > 0, "it plays");
  expect((await value("document.title")).includes("</title><script>"), "the title is shown as it was written");
  expect(await value("typeof window.injected") === "undefined", "no text of the case was run as a script");
}

async function map() {
  const place = join(folder, "figure");
  await tab.load(join(place, "report.html"));
  const table = await tableOf(place), names = ["node.x", "node.y", "stiffness", "leg_x.knee", "tool.x"];
  const rows = new Set();
  for (const [x, y] of [[0.3, 0.3], [0.6, 0.7], [0.85, 0.4]]) {
    await mouse("mouseMoved", await at("#diagram", x, y), {button: "none"});
    await tab.settle();
    rows.add(await row());
    const trouble = await disagreement(table, names, "tool");
    expect(trouble === "", `over node ${await row()} of the map: values and posture are those of the CSV file ${trouble}`);
  }
  expect(rows.size === 3, "the mouse over a map chooses nodes");
  await value("document.getElementById('diagram').focus()");
  const here = await row();
  await key("ArrowUp");
  expect(table.at(await row(), "node.x") === table.at(here, "node.x") && Number(table.at(await row(), "node.y")) > Number(table.at(here, "node.y")),
         "the arrow up goes to the node above");
  expect((await value("document.getElementById('key').textContent")).startsWith("stiffness"), "the colours are those of the quantity that was asked for");
  await expectPicture("map", "main");
}

async function inSpace() {
  const place = join(folder, "dome");
  await tab.load(join(place, "report.html"));
  const table = await tableOf(place), before = await tab.picture("#mechanism");
  expect(await disagreement(table, ["lambda"], "apex") === "", "a body in space is drawn where the CSV file says");
  await key("v", "KeyV");
  await expectPicture("perspective", "#mechanism", before);
  const links = () => value("[...document.querySelectorAll('#mechanism polyline')].map(l => l.getAttribute('points')).join()");
  const straight = await links();
  await mouse("mousePressed", await at("#mechanism", 0.3, 0.5));
  await mouse("mouseMoved", await at("#mechanism", 0.5, 0.4), {buttons: 1});
  await mouse("mouseReleased", await at("#mechanism", 0.5, 0.4));
  expect(await links() !== straight, "dragging turns a mechanism in space");
  await key("r", "KeyR");
  expect(await links() === straight, "r turns it back");
}

/** At a branch point the ways across the branch are shown: of the dome's double one two modes, and the branch itself. */
async function modes() {
  const place = join(folder, "dome");
  await tab.load(join(place, "report.html"));
  await tab.choose("run", "press, run 2: 60°");
  const table = await tableOf(place);
  await value("document.getElementById('diagram').focus()");
  for (let i = 0; i < 20 && !table.at(await row(), "event").startsWith("BP"); ++i) await key(i < 10 ? "n" : "p", i < 10 ? "KeyN" : "KeyP");
  expect(table.at(await row(), "event") === "BP1", "n and p reach the branch point");
  const titles = await value("[...document.querySelectorAll('#point button')].map(b => b.textContent)");
  expect(JSON.stringify(titles) === JSON.stringify(["Show the buckling mode 1", "Show the buckling mode 2", "Show the motion along the branch"]),
         `its modes can be shown: ${titles}`);
  const apex = () => value("[...document.querySelectorAll('#mechanism circle[data-body=apex]')].map(c => [c.getAttribute('cx'), c.getAttribute('cy')]).join()");
  const rest = await apex(), seen = new Set();
  await key("m", "KeyM");
  for (let i = 0; i < 20; ++i) { await tab.settle(); seen.add(await apex()); }
  expect(seen.size > 5, "m moves the mechanism in its mode");
  for (let i = 0; i < 3; ++i) await key("m", "KeyM");
  await tab.settle();
  expect(await apex() === rest, "after the last of them it rests again");
}

/** A branch that runs back over itself keeps its dashes, and the key has the lines that are there. */
async function dashes() {
  await tab.load(join(folder, "truss", "report.html"));
  await value("(s => { s.selectedIndex = 1; s.dispatchEvent(new Event('change')); })(document.getElementById('branch'))");
  await tab.settle();
  const drawn = await value(`[...document.querySelectorAll('#diagram .curve.driven:not(.other)')].reduce((sum, p) => sum + p.getTotalLength(), 0)`);
  const ends = await value(`["BP1", "BP4"].map(l => document.querySelector('#diagram circle[data-label="' + l + '"]'))
      .map(c => [Number(c.getAttribute("cx")), Number(c.getAttribute("cy"))])`);
  const chord = Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  expect(drawn > chord && drawn < 1.15 * chord, `the branch aside and back is drawn once: ${(drawn / chord).toFixed(3)} of its chord`);
  const kinds = () => value("[...document.querySelectorAll('#key .entry')].map(e => `${e.dataset.kind}: ${e.textContent.trim()}`)");
  expect(JSON.stringify(await kinds()) === JSON.stringify(["stable: stable under dead load", "driven: held as driven, unstable under dead load", "unstable: unstable"]),
         `the key has the lines that are there: ${await kinds()}`);
  const dashesOf = kind => value(`(p => p ? getComputedStyle(p).strokeDasharray : "")(document.querySelector('#key .curve.${kind}'))`);
  expect(await dashesOf("stable") === "none" && await dashesOf("driven") !== "none", "with their dashes");
  await tab.load(join(folder, "follower", "report.html"));
  expect((await kinds()).includes("unknown: stability not known"), `under a follower load stability is not known: ${await kinds()}`);
  expect((await dashesOf("unknown")).split(",").length === 4, "which is a line of dashes and dots");
  expect(await value("getComputedStyle(document.querySelector('#diagram .curve.unknown')).strokeDasharray") === await dashesOf("unknown"), "in the diagram too");
}

/** Two lines on the same place: what is drawn of each kind. */
async function overlaps() {
  const seen = (...lines) => value(`JSON.stringify(withoutOverlaps(${JSON.stringify(lines)}, 560, 420))`).then(JSON.parse);
  const line = (rank, spots, curve = 0, place = 0) => ({curve, place, rank, spots});
  const way = [100, 100, 300, 200], back = [300, 200, 100, 100];
  const [first, second] = await seen(line(3, way, 0), line(3, back, 1));
  expect(first.isWhole && !second.isWhole && second.stretches.length + second.beneath.length === 0, "of two dashed lines on each other one is drawn");
  const [less, more] = await seen(line(3, way, 0), line(0, back, 1));
  expect(more.isWhole && less.stretches.length === 0 && less.beneath.length === 1, "an unstable line on a stable one is a band beneath it");
  const [solid, other] = await seen(line(0, way, 0), line(0, way, 1));
  expect(solid.isWhole && other.isWhole, "solid lines are all drawn");
  expect((await seen(line(3, way, 0), line(3, [100, 200, 300, 100], 1))).every(l => l.isWhole), "lines that cross are left alone");
  const [turn] = await seen(line(3, [100, 100, 200, 100, 150, 100, 150, 300]));
  expect(turn.stretches.length === 2 && turn.stretches[1].at(-1) === 300, "the rest of a line that runs back over itself is kept");
  const chosen = await seen(line(2, way, 0, 1), line(3, way, 1, 0));
  expect(chosen.every(l => l.isWhole), "of the branch that is shown nothing is left out for another");
}

/** The mouse alone shows the values of the row that is nearest. */
async function hover() {
  const place = join(folder, "toggle");
  await tab.load(join(place, "report.html"));
  const table = await tableOf(place), before = await row();
  await mouse("mouseMoved", await at('#diagram circle[data-label="LP1"]', 0.5, -0.6), {button: "none"});
  await tab.settle();
  const shown = await value("document.querySelector('#diagram .hover').getAttribute('display') === null && document.querySelector('#diagram .hover text').textContent");
  const near = table.lines.some((_, i) => shown && shown.startsWith(`${Number(Number(table.at(i, "deflection")).toPrecision(7))}, ${Number(Number(table.at(i, "force")).toPrecision(7))}`));
  expect(near && await row() === before, `the mouse alone shows values of a row: ${shown}`);
}

/** Every run of every study, by the choice of runs: whatever it has is shown, and nothing is complained of. */
async function allRuns(name) {
  await tab.load(join(folder, name, "report.html"));
  const runs = await value("document.getElementById('run').options.length");
  let shown = 0;
  for (let i = 0; i < runs; ++i) {
    await value(`(() => { const s = document.getElementById('run'); s.value = '${i}'; s.dispatchEvent(new Event('change')); })()`);
    await tab.settle();
    const lists = await value("document.getElementById('branch').options.length");
    const marks = await value("document.querySelectorAll('#diagram .curve, #diagram circle.special').length");
    if (lists === 0 || (marks > 0 && await value("document.querySelectorAll('#mechanism *').length > 5"))) ++shown;
  }
  expect(runs > 1 && shown === runs, `${shown} of ${runs} runs of ${name} are shown`);
  expect(browser.complaints.length === 0, `without complaints ${browser.complaints.join("; ")}`);
}

/** On a telephone nothing lies beyond the edge but tables, which are moved in their own frames. */
async function narrow() {
  for (const name of ["toggle", "figure", "dome", "truss", "follower", "platform"]) {
    await tab.tell("Emulation.setDeviceMetricsOverride", {width: 360, height: 740, deviceScaleFactor: 1, mobile: true});
    await tab.load(join(folder, name, "report.html"));
    await tab.settle();
    const wide = await value("Math.max(document.documentElement.scrollWidth, window.innerWidth)");
    expect(wide <= 360, `the page of ${name} is ${wide} px wide on a screen of 360`);
    const beyond = await value(`[...document.querySelectorAll("form *, main, figure, #diagram, #mechanism, h1, p")]
      .filter(e => e.getBoundingClientRect().right > 360.5).map(e => e.id || e.tagName).join()`);
    expect(beyond === "", `nothing of it lies beyond the edge ${beyond}`);
    if (screenshots) writeFileSync(join(screenshots, `narrow-${name}.png`), Buffer.from(await tab.picture("body"), "base64"));
  }
  await tab.tell("Emulation.clearDeviceMetricsOverride");
}

/** What is said of limit points is so: where the way from the start leaves a stable stretch the mechanism snaps, and nowhere else. */
async function sentences() {
  for (const name of ["toggle", "figure", "dome", "truss"]) {
    await tab.load(join(folder, name, "report.html"));
    const told = await value(`[...new Set(JSON.parse(document.getElementById("data").textContent).runs.flatMap(r => r.branches)
      .flatMap(b => b.events).filter(e => e.code === "LP" || e.code === "CL").map(e => e.sentence))].join("\\n")`);
    console.log(told.replace(/^/gm, `       ${name}: `));
  }
  await tab.load(join(folder, "toggle", "report.html"));
  const wrong = await value(`JSON.parse(document.getElementById("data").textContent).runs.flatMap(r => r.branches.filter(b => b.form === "curve")
    .flatMap(b => { const branch = b; return b.events.filter(e => e.code === "LP").filter(e => {
      const width = r.quantities.length, all = numbersOf(branch.values), of = r.quantities.findIndex(q => q.name === "index");
      const at = row => all[row * width + of];
      const side = e.row < branch.start ? -1 : 1;
      return (at(e.row - side) === 0 && at(e.row + side) !== 0) !== e.sentence.includes("Beyond it the mechanism snaps"); }); })).length`);
  expect(wrong === 0, "of the toggle's limit points it is said that the mechanism snaps where stability ends, and nowhere else");
}

/** Script time per frame while the mouse drags and the wheel zooms, measured by the browser itself [ms]. */
async function longCurve() {
  const place = join(folder, "long");
  await tab.load(join(place, "report.html"));
  const count = await value("Number(document.getElementById('row').max) + 1");
  expect(count >= 100000, `a branch of ${count} rows is shown`);
  const script = async () => (await tab.tell("Performance.getMetrics")).metrics.find(m => m.name === "ScriptDuration").value * 1000;
  const slowest = async act => {
    let most = 0;
    for (let i = 0; i < 25; ++i) {
      const before = await script();
      await act(i);
      await tab.settle();
      most = Math.max(most, await script() - before);
    }
    return most;
  };
  await mouse("mousePressed", await at("#diagram", 0.2, 0.6));
  const drag = await slowest(async i => mouse("mouseMoved", await at("#diagram", 0.2 + 0.025 * i, 0.6), {buttons: 1}));
  await mouse("mouseReleased", await at("#diagram", 0.8, 0.6));
  const zoom = await slowest(async i => {
    const [x, y] = await at("#diagram", 0.5, 0.5);
    return tab.tell("Input.dispatchMouseEvent", {type: "mouseWheel", x, y, deltaX: 0, deltaY: i < 12 ? -60 : 60});
  });
  // Told, not tested: on a processor that does other things as well it says nothing.
  console.log(`       dragging: at most ${drag.toFixed(1)} ms of script per frame`);
  console.log(`       zooming: at most ${zoom.toFixed(1)} ms of script per frame`);
}

try {
  for (const part of [curve, hover, dashes, overlaps, map, inSpace, modes, narrow, sentences, () => allRuns("platform"), longCurve]) await part();
  expect(browser.complaints.length === 0, `no errors on the console ${browser.complaints.join("; ")}`);
} catch (error) {
  console.error(error, browser.complaints);
  ++failures;
}
clearTimeout(limit);
await finish(failures === 0 ? 0 : 1);
