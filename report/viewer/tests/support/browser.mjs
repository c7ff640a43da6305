import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const TEMPLATE = fileURLToPath(new URL("../../dist/template.html", import.meta.url));
export const folder = mkdtempSync(join(tmpdir(), "antigrasp-viewer-"));

/**
 * Debian's Chromium without a GPU: WebGL by SwiftShader, the page itself by the processor, which draws charts ten
 * times as fast. Root may not use its sandbox.
 */
export function launch() {
  const args = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-rasterization"];
  if (process.getuid?.() === 0) args.push("--no-sandbox");
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args });
}

export function writeReport(name, html) {
  const path = join(folder, name);
  writeFileSync(path, html);
  return path;
}

/**
 * A page on a report, with what went wrong: console errors, exceptions, refused or attempted requests. Every test ends
 * with expectQuiet().
 */
export async function open(
  browser,
  path,
  { hash = "#/", width = 820, height = 620, scheme = "light", webgl = true } = {},
) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: scheme,
    reducedMotion: "reduce",
    acceptDownloads: true,
  });
  context.setDefaultTimeout(120_000); // a machine that is busy with something else is no failure
  const page = await context.newPage();
  const trouble = [],
    requests = [];
  page.on("console", (m) => {
    if (m.type() === "error" || m.type() === "warning") trouble.push(`${m.type()}: ${m.text()}`);
  });
  page.on("pageerror", (e) => trouble.push(`exception: ${e.message}`));
  page.on("dialog", (d) => {
    trouble.push(`dialog: ${d.message()}`);
    d.dismiss();
  });
  page.on("request", (r) => {
    if (!r.url().startsWith("data:") && !r.url().startsWith("blob:")) requests.push(r.url());
  });
  if (!webgl)
    await page.addInitScript(() => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return /webgl/.test(kind) ? null : get.call(this, kind, ...rest);
      };
    });
  const address = pathToFileURL(path).href;
  await page.goto(address + hash);
  await frames(page);
  page.trouble = trouble;
  page.requests = requests;
  page.address = address;
  return page;
}

/** Throws when the page complained or asked for anything but itself; closes it. */
export async function expectQuiet(page) {
  // ANGLE on a software GPU warns that reading pixels is slow: not the page's doing.
  const trouble = page.trouble.filter((text) => !/GPU stall due to ReadPixels/.test(text));
  const others = page.requests.filter((url) => url.split("#")[0] !== page.address);
  await page.context().close();
  if (trouble.length) throw new Error(`the page complained: ${trouble.join("; ")}`);
  if (others.length) throw new Error(`the page asked for ${others.join(", ")}`);
}

/** Waits two frames: in the first the page learns its sizes, in the second its charts are there. */
export function frames(page) {
  return page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** Waits until all there is to draw has been drawn. */
export function settled(page) {
  return page.evaluate(async () => {
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    // Observers of sizes and of what is on the screen report between frames and may ask for another one.
    for (let quiet = 0; quiet < 2;) {
      await frame();
      const drawn = document.querySelector("canvas.surface, .pictured");
      quiet = drawn && !document.querySelector("[data-busy]") ? quiet + 1 : 0;
    }
  });
}

/** Scrolls down evenly for some seconds; how many frames the second with the fewest of them had. */
export function poorestSecond(page, { seconds = 3, speed = 1200 } = {}) {
  return page.evaluate(
    async ([duration, pixels]) => {
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      window.scrollTo(0, 0);
      const times = [await frame()];
      const from = times[0];
      while (times.at(-1) - from < duration) {
        window.scrollTo(0, (pixels * (times.at(-1) - from)) / 1000);
        times.push(await frame());
      }
      const windows = times.filter((t) => t + 1000 <= times.at(-1));
      return Math.min(...windows.map((t) => times.filter((u) => u > t && u <= t + 1000).length));
    },
    [1000 * seconds, speed],
  );
}

/** Goes to a page of the report and waits until it is there. */
export async function go(page, hash) {
  await page.evaluate(
    (to) =>
      new Promise((resolve) => {
        if (location.hash === to) return resolve();
        window.addEventListener("hashchange", () => resolve(), { once: true }); // the page's own listener came first
        location.hash = to;
      }),
    hash,
  );
  await frames(page);
}

/** Waits for the page of an object, or any other, by its heading. */
export async function heading(page, text) {
  await page.waitForFunction((t) => document.querySelector("h1")?.textContent === t, text);
}

/** Moves a slider as a hand would: value, then the input event. */
export async function slide(page, label, value) {
  await page.getByLabel(label, { exact: true }).evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, String(value));
}

/** How far the page is wider than the window, pixels. */
export function overflow(page) {
  return page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
}

/** The words of a page whose contrast with their background is below `least` (WCAG 2: 4.5). */
export function poorContrast(page, least = 4.5) {
  return page.evaluate((limit) => {
    const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const seen = new Map();
    const rgba = (css) => [...(seen.get(css) ?? seen.set(css, measured(css)).get(css))];
    const measured = (css) => {
      canvas.clearRect(0, 0, 1, 1);
      canvas.fillStyle = css;
      canvas.fillRect(0, 0, 1, 1);
      return [...canvas.getImageData(0, 0, 1, 1).data].map((x) => x / 255);
    };
    const over = (top, under) => [0, 1, 2].map((k) => top[3] * top[k] + (1 - top[3]) * under[k]);
    const background = (element) => {
      if (!element) return rgba(getComputedStyle(document.body).backgroundColor);
      const own = rgba(getComputedStyle(element).backgroundColor);
      return own[3] > 0.99 ? own : over(own, background(element.parentElement));
    };
    const luminance = (c) =>
      [0.2126, 0.7152, 0.0722].reduce(
        (sum, w, k) => sum + w * (c[k] <= 0.04045 ? c[k] / 12.92 : ((c[k] + 0.055) / 1.055) ** 2.4),
        0,
      );
    const poor = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const element = node.parentElement;
      if (!node.data.trim() || !element.checkVisibility() || element.closest("script,noscript,title,option,.hidden"))
        continue;
      const style = getComputedStyle(element);
      const svg = element instanceof SVGElement;
      const colour = rgba(svg ? style.fill : style.color);
      colour[3] *= svg ? Number(style.fillOpacity) : 1;
      const under = background(svg ? element.closest("div") : element);
      const [a, b] = [luminance(over(colour, under)), luminance(under)].sort((x, y) => y - x);
      const ratio = (a + 0.05) / (b + 0.05);
      if (ratio < limit) poor.push(`${node.data.trim().slice(0, 30)}: ${ratio.toFixed(2)}`);
    }
    return poor;
  }, least);
}
