// What a reader does with a report of the binary: looks, sorts, turns, slides, downloads.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { expectQuiet, go, heading, launch, open, overflow, poorContrast, settled, slide } from "./support/browser.mjs";
import { perturbedReport, runReport } from "./support/inputs.mjs";
import { difference, ink } from "./support/png.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** Every page at both widths, in light and dark: as wide as the window, text readable. */
async function readable(path, hashes) {
  const page = await open(browser, path);
  for (const hash of hashes) {
    await go(page, hash);
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 700 });
      await settled(page);
      await page.evaluate(() => document.querySelectorAll("details").forEach((d) => { d.open = true; }));
      assert.ok(await overflow(page) <= 0, `${hash} at ${width} px is ${await overflow(page)} px too wide`);
      for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        assert.deepEqual(await poorContrast(page), [], `${hash}, ${colorScheme}`);
      }
    }
  }
  await expectQuiet(page);
}

/** The picture of a part of the page once drawing has come to rest. */
async function picture(page, selector, nth = 0) {
  await settled(page);
  return page.locator(selector).nth(nth).screenshot();
}

async function drag(page, locator, dx, dy = 0) {
  const box = await locator.boundingBox();
  const x = box.x + box.width / 2, y = box.y + box.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2);
  await page.mouse.move(x + dx, y + dy);
  await page.mouse.up();
}

describe("a run", () => {
  let path;
  before(async () => { path = await runReport(); });

  test("shows its numbers, charts, configuration and provenance", async () => {
    const page = await open(browser, path);
    await settled(page);
    for (const heading of ["κ per episode", "Distribution of graspability", "Rejection by reason", "Losses", "Provenance"]) {
      assert.equal(await page.getByRole("heading", { name: heading, exact: true }).count(), 1, heading);
    }
    const headline = await page.locator(".headline").innerText();
    for (const against of ["prior set", "episode 0", "control"]) assert.match(headline, new RegExp(`\\d\\.\\d\\d\\s+± \\d[^]*κ against ${against === "episode 0" ? against : `the ${against}`}`));
    assert.ok(await page.locator(".chart svg").count() >= 4);
    assert.ok(ink(await picture(page, ".example-tiles .picture")) > 0.05, "objects are drawn");
    assert.match(await page.locator(".facts").innerText(), /commit\s+\S[^]*seed\s+\d/);
    await page.getByText("Configuration", { exact: true }).click();
    assert.match(await page.locator("pre").innerText(), /\[cem\]/);
    // The table and the headline tell the same number.
    await page.locator(".figure", { has: page.getByRole("heading", { name: "κ per episode" }) }).getByText("Numbers").click();
    const rows = await page.locator(".figure table").first().locator("tbody tr").allInnerTexts();
    const episodes = rows.filter((row) => row.startsWith("episode"));
    const against0 = episodes[episodes.length - 1].split("\t")[5].split(" ")[0];
    assert.ok(headline.includes(Number(against0).toFixed(2)), `${against0} in ${headline}`);
    await expectQuiet(page);
  });

  test("is readable at both widths in light and dark", () => readable(path, ["#/", "#/gallery", "#/object/0"]));

  test("sorts, filters and finds its objects", async () => {
    const page = await open(browser, path, { hash: "#/gallery" });
    const scores = async (section = page) => (await section.locator(".tile-text b").allTextContents()).filter((t) => t !== "–").map((t) => Number(t.replace("−", "-")));
    const first = await picture(page, ".tile .picture");
    assert.ok(ink(first) > 0.05, "the first object is drawn");
    const all = await page.locator(".tile").count();
    await page.getByLabel("Sort by").selectOption("descending");
    assert.ok(difference(first, await picture(page, ".tile .picture")) > 0.01, "sorting changes what is drawn");
    for (const stage of await page.locator("section.stage").all()) {
      const values = await scores(stage);
      assert.deepEqual(values, [...values].sort((a, b) => b - a));
    }
    await page.getByLabel("stages apart").uncheck();
    await page.getByLabel("Sort by").selectOption("ascending");
    const mixed = await scores();
    assert.deepEqual(mixed, [...mixed].sort((a, b) => a - b));
    assert.equal(await page.locator(".tile").count(), all);
    await page.getByLabel("Sort by").selectOption("name");
    const names = await page.locator(".tile").evaluateAll((tiles) => tiles.map((tile) => tile.title));
    assert.deepEqual(names, [...names].sort(new Intl.Collator("en", { numeric: true }).compare));
    const chips = page.locator(".chip input");
    await chips.first().uncheck();
    const fewer = await page.locator(".tile").count();
    assert.ok(fewer > 0 && fewer < all, "a stage less");
    await page.getByLabel("Find").fill(names[0]);
    assert.ok(await page.locator(".tile").count() < fewer);
    await page.getByLabel("Find").fill("no such object");
    assert.match(await page.getByRole("status").innerText(), /No object/);
    await expectQuiet(page);
  });

  test("turns one object or all together", async () => {
    const page = await open(browser, path, { hash: "#/gallery" });
    const both = async () => [await picture(page, ".tile .picture", 0), await picture(page, ".tile .picture", 1)];
    const start = await both();
    await drag(page, page.locator(".tile .picture").first(), 60);
    const together = await both();
    assert.ok(difference(start[0], together[0]) > 0.01 && difference(start[1], together[1]) > 0.01, "both turned");
    assert.match(page.url(), /gallery$/, "a drag opens nothing");
    await page.getByLabel("turn all together").uncheck();
    await drag(page, page.locator(".tile .picture").first(), 60);
    await page.mouse.move(2, 2);
    const alone = await both();
    assert.ok(difference(together[0], alone[0]) > 0.01, "the first turned");
    assert.ok(difference(together[1], alone[1]) < 0.002, "the second did not");
    await expectQuiet(page);
  });

  test("is reached by keyboard: Tab to a tile, arrows turn, Enter opens, the focus is seen", async () => {
    const page = await open(browser, path, { hash: "#/gallery" });
    const before = await picture(page, ".tile .picture");
    const onTile = () => page.evaluate(() => document.activeElement.classList.contains("tile"));
    let presses = 0;
    while (!await onTile()) {
      await page.keyboard.press("Tab");
      assert.ok(++presses < 40, "a tile is reached within forty steps");
    }
    assert.notEqual(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), "none");
    await page.keyboard.press("ArrowRight");
    assert.ok(difference(before, await picture(page, ".tile .picture")) > 0.01, "an arrow turns");
    const name = await page.evaluate(() => document.activeElement.title);
    await page.keyboard.press("Enter");
    await heading(page, name);
    assert.equal(await page.evaluate(() => document.activeElement.tagName), "H1", "the focus goes along");
    await page.locator(".panels").focus();
    const still = await picture(page, ".panel-picture");
    await page.keyboard.press("ArrowLeft");
    assert.ok(difference(still, await picture(page, ".panel-picture")) > 0.01, "arrows turn the object");
    await expectQuiet(page);
  });

  test("leads from an object to its neighbours in the gallery's order", async () => {
    const page = await open(browser, path, { hash: "#/gallery" });
    await page.getByLabel("Sort by").selectOption("ascending");
    const names = await page.locator(".tile").evaluateAll((tiles) => tiles.slice(0, 3).map((tile) => tile.title));
    await page.locator(".tile").nth(1).click();
    await heading(page, names[1]);
    await page.getByRole("link", { name: "next" }).click();
    await heading(page, names[2]);
    await page.getByRole("link", { name: "previous" }).click();
    await heading(page, names[1]);
    await page.getByRole("link", { name: "previous" }).click();
    await heading(page, names[0]);
    await page.goBack();
    await heading(page, names[1]);
    await expectQuiet(page);
  });
});

describe("perturbed objects", () => {
  let path, count;
  before(async () => { ({ path, count } = await perturbedReport()); });

  test("are compared pair by pair", async () => {
    const page = await open(browser, path);
    await settled(page);
    assert.match(await page.locator(".headline").innerText(), /%\s*± [\d.]+[^]*mean graspability, 95 % interval/);
    const scatter = page.locator(".figure", { has: page.getByRole("heading", { name: "Each object before and after" }) });
    assert.equal(await scatter.locator("circle").count(), count);
    assert.equal(await page.locator(".figure table").last().locator("tbody tr").count(), count);
    assert.equal(await page.locator(".example-row").count(), 2);
    await scatter.locator("circle").first().click();
    await page.waitForFunction(() => location.hash.startsWith("#/object/"));
    await expectQuiet(page);
  });

  test("are readable at both widths in light and dark", () => readable(path, ["#/", "#/object/1"]));

  test("show before and after under one camera", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    const both = async () => [await picture(page, ".panel-picture", 0), await picture(page, ".panel-picture", 1)];
    const start = await both();
    assert.ok(ink(start[0]) > 0.05 && ink(start[1]) > 0.05);
    assert.ok(difference(start[0], start[1]) > 0.005, "they differ");
    await drag(page, page.locator(".panel-picture").first(), 80, 20);
    const turned = await both();
    assert.ok(difference(start[0], turned[0]) > 0.02 && difference(start[1], turned[1]) > 0.02, "a drag turns both");
    // Without grasps, seen from the same side, an object changed by little looks much like its original.
    await slide(page, "Grasps shown, best first", 0);
    const [a, b] = await both();
    assert.ok(difference(a, b) < difference(start[0], turned[0]));
    await expectQuiet(page);
  });

  test("every control of the object page changes what is drawn", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    const looks = { view: () => picture(page, ".panel-picture", 1), section: () => picture(page, ".section-chart", 1) };
    const last = { view: await looks.view(), section: await looks.section() };
    const changes = async (what, look, act, least = 0.002) => {
      await act();
      const now = await looks[look]();
      const share = difference(last[look], now);
      assert.ok(share > least, `${what} changes ${share} of the picture`);
      last[look] = now;
    };
    await changes("fewer grasps", "view", () => slide(page, "Grasps shown, best first", 2));
    await changes("more grasps", "view", () => slide(page, "Grasps shown, best first", 40));
    await changes("another grasp", "view", () => slide(page, "Chosen grasp", 7));
    assert.ok(await page.getByLabel("gripper on the chosen grasp").isChecked(), "the gripper comes with it");
    await changes("the gripper", "view", () => page.getByLabel("gripper on the chosen grasp").uncheck());
    await changes("friction cones", "view", () => page.getByLabel("friction cones of all").check());
    await changes("heat", "view", () => page.getByLabel(/distance to the original/).check(), 0.02);
    assert.match(await page.locator(".legend:visible").nth(1).innerText(), /0\s+[\d.]+ mm/);
    await changes("seeing through", "view", () => page.getByLabel("see through the object").check());
    await changes("the cut's position", "section", () => slide(page, "Position", 62));
    assert.ok(await page.getByLabel("show the cut in the 3D view").isChecked());
    await changes("the cut's position in 3D", "view", () => slide(page, "Position", 35));
    await changes("the cut's axis", "section", () => page.getByLabel("z", { exact: true }).check({ force: true }), 0.02);
    await changes("hiding the cut", "view", () => page.getByLabel("show the cut in the 3D view").uncheck());
    const readout = await page.locator(".readout").innerText();
    await page.locator(".strip").first().click({ position: { x: 150, y: 30 } });
    assert.notEqual(await page.locator(".readout").innerText(), readout, "a click on the strip chooses a grasp");
    await expectQuiet(page);
  });

  test("a click on an axis chooses its grasp", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    await settled(page);
    const rank = page.getByLabel("Chosen grasp", { exact: true });
    const box = await page.locator(".panel-picture").first().boundingBox();
    // Axes stick out of the object somewhere in the picture: look for one.
    const chosen = new Set();
    for (let i = 3; i < 18 && chosen.size < 2; ++i) for (let j = 3; j < 18 && chosen.size < 2; ++j) {
      await page.mouse.click(box.x + (box.width * i) / 20, box.y + (box.height * j) / 20);
      chosen.add(await rank.inputValue());
    }
    assert.ok(chosen.size > 1, "no click chose a grasp");
    await expectQuiet(page);
  });

  test("numbers of metric, similarity and print check stand beside the object", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    const side = await page.locator(".side").innerText();
    assert.match(side, /graspability, ×\s10⁻³\s+\d\.\d+\s+\d\.\d+/);
    assert.match(side, /Similarity[^]*normal[^]*\d/);
    assert.match(side, /Print check[^]*size, mm\s+[\d.]+ × [\d.]+ × [\d.]+[^]*watertight\s+yes/);
    await expectQuiet(page);
  });

  test("STL and PNG are downloaded: millimetres, as many triangles as shown", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    await settled(page);
    const save = async (name) => {
      const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name }).click()]);
      return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
    };
    const stl = await save("Download STL");
    assert.match(stl.name, /^cylinders-000000\.stl$/);
    const shown = Number((await page.locator(".lead").innerText()).match(/([\d\s\u202f]+) triangles/)[1].replace(/\D/g, ""));
    const triangles = stl.bytes.readUInt32LE(80);
    assert.equal(triangles, shown);
    assert.equal(stl.bytes.length, 84 + 50 * triangles);
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    let volume = 0;
    for (let t = 0; t < triangles; ++t) {
      const p = [0, 1, 2].map((c) => [0, 1, 2].map((k) => stl.bytes.readFloatLE(84 + 50 * t + 12 + 12 * c + 4 * k)));
      for (const v of p) v.forEach((x, k) => { low[k] = Math.min(low[k], x); high[k] = Math.max(high[k], x); });
      volume += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) + p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) / 6;
    }
    const size = (await page.locator(".side").innerText()).match(/size, mm\s+([\d.]+) × ([\d.]+) × ([\d.]+)/).slice(1).map(Number);
    const rotated = high.map((x, k) => x - low[k]);
    if (/in the suggested print pose/.test(await page.locator(".buttons").innerText())) assert.ok(Math.max(...rotated) <= Math.hypot(...size) + 0.1);
    else rotated.forEach((x, k) => assert.ok(Math.abs(x - size[k]) < 0.2, `${rotated} mm is not ${size} mm`));
    assert.ok(Math.abs(low[2]) < 1e-3, "it stands on the plate");
    assert.ok(volume > 0.05 * size[0] * size[1] * size[2], "a solid, its faces outwards");
    const png = await save("Save PNG");
    assert.match(png.name, /\.png$/);
    assert.ok(ink(png.bytes) > 0.02, "not blank");
    await expectQuiet(page);
  });

  test("the file is small", () => {
    assert.ok(statSync(path).size < 2_000_000 + count * 60_000, "the page and at most 60 kB an object: 30 MB for 500");
  });
});
