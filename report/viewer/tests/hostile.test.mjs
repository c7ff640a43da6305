// Reports that the binary cannot be made to write: hostile names, missing numbers, browsers without WebGL.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import {
  expectQuiet,
  go,
  launch,
  open,
  overflow,
  poorContrast,
  settled,
  TEMPLATE,
  writeReport,
} from "./support/browser.mjs";
import { Blob, emptyReport, fill, graspPart, GROUPS, objects, score, stage } from "./support/payload.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

describe("hostile names", () => {
  const EVIL = [
    `"><img src=x onerror="document.title='pwned'">`,
    `</script><script>window.pwned = 1</script>`,
    `'; alert(1); '`,
    `<b>bold</b> & &amp; &lt;`,
    "naïve 物体 🤖 \u202Ertl\u202C \u0000\u0007",
    "__proto__",
    "a".repeat(300),
    "../../etc/passwd",
    "<!-- --> <![CDATA[",
    "\u2028\u2029 ${1+1} `x`",
  ];
  test("never break a page nor run script", async () => {
    const blob = new Blob();
    const list = objects(blob, EVIL.length, EVIL).map((o, i) => ({
      ...o,
      status: i % 3 === 1 ? EVIL[0] : "ok",
      numbers: [[EVIL[1], EVIL[0]]],
      group: i % 2,
      grasps: graspPart(blob, () => 0.3, 5),
      print: {
        size_mm: [60, 50, 40],
        wall_mm: null,
        watertight: null,
        overhang: null,
        pose: null,
        pose_probability: null,
        notes: [EVIL[1]],
      },
      pair: { label: EVIL[1], score: score(0.002), mesh: o.mesh, metres_per_unit: 0.08, com: [0, 0, 0], grasps: null },
    }));
    const report = emptyReport({
      title: EVIL[1],
      missing: [EVIL[0]],
      provenance: [[EVIL[0], EVIL[1]]],
      config: EVIL[1],
      groups: [
        { id: EVIL[0], label: EVIL[0] },
        { id: "b", label: EVIL[1] },
      ],
      objects: list,
      run: {
        stages: [
          stage(EVIL[0], 0, {
            label: EVIL[1],
            statuses: [
              ["ok", 5],
              [EVIL[0], 5],
            ],
          }),
          stage("c", 1, { label: EVIL[0] }),
        ],
        losses: [],
      },
    });
    const page = await open(browser, writeReport("hostile.html", fill(TEMPLATE, report, blob)));
    const untouched = async (where) => {
      assert.equal(await page.evaluate(() => window.pwned), undefined, where);
      assert.equal(
        await page.evaluate(() => document.querySelectorAll("img, b b, #app script, #app style:not(svg style)").length),
        0,
        `${where}: no markup came out of a name`,
      );
      assert.ok((await overflow(page)) <= 0, `${where}: no name makes the page wider`);
    };
    assert.equal(await page.title(), EVIL[1]);
    await untouched("overview");
    await go(page, "#/gallery");
    await settled(page);
    assert.equal(await page.locator(".tile").count(), EVIL.length);
    assert.equal(await page.locator(".tile").first().getAttribute("title"), EVIL[0]);
    await untouched("gallery");
    await page.setViewportSize({ width: 390, height: 844 });
    for (const hash of ["#/", "#/gallery", "#/object/6"]) {
      await go(page, hash);
      await untouched(`${hash} on a narrow screen`);
    }
    assert.equal(await page.locator("h1").textContent(), EVIL[6]);
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Download STL" }).click(),
    ]);
    assert.match(download.suggestedFilename(), /^[\w.-]{1,90}\.stl$/);
    await expectQuiet(page);
  });
});

describe("missing numbers and stages", () => {
  test("show as gaps and dashes", async () => {
    const nothing = {
      graspability: { mean: null, half_width: null, count: 0 },
      coverage: null,
      nna: null,
      duplicates: null,
      diversity: null,
      scores: null,
      elite_threshold: null,
    };
    const report = emptyReport({
      run: {
        stages: [
          stage("prior", -1),
          stage("e0", 0),
          stage("e1", 1, nothing),
          stage("e2", 2, { ...nothing, graspability: null, samples: null, statuses: [] }),
          stage("e3", 3),
        ],
        losses: [
          {
            episode: 0,
            control: false,
            columns: {
              step: [10, 20, 30, 40, 50],
              loss_discriminator: [1, null, 3, 2, 1],
              loss_generator: [null, null, null, null, null],
            },
          },
        ],
      },
    });
    const page = await open(browser, writeReport("gaps.html", fill(TEMPLATE, report)));
    const kappa = page.locator(".figure", { has: page.getByRole("heading", { name: "κ per episode" }) });
    await kappa.locator("svg").waitFor();
    const points = await kappa.locator("svg circle").count();
    assert.equal(points, 3, "prior set, episodes 0 and 3");
    const line = await kappa.locator("svg g[aria-label=line] path").last().getAttribute("d");
    assert.equal(line.match(/M/g).length, 2, "the line breaks at the stages without a number");
    await kappa.getByText("Numbers").click();
    const row = await kappa.locator("tbody tr").nth(2).locator("td").allTextContents();
    assert.deepEqual(row.slice(2), ["–", "–", "–", "–"]);
    const text = await page.locator("main").innerText();
    assert.ok(!/NaN|undefined|null|Infinity/.test(text), text.match(/.*(NaN|undefined|null|Infinity).*/)?.[0]);
    assert.equal(await page.locator("svg text", { hasText: "not scored" }).count(), 2);
    await expectQuiet(page);
  });

  test("an object without score, mesh or grasps has a page that says so", async () => {
    const blob = new Blob();
    const [whole] = objects(blob, 1);
    const list = [
      { name: "bare", group: 0, status: "disjoint", score: null, mesh: null, metres_per_unit: 0.08 },
      {
        ...whole,
        name: "no numbers",
        score: score(null, { ci_low: null, ci_high: null, mean: null, fraction_nonzero: null, num_grasps: null }),
      },
      { ...whole, name: "cut short", mesh: { ...whole.mesh, positions: [0, 7, 100] } },
    ];
    const page = await open(
      browser,
      writeReport("bare.html", fill(TEMPLATE, emptyReport({ kind: "objects", objects: list, groups: GROUPS }), blob)),
      { hash: "#/object/0" },
    );
    assert.match(await page.locator("main").innerText(), /Rejected: disjoint[^]*no mesh/);
    await go(page, "#/object/1");
    assert.match(await page.locator("table.numbers").first().innerText(), /graspability, ×\s10⁻³\s+–/);
    await go(page, "#/object/2");
    assert.match(await page.locator("main").innerText(), /cannot be decoded/);
    await go(page, "#/gallery");
    assert.equal(await page.locator(".tile").count(), 3);
    await go(page, "#/object/99");
    assert.match(await page.locator("main").innerText(), /no object 99/);
    page.trouble = page.trouble.filter((text) => !/mesh cannot be decoded/.test(text)); // said on purpose
    await expectQuiet(page);
  });

  test("an empty run says what is missing", async () => {
    const report = emptyReport({
      run: { stages: [], losses: [] },
      missing: ["prior_scores.csv is not there: nothing has been scored"],
    });
    for (const [width, scheme] of [
      [1280, "light"],
      [390, "dark"],
    ]) {
      const page = await open(browser, writeReport("empty.html", fill(TEMPLATE, report)), { width, scheme });
      assert.match(
        await page.getByRole("region", { name: "What is missing" }).innerText(),
        /prior_scores\.csv is not there/,
      );
      assert.match(await page.locator("main").innerText(), /commit\s+abc/);
      assert.ok((await overflow(page)) <= 0);
      assert.deepEqual(await poorContrast(page), []);
      await go(page, "#/gallery");
      assert.match(await page.locator("main").innerText(), /holds no objects/);
      await expectQuiet(page);
    }
  });

  test("the template without data, and data that are no report, say so", async () => {
    const page = await open(browser, TEMPLATE);
    assert.match(await page.locator("h1").innerText(), /holds no data/);
    await expectQuiet(page);
    const later = await open(browser, writeReport("later.html", fill(TEMPLATE, emptyReport({ version: 1 }))));
    assert.match(await later.locator("h1").innerText(), /version 1/);
    await expectQuiet(later);
  });
});

test("without WebGL a sentence stands where objects would be, and charts and tables work", async () => {
  const blob = new Blob();
  const report = emptyReport({
    objects: objects(blob, 5),
    groups: GROUPS,
    run: { stages: [stage("prior", -1), stage("e0", 0), stage("e1", 1)], losses: [] },
  });
  const page = await open(browser, writeReport("flat.html", fill(TEMPLATE, report, blob)), { webgl: false });
  assert.ok((await page.locator(".chart svg").count()) >= 3);
  assert.match(await page.getByRole("alert").innerText(), /no WebGL/);
  await go(page, "#/gallery");
  assert.match(await page.getByRole("alert").innerText(), /no WebGL/);
  assert.equal(await page.locator(".tile").count(), 5);
  await go(page, "#/object/2");
  assert.match(await page.getByRole("alert").innerText(), /no WebGL/);
  assert.match(await page.locator("main").innerText(), /Metric[^]*graspability/);
  await page.waitForSelector(".section-chart svg");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Download STL" }).click(),
  ]);
  assert.equal(download.suggestedFilename(), "sample-000002.stl");
  await expectQuiet(page);
});
