// The HTML page in a real browser, driven over the devtools protocol: node page_test.mjs CHROMIUM FOLDER [SCREENSHOT]
// FOLDER holds the results of cases/snap-through/case-toggle.toml, with report.html; scripts/browser-test.sh makes it.
// Ends with 0 if all holds.
import {spawn} from "node:child_process";
import {readFileSync, writeFileSync, mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";

const [chromium, folder, screenshot] = process.argv.slice(2);
const profile = mkdtempSync(join(tmpdir(), "springfold-browser-"));
const browser = spawn(chromium, ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-pipe",
  `--user-data-dir=${profile}`, "--window-size=1300,1700", "about:blank"], {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true});
const end = code => {
  try { process.kill(-browser.pid, "SIGKILL"); } catch { /* gone already */ }
  setTimeout(() => { rmSync(profile, {recursive: true, force: true, maxRetries: 5}); process.exit(code); }, 200);
};
const limit = setTimeout(() => { console.error("no answer within 60 s"); end(1); }, 60000);

let number = 0, rest = "";
const waiting = new Map(), complaints = [];
browser.stdio[4].on("data", data => {
  const parts = (rest + data).split("\0");
  rest = parts.pop();
  for (const part of parts) {
    const message = JSON.parse(part);
    if (message.id) { waiting.get(message.id)?.(message); waiting.delete(message.id); }
    if (message.method === "Runtime.exceptionThrown") complaints.push(message.params.exceptionDetails.exception?.description);
    if (message.method === "Log.entryAdded" && message.params.entry.level === "error") complaints.push(message.params.entry.text);
  }
});
const ask = (method, params = {}, sessionId) => new Promise((good, bad) => {
  const id = ++number;
  waiting.set(id, m => m.error ? bad(new Error(`${method}: ${m.error.message}`)) : good(m.result));
  browser.stdio[3].write(JSON.stringify({id, method, params, ...(sessionId ? {sessionId} : {})}) + "\0");
});

let failures = 0;
const expect = (holds, sentence) => {
  console.log(`${holds ? "ok    " : "FAILED"} ${sentence}`);
  if (!holds) ++failures;
};

try {
  const {targetId} = await ask("Target.createTarget", {url: "about:blank"});
  const {sessionId} = await ask("Target.attachToTarget", {targetId, flatten: true});
  const tell = (method, params) => ask(method, params, sessionId);
  for (const domain of ["Runtime", "Log", "Page"]) await tell(`${domain}.enable`);
  const value = async expression => {
    const answer = await tell("Runtime.evaluate", {expression, returnByValue: true});
    if (answer.exceptionDetails) throw new Error(`${expression}: ${answer.exceptionDetails.text}`);
    return answer.result.value;
  };
  const began = performance.now();
  await tell("Page.navigate", {url: pathToFileURL(resolve(folder, "report.html")).href});
  while (!await value("document.querySelectorAll('#values tr').length > 0 && document.readyState === 'complete'"))
    await new Promise(good => setTimeout(good, 20));
  console.log(`       interactive after ${Math.round(performance.now() - began)} ms`);

  // The CSV file of the first branch: what the page must show.
  const file = await value("document.querySelector('#files a').getAttribute('href')");
  const [head, ...lines] = readFileSync(join(folder, decodeURIComponent(file)), "utf8").trim().split("\n").map(l => l.split(","));
  const row = () => value("Number(document.getElementById('row').value)");
  const shown = name => value(`document.querySelector('#values td[data-quantity=${JSON.stringify(name)}]').dataset.value`);
  const agrees = async () => {
    const i = await row();
    for (const name of ["lambda", "deflection", "force", "knee.x", "knee.y", "energy"]) {
      const text = lines[i][head.indexOf(name)];
      if (Number(await shown(name)) !== Number(text)) return `${name}: ${await shown(name)}, not ${text}`;
    }
    const place = await value("(({x, y}) => [Number(x), Number(y)])(document.querySelector('#mechanism [data-body=knee]').dataset)");
    for (const [k, name] of [[0, "knee.x"], [1, "knee.y"]])
      if (Math.abs(place[k] - Number(lines[i][head.indexOf(name)])) > 1e-9) return `${name} is drawn at ${place[k]}`;
    return "";
  };
  expect(await agrees() === "", "the first row shown has the values and the place of the CSV file");
  expect(await value("document.querySelectorAll('#mechanism *').length > 20"), "the mechanism is drawn");

  const at = async (x, y) => value(`(() => { const r = document.getElementById('diagram').getBoundingClientRect();
    return [r.left + r.width * ${x}, r.top + r.height * ${y}]; })()`);
  const mouse = (type, [x, y], more = {}) => tell("Input.dispatchMouseEvent", {type, x, y, button: "left", clickCount: 1, ...more});
  const before = await row();
  await mouse("mousePressed", await at(0.3, 0.5));
  const rows = new Set();
  for (const x of [0.35, 0.45, 0.55, 0.65, 0.8]) {
    await mouse("mouseMoved", await at(x, 0.5), {buttons: 1});
    rows.add(await row());
    const trouble = await agrees();
    expect(trouble === "", `dragged to row ${await row()}: values and place are those of the CSV file ${trouble}`);
  }
  await mouse("mouseReleased", await at(0.8, 0.5));
  expect(rows.size >= 3 && !rows.has(before), "dragging moves along the branch");

  const mark = await value(`(() => { const r = document.querySelector('#diagram circle[data-label="LP1"]').getBoundingClientRect();
    return [r.left + r.width / 2, r.top + r.height / 2]; })()`);
  await mouse("mousePressed", mark);
  await mouse("mouseReleased", mark);
  const lp = lines[await row()];
  expect(lp[head.indexOf("event")] === "LP1", "a click on LP1 goes to its row");
  expect((await value("document.getElementById('point').textContent")).includes("has an extremum here"), "its sentence is shown");
  expect(await agrees() === "", "its values are those of the CSV file");
  if (screenshot) writeFileSync(screenshot, Buffer.from((await tell("Page.captureScreenshot", {format: "png"})).data, "base64"));

  const key = async (name, code = name) => {
    await tell("Input.dispatchKeyEvent", {type: "keyDown", key: name, code});
    await tell("Input.dispatchKeyEvent", {type: "keyUp", key: name, code});
  };
  const here = await row();
  await value("document.getElementById('diagram').focus()");
  await key("ArrowRight");
  expect(await row() === here + 1, "the right arrow goes one row on");
  await key("End");
  expect(await row() === lines.length - 1, "End goes to the last row");
  await key("p", "KeyP");
  expect(lines[await row()][head.indexOf("event")] !== "", "p goes to a special point");
  await value(`(() => { const y = document.getElementById('y'); y.value = [...y.options].find(o => o.text === 'energy').value;
    y.dispatchEvent(new Event('change')); })()`);
  expect(await value("[...document.querySelectorAll('#diagram > text')].some(t => t.textContent.startsWith('energy'))"), "any quantity can be an axis");
  await value("document.getElementById('play').click()");
  await new Promise(good => setTimeout(good, 300));
  expect(await value("document.getElementById('play').getAttribute('aria-pressed')") !== null, "it plays");
  expect((await value("document.title")).includes("</title><script>"), "the title is shown as it was written");
  expect(await value("typeof window.injected") === "undefined", "no text of the case was run as a script");
  expect(complaints.length === 0, `no errors on the console ${complaints.join("; ")}`);
} catch (error) {
  console.error(error, complaints);
  ++failures;
}
clearTimeout(limit);
end(failures === 0 ? 0 : 1);
