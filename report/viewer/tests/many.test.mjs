// Five hundred objects, made in a second, and the blob that holds them.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { expectQuiet, go, launch, open, settled, TEMPLATE, writeReport } from "./support/browser.mjs";
import { Blob, bumpy, emptyReport, fill, GROUPS, meshRecord, objects } from "./support/payload.mjs";
import { picture } from "./support/looks.mjs";
import { difference, ink } from "./support/png.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

test("five hundred objects are on the screen within five seconds, and scrolling finds the others drawn", async () => {
  const blob = new Blob();
  const meshes = Array.from({ length: 500 }, (_, i) => meshRecord(blob, bumpy(i)));
  const list = objects(blob, 500).map((o, i) => ({ ...o, mesh: meshes[i] }));
  const path = writeReport("many.html", fill(TEMPLATE, emptyReport({ objects: list, groups: GROUPS }), blob));
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
  // The canvas covers the window, not five hundred tiles.
  assert.ok((await page.evaluate(() => document.querySelector("canvas.surface").height)) < 2000);
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

test("a part of the blob is decoded wherever it begins", async () => {
  // Parts begin at multiples of four, base64 groups at multiples of three: three objects meet all three cases.
  const blob = new Blob();
  blob.add(new Uint8Array(4));
  const first = meshRecord(blob, bumpy(1));
  while (blob.length % 3 !== 1) blob.add(new Uint8Array(4));
  const second = meshRecord(blob, bumpy(1));
  while (blob.length % 3 !== 2) blob.add(new Uint8Array(4));
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
