// What a reader does with the report of a run: looks, sorts, turns, opens.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { expectQuiet, heading, launch, open, settled } from "./support/browser.mjs";
import { runReport } from "./support/inputs.mjs";
import { drag, picture, readable } from "./support/looks.mjs";
import { difference, ink } from "./support/png.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

describe("a run", () => {
  let path;
  before(async () => {
    path = await runReport();
  });

  test("shows its numbers, charts, configuration and provenance", async () => {
    const page = await open(browser, path);
    await settled(page);
    for (const heading of [
      "κ per episode",
      "Distribution of graspability",
      "Rejection by reason",
      "Losses",
      "Provenance",
    ]) {
      assert.equal(await page.getByRole("heading", { name: heading, exact: true }).count(), 1, heading);
    }
    const headline = await page.locator(".headline").innerText();
    for (const against of ["prior set", "episode 0", "control"])
      assert.match(
        headline,
        new RegExp(`\\d\\.\\d\\d\\s+± \\d[^]*κ against ${against === "episode 0" ? against : `the ${against}`}`),
      );
    assert.ok((await page.locator(".chart svg").count()) >= 4);
    assert.ok(ink(await picture(page, ".example-tiles .picture")) > 0.05, "objects are drawn");
    for (const fact of [/seed\s+1/, /commit\s+[0-9a-f]{7}/, /device\s+cpu/, /time\s+\d/])
      assert.match(await page.locator(".facts").innerText(), fact);
    await page.getByText("Configuration", { exact: true }).click();
    assert.match(await page.locator("pre").innerText(), /\[cem\]/);
    // The table and the headline tell the same number.
    await page
      .locator(".figure", { has: page.getByRole("heading", { name: "κ per episode" }) })
      .getByText("Numbers")
      .click();
    const rows = await page.locator(".figure table").first().locator("tbody tr").allInnerTexts();
    const episodes = rows.filter((row) => row.startsWith("episode"));
    const against0 = episodes[episodes.length - 1].split("\t")[5].split(" ")[0];
    assert.ok(headline.includes(Number(against0).toFixed(2)), `${against0} in ${headline}`);
    await expectQuiet(page);
  });

  test("is readable at both widths in light and dark", () =>
    readable(browser, path, ["#/", "#/gallery", "#/object/0"]));

  test("sorts, filters and finds its objects", async () => {
    const page = await open(browser, path, { hash: "#/gallery" });
    const scores = async (section = page) =>
      (await section.locator(".tile-text b").allTextContents())
        .filter((t) => t !== "–")
        .map((t) => Number(t.replace("−", "-")));
    const first = await picture(page, ".tile .picture");
    assert.ok(ink(first) > 0.05, "the first object is drawn");
    const all = await page.locator(".tile").count();
    await page.getByLabel("Sort by").selectOption("descending");
    assert.ok(difference(first, await picture(page, ".tile .picture")) > 0.01, "sorting changes what is drawn");
    for (const stage of await page.locator("section.stage").all()) {
      const values = await scores(stage);
      assert.deepEqual(
        values,
        [...values].sort((a, b) => b - a),
      );
    }
    await page.getByLabel("stages apart").uncheck();
    await page.getByLabel("Sort by").selectOption("ascending");
    const mixed = await scores();
    assert.deepEqual(
      mixed,
      [...mixed].sort((a, b) => a - b),
    );
    assert.equal(await page.locator(".tile").count(), all);
    await page.getByLabel("Sort by").selectOption("name");
    const names = await page.locator(".tile").evaluateAll((tiles) => tiles.map((tile) => tile.title));
    assert.deepEqual(names, [...names].sort(new Intl.Collator("en", { numeric: true }).compare));
    const chips = page.locator(".chip input");
    await chips.first().uncheck();
    const fewer = await page.locator(".tile").count();
    assert.ok(fewer > 0 && fewer < all, "a stage less");
    await page.getByLabel("Find").fill(names[0]);
    assert.ok((await page.locator(".tile").count()) < fewer);
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
    while (!(await onTile())) {
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
