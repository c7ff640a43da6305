// What a reader does with changed objects: compares, slides, cuts, downloads.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { expectQuiet, launch, open, settled, slide } from "./support/browser.mjs";
import { perturbedReport } from "./support/inputs.mjs";
import { drag, picture, readable } from "./support/looks.mjs";
import { difference, ink } from "./support/png.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

describe("perturbed objects", () => {
  let path, count;
  before(async () => {
    ({ path, count } = await perturbedReport());
  });

  test("are compared pair by pair", async () => {
    const page = await open(browser, path);
    await settled(page);
    assert.match(await page.locator(".headline").innerText(), /%\s*± [\d.]+[^]*mean graspability, 95 % interval/);
    const scatter = page.locator(".figure", {
      has: page.getByRole("heading", { name: "Each object before and after" }),
    });
    assert.equal(await scatter.locator("circle").count(), count);
    assert.equal(await page.locator(".figure table").last().locator("tbody tr").count(), count);
    assert.equal(await page.locator(".example-row").count(), 2);
    await scatter.locator("circle").first().click();
    await page.waitForFunction(() => location.hash.startsWith("#/object/"));
    await expectQuiet(page);
  });

  test("are readable at both widths in light and dark", () => readable(browser, path, ["#/", "#/object/1"]));

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
    await changes(
      "the cut's axis",
      "section",
      () => page.getByLabel("z", { exact: true }).check({ force: true }),
      0.02,
    );
    await changes("hiding the cut", "view", () => page.getByLabel("show the cut in the 3D view").uncheck());
    const readout = await page.locator(".readout").innerText();
    await page
      .locator(".strip")
      .first()
      .click({ position: { x: 150, y: 30 } });
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
    for (let i = 3; i < 18 && chosen.size < 2; ++i)
      for (let j = 3; j < 18 && chosen.size < 2; ++j) {
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
    const shown = Number(
      (await page.locator(".lead").innerText()).match(/([\d\s\u202f]+) triangles/)[1].replace(/\D/g, ""),
    );
    const triangles = stl.bytes.readUInt32LE(80);
    assert.equal(triangles, shown);
    assert.equal(stl.bytes.length, 84 + 50 * triangles);
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity];
    let volume = 0;
    for (let t = 0; t < triangles; ++t) {
      const p = [0, 1, 2].map((c) => [0, 1, 2].map((k) => stl.bytes.readFloatLE(84 + 50 * t + 12 + 12 * c + 4 * k)));
      for (const v of p)
        v.forEach((x, k) => {
          low[k] = Math.min(low[k], x);
          high[k] = Math.max(high[k], x);
        });
      volume +=
        (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
          p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
          p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
        6;
    }
    const size = (await page.locator(".side").innerText())
      .match(/size, mm\s+([\d.]+) × ([\d.]+) × ([\d.]+)/)
      .slice(1)
      .map(Number);
    const rotated = high.map((x, k) => x - low[k]);
    if (/turned to the suggested print pose/.test(await page.locator(".buttons").innerText()))
      assert.ok(Math.max(...rotated) <= Math.hypot(...size) + 0.1);
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
