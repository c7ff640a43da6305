// Two pages that `antigrasp report` wrote, side by side in one browser without a GPU:
//   node bench/page.mjs OLD.html NEW.html [ROUNDS]
// needs report/viewer/node_modules and Chromium (CHROMIUM, /usr/bin/chromium), as the page's tests do. Both pages are opened in
// turn, in a fresh context each time. Prints medians, then `ratio NAME VALUE` lines: what NEW takes of what OLD takes (size,
// opening), or how many times as many frames it has.
import { statSync } from "node:fs";
import { launch, open, poorestSecond } from "../report/viewer/tests/support/browser.mjs";

const [oldPath, newPath, rounds = "7"] = process.argv.slice(2);
const pages = [oldPath, newPath];
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Milliseconds from the start of the navigation to the first frame with objects. */
async function firstObjects(browser, path, hash) {
  const page = await open(browser, path, { hash });
  const entry = await page.waitForFunction(() => performance.getEntriesByName("antigrasp-first-objects")[0]?.startTime, undefined, {
    polling: 50,
  });
  const took = await entry.jsonValue();
  await page.context().close();
  return took;
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
  const ratios = values[1].map((value, i) => value / values[0][i]);
  return [...values.map(median), median(ratios)];
}

const browser = await launch();
const sizes = pages.map((path) => statSync(path).size);
console.log(`size ${sizes.map((bytes) => (bytes / 1e6).toFixed(2)).join(" and ")} MB`);
console.log(`ratio size ${(sizes[1] / sizes[0]).toFixed(3)}`);
for (const [name, hash] of [
  ["gallery", "#/gallery"],
  ["overview", "#/"],
]) {
  const [before, after, ratio] = await inTurn((path) => firstObjects(browser, path, hash));
  console.log(`first objects of the ${name} after ${before.toFixed(0)} and ${after.toFixed(0)} ms`);
  console.log(`ratio ${name} ${ratio.toFixed(2)}`);
}
const [before, after, ratio] = await inTurn((path) => scrolling(browser, path, true));
const undrawn = [];
for (let round = 0; round < 3; ++round) undrawn.push(await scrolling(browser, newPath, false));
console.log(`frames of the poorest second of scrolling ${before} and ${after}; ${median(undrawn)} when no object is drawn`);
console.log(`ratio scrolling ${ratio.toFixed(1)}`);
await browser.close();
