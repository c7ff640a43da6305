// Two pages that `antigrasp report` wrote, side by side in one browser without a GPU:
//   node bench/page.mjs OLD.html NEW.html [ROUNDS]
// needs report/viewer/node_modules and Chromium (CHROMIUM, /usr/bin/chromium), as the page's tests do. Both pages are opened in
// turn, in a fresh context each time. Prints medians, then `ratio NAME VALUE` lines: what NEW takes of what OLD takes (size,
// opening), or how many times as many frames it has.
import { statSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { launch, open, poorestSecond } from "../report/viewer/tests/support/browser.mjs";

const [oldPath, newPath, rounds = "7"] = process.argv.slice(2);
const pages = [oldPath, newPath];
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/**
 * From the start of the navigation to the first frame with objects, milliseconds: by the clock, and processor time of the page's
 * main thread, which a busy machine does not stretch.
 */
async function firstObjects(browser, path, hash) {
  const context = await browser.newContext({ viewport: { width: 820, height: 620 } });
  const page = await context.newPage();
  await browser.startTracing(page, { categories: ["blink.user_timing", "toplevel"] });
  await page.goto(pathToFileURL(path).href + hash);
  await page.waitForFunction(() => performance.getEntriesByName("antigrasp-first-objects").length, undefined, {
    polling: 50,
    timeout: 120_000,
  });
  const events = JSON.parse(String(await browser.stopTracing())).traceEvents;
  await context.close();
  const end = events.find((e) => e.name === "antigrasp-first-objects");
  const start = Math.max(...events.filter((e) => e.name === "navigationStart" && e.ts < end.ts).map((e) => e.ts));
  const tasks = events
    .filter((e) => e.pid === end.pid && e.tid === end.tid && e.ph === "X" && e.name.endsWith("RunTask") && e.tdur !== undefined)
    .filter((e) => e.ts + e.dur > start && e.ts < end.ts)
    .sort((x, y) => x.ts - y.ts || y.dur - x.dur);
  let processor = 0,
    done = start;
  for (const task of tasks) {
    if (task.ts < done) continue; // inside the one before
    done = task.ts + task.dur;
    processor += task.tdur * Math.min(1, (end.ts - task.ts) / task.dur);
  }
  return { clock: (end.ts - start) / 1000, processor: processor / 1000 };
}

/** Frames of the poorest second while the gallery scrolls by 1,200 pixels a second. */
async function scrolling(browser, path, webgl) {
  const page = await open(browser, path, { hash: "#/gallery", webgl });
  await page.waitForTimeout(1000);
  const frames = await poorestSecond(page, { seconds: 5 });
  await page.context().close();
  return frames;
}

async function inTurn(measure) {
  const values = [[], []];
  for (let round = 0; round < Number(rounds); ++round)
    for (const side of [0, 1]) values[side].push(await measure(pages[side]));
  return values;
}

const ratioOf = (values) => median(values[1].map((value, i) => value / values[0][i]));

const browser = await launch();
const sizes = pages.map((path) => statSync(path).size);
console.log(`size ${sizes.map((bytes) => (bytes / 1e6).toFixed(2)).join(" and ")} MB`);
console.log(`ratio size ${(sizes[1] / sizes[0]).toFixed(3)}`);
for (const [name, hash] of [
  ["gallery", "#/gallery"],
  ["overview", "#/"],
]) {
  const took = await inTurn((path) => firstObjects(browser, path, hash));
  for (const kind of ["clock", "processor"]) {
    const values = took.map((side) => side.map((one) => one[kind]));
    console.log(`first objects of the ${name}, ${kind}: ${values.map((v) => median(v).toFixed(0)).join(" and ")} ms`);
    console.log(`ratio ${name}_${kind} ${ratioOf(values).toFixed(2)}`);
  }
}
const frames = [[], [], []];
for (let round = 0; round < Number(rounds); ++round)
  for (const [i, [path, webgl]] of [[oldPath, true], [newPath, true], [newPath, false]].entries())
    frames[i].push(await scrolling(browser, path, webgl));
const [before, after, undrawn] = frames.map(median);
console.log(`frames of the poorest second of scrolling: ${before} and ${after}; ${undrawn} when no object is drawn`);
console.log(`ratio scrolling ${(after / Math.max(1, before)).toFixed(1)}`);
await browser.close();
