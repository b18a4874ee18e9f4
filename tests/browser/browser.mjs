// A headless Chromium, driven over the devtools protocol.
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";

/** Starts the browser; `end` must be called. @param {string} chromium */
export function startBrowser(chromium) {
  const profile = mkdtempSync(join(tmpdir(), "springfold-browser-"));
  const browser = spawn(chromium, ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-pipe",
    `--user-data-dir=${profile}`, "--window-size=1300,1700", "--force-device-scale-factor=1", "about:blank"],
    {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true});
  let number = 0, rest = "";
  const waiting = new Map(), complaints = [];
  browser.stdio[4].on("data", data => {
    const parts = (rest + data).split("\0");
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) { waiting.get(message.id)?.(message); waiting.delete(message.id); }
      if (message.method === "Runtime.exceptionThrown") complaints.push(message.params.exceptionDetails.exception?.description);
      if (message.method === "Runtime.consoleAPICalled" && message.params.type === "error") complaints.push("console.error");
      if (message.method === "Log.entryAdded" && message.params.entry.level === "error") complaints.push(message.params.entry.text);
    }
  });
  const ask = (method, params = {}, sessionId) => new Promise((good, bad) => {
    const id = ++number;
    waiting.set(id, m => m.error ? bad(new Error(`${method}: ${m.error.message}`)) : good(m.result));
    browser.stdio[3].write(JSON.stringify({id, method, params, ...(sessionId ? {sessionId} : {})}) + "\0");
  });
  const end = () => new Promise(good => {
    try { process.kill(-browser.pid, "SIGKILL"); } catch { /* gone already */ }
    setTimeout(() => { rmSync(profile, {recursive: true, force: true, maxRetries: 5}); good(); }, 200);
  });
  return {ask, end, complaints};
}

/** A tab of its own, and what a hand does in it. */
export async function openTab({ask, complaints}) {
  const {targetId} = await ask("Target.createTarget", {url: "about:blank"});
  const {sessionId} = await ask("Target.attachToTarget", {targetId, flatten: true});
  const tell = (method, params) => ask(method, params, sessionId);
  for (const domain of ["Runtime", "Log", "Page", "Performance"]) await tell(`${domain}.enable`);
  const value = async expression => {
    const answer = await tell("Runtime.evaluate", {expression, returnByValue: true, awaitPromise: true});
    if (answer.exceptionDetails) throw new Error(`${expression}: ${answer.exceptionDetails.exception?.description}`);
    return answer.result.value;
  };
  /** Opens a page of springfold. @returns milliseconds until it can be used */
  const load = async file => {
    const began = performance.now();
    await tell("Page.navigate", {url: pathToFileURL(resolve(file)).href});
    while (!await value("document.readyState === 'complete' && document.querySelectorAll('#values tr').length > 0"))
      await new Promise(good => setTimeout(good, 10));
    return performance.now() - began;
  };
  /** Two frames later, all that was asked for has been drawn. */
  const settle = () => value("new Promise(good => requestAnimationFrame(() => requestAnimationFrame(() => good(true))))");
  const mouse = (type, [x, y], more = {}) => tell("Input.dispatchMouseEvent", {type, x, y, button: "left", clickCount: 1, ...more});
  const click = async place => { await mouse("mousePressed", place); await mouse("mouseReleased", place); await settle(); };
  const key = async (name, code = name) => {
    for (const type of ["keyDown", "keyUp"]) await tell("Input.dispatchKeyEvent", {type, key: name, code});
  };
  /** A place of an element, in parts of its width and height. */
  const at = (selector, x = 0.5, y = 0.5) => value(`(() => { const r = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect();
    return [r.left + r.width * ${x}, r.top + r.height * ${y}]; })()`);
  const choose = (id, text) => value(`(() => { const s = document.getElementById(${JSON.stringify(id)});
    s.value = [...s.options].find(o => o.text === ${JSON.stringify(text)}).value; s.dispatchEvent(new Event('change')); })()`);
  /** What an element looks like: a PNG file as base64. */
  const picture = async selector => {
    await settle();
    const clip = await value(`(({x, y, width, height}) => ({x: x + scrollX, y: y + scrollY, width, height, scale: 1}))(
      document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect().toJSON())`);
    return (await tell("Page.captureScreenshot", {format: "png", clip, captureBeyondViewport: true})).data;
  };
  return {tell, value, load, settle, mouse, click, key, at, choose, picture, complaints};
}
