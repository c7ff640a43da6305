// Five hundred objects, made in a second, how the gallery scrolls over them, and the blob that holds them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import {
  expectQuiet,
  go,
  heading,
  launch,
  open,
  poorestSecond,
  settled,
  TEMPLATE,
  writeReport,
} from "./support/browser.mjs";
import { Blob, bumpy, emptyReport, fill, GROUPS, meshRecord, objects } from "./support/payload.mjs";
import { picture } from "./support/looks.mjs";
import { difference, ink } from "./support/png.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

function fiveHundred() {
  const blob = new Blob();
  const meshes = Array.from({ length: 500 }, (_, i) => meshRecord(blob, bumpy(i)));
  const list = objects(blob, 500).map((o, i) => ({ ...o, mesh: meshes[i] }));
  return writeReport("many.html", fill(TEMPLATE, emptyReport({ objects: list, groups: GROUPS }), blob));
}

test("five hundred objects are on the screen within five seconds, and scrolling finds the others drawn", async () => {
  const path = fiveHundred();
  // From the start of the navigation to the first frame with objects, by the page's own clock. The best of three, so
  // that a machine which stops for something else does not fail the page.
  let page;
  const took = [];
  do {
    await page?.context().close();
    page = await open(browser, path, { hash: "#/gallery" });
    await settled(page);
    took.push(await page.evaluate(() => performance.getEntriesByName("antigrasp-first-objects")[0].startTime));
  } while (Math.min(...took) >= 5000 && took.length < 3);
  assert.ok(Math.min(...took) < 5000, `${took} ms`);
  assert.ok(ink(await picture(page, ".tile .picture")) > 0.05, "the first object is drawn");
  assert.equal(await page.locator(".tile").count(), 500);
  assert.ok(ink(await picture(page, ".tile .picture", 499)) > 0.05, "the last object is drawn");
  // What lies far from the window is not kept.
  assert.ok((await page.locator(".picture canvas").count()) <= 300);
  await page.getByLabel("Sort by").selectOption("ascending");
  await page.getByLabel("stages apart").uncheck();
  await page.evaluate(() => window.scrollTo(0, 0));
  await settled(page);
  const scores = await page.locator(".tile-text b").allTextContents();
  assert.deepEqual(
    scores,
    [...scores].sort((a, b) => a - b),
  );
  assert.ok(ink(await picture(page, ".tile .picture")) > 0.05);
  await expectQuiet(page);
});

test("the program runs before the geometry is read, and the page of an object waits for it", async () => {
  const html = readFileSync(TEMPLATE, "utf8");
  assert.ok(!/type="module"/.test(html));
  assert.ok(html.indexOf("antigrasp-report") < html.indexOf("<script>(() =>"));
  assert.ok(html.indexOf("<script>(() =>") < html.indexOf('class="antigrasp-blob"'));
  const page = await open(browser, fiveHundred(), { hash: "#/object/499" });
  await heading(page, "sample-000499");
  assert.ok(ink(await picture(page, ".panel-picture")) > 0.05);
  await expectQuiet(page);
});

test("scrolling never drops below thirty frames a second", async () => {
  const page = await open(browser, fiveHundred(), { hash: "#/gallery" });
  await settled(page);
  // The frames of the poorest second of three, 1,200 pixels a second. The best of five tries, and no more than the
  // machine gives a page that draws no objects: one that is busy with something else is no failure.
  const idle = await open(browser, fiveHundred(), { hash: "#/gallery", webgl: false });
  let least = 0,
    possible = Infinity;
  for (let i = 0; i < 5 && least < 30 && least < 0.8 * possible; ++i) {
    possible = Math.min(possible, await poorestSecond(idle));
    least = Math.max(least, await poorestSecond(page));
  }
  assert.ok(least >= 30 || least >= 0.8 * possible, `${least} frames a second, ${possible} without objects`);
  await settled(page);
  assert.ok(ink(await picture(page, ".tile .picture", 60)) > 0.05, "what was scrolled to is drawn");
  await expectQuiet(idle);
  await expectQuiet(page);
});

test("a part of the blob is decoded wherever it begins", async () => {
  // Three bytes of the blob are a group of base64: three objects begin at its first, second and third one.
  const blob = new Blob();
  const first = meshRecord(blob, bumpy(1));
  while (blob.length % 3 !== 1) blob.addStored([0]);
  const second = meshRecord(blob, bumpy(1));
  while (blob.length % 3 !== 2) blob.addStored([0]);
  const third = meshRecord(blob, bumpy(1));
  const list = [first, second, third].map((mesh, i) => ({ ...objects(blob, 1)[0], name: `o${i}`, group: 0, mesh }));
  const page = await open(
    browser,
    writeReport(
      "parts.html",
      fill(TEMPLATE, emptyReport({ kind: "objects", objects: list, groups: [GROUPS[0]] }), blob),
    ),
  );
  const pictures = [];
  for (let i = 0; i < 3; ++i) {
    await go(page, `#/object/${i}`);
    pictures.push(await picture(page, ".panel-picture"));
  }
  assert.ok(ink(pictures[0]) > 0.05);
  assert.deepEqual([difference(pictures[0], pictures[1]), difference(pictures[0], pictures[2])], [0, 0]);
  await expectQuiet(page);
});
