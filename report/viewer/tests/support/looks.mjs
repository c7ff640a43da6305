import assert from "node:assert/strict";
import { expectQuiet, frames, go, open, overflow, poorContrast, settled } from "./browser.mjs";

/** Every page at both widths, in light and dark: as wide as the window, text readable. */
export async function readable(browser, path, hashes) {
  const page = await open(browser, path);
  for (const hash of hashes) {
    await go(page, hash);
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 700 });
      await frames(page);
      await page.evaluate(() =>
        document.querySelectorAll("details").forEach((d) => {
          d.open = true;
        }),
      );
      assert.ok((await overflow(page)) <= 0, `${hash} at ${width} px is ${await overflow(page)} px too wide`);
      for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        assert.deepEqual(await poorContrast(page), [], `${hash}, ${colorScheme}`);
      }
    }
  }
  await expectQuiet(page);
}

/** The picture of a part of the page once drawing has come to rest. */
export async function picture(page, selector, nth = 0) {
  const element = page.locator(selector).nth(nth);
  await element.evaluate((e) => e.scrollIntoView({ block: "nearest" }));
  await settled(page);
  return page.screenshot({ clip: await element.boundingBox() });
}

export async function drag(page, locator, dx, dy = 0) {
  const box = await locator.boundingBox();
  const x = box.x + box.width / 2,
    y = box.y + box.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2);
  await page.mouse.move(x + dx, y + dy);
  await page.mouse.up();
}
