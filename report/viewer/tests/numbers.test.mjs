// What stands in the charts and tables, of hand-made reports whose numbers are known on paper.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { expectQuiet, go, launch, open, slide, TEMPLATE, writeReport } from "./support/browser.mjs";
import { Blob, emptyReport, fill, meshRecord, packGrasps, score, stage } from "./support/payload.mjs";
import { cuboidParts } from "./support/sources.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** Every figure by its heading: the table behind it as rows by header, and the texts and circles of its chart. */
function figures(page) {
  return page.evaluate(() => {
    const found = {};
    for (const figure of document.querySelectorAll(".figure")) {
      const texts = (selector) => [...figure.querySelectorAll(selector)].map((e) => e.textContent);
      const header = texts("thead th");
      found[figure.querySelector("h2").textContent] = {
        header,
        rows: [...figure.querySelectorAll("tbody tr")].map((tr) => [...tr.children].map((cell) => cell.textContent)),
        caption: figure.querySelector(":scope > .note")?.textContent,
        bold: texts('svg g[font-weight="600"] text'),
        labels: texts("svg g[aria-label$=label] text"),
        circles: [...figure.querySelectorAll("svg circle")].map((c) => ({
          fill: c.getAttribute("fill") ?? c.closest("g").getAttribute("fill"),
          title: c.querySelector("title")?.textContent,
        })),
        key: texts(".key span"),
      };
    }
    return found;
  });
}

const mean = (value, half, count) => ({ graspability: { mean: value, half_width: half, count } });
const RUN = [
  stage("prior", -1, { ...mean(0.004, 0.0004, 90), scores: [0.003, 0.005], samples: 95, statuses: [["ok", 95]] }),
  stage("e0", 0, {
    ...mean(0.002, 0.0002, 80),
    scores: [0.001, 0.002, 0.003],
    coverage: 0.5,
    nna: 0.6,
    duplicates: 0.1,
    diversity: 0.9,
    flat_share: 0.31,
    crease_share: 0.064,
  }),
  stage("e1", 1, {
    ...mean(0.001, 0.0002, 70),
    scores: [0.0005, 0.001, 0.0015, 0.001],
    samples: 200,
    statuses: [
      ["ok", 150],
      ["disjoint", 40],
      ["gaps", 10],
    ],
    coverage: 0.31,
    nna: 0.72,
    duplicates: 0.23,
    diversity: 0.84,
  }),
  stage("c1", 1, {
    ...mean(0.0016, 0.0001, 60),
    control: true,
    label: "control 1",
    scores: [0.0016],
    coverage: 0.45,
    nna: 0.66,
    duplicates: 0.17,
    diversity: 0.95,
  }),
];

const at = (name, group, g, more = {}) => ({
  name,
  group,
  status: "ok",
  score: score(g),
  metres_per_unit: 0.05,
  com: [0, 0, 0],
  grasps: null,
  numbers: [],
  print: null,
  ...more,
});

/** "1 % more" with plain blanks, to be read by a test. */
const plain = (text) => text.replace(/[\u202f\u00a0]/g, " ");

describe("a run's charts and tables", () => {
  let shown, headline, lead, examples;
  before(async () => {
    const blob = new Blob();
    const mesh = meshRecord(blob, cuboidParts([0.1, 0.2, 0.4]));
    const columns = {
      step: [10, 20],
      loss_discriminator: [1, 2],
      loss_generator: [3, 5],
      gradient_discriminator: [7, 8],
      gradient_generator: [9, 12],
      rate_discriminator: [1, 1],
      rate_generator: [2, 2],
      largest_sigma: [13, 14],
    };
    const report = emptyReport({
      run: { stages: RUN, losses: [{ episode: 0, control: false, columns }] },
      groups: RUN.slice(0, 3).map(({ id, label }) => ({ id, label })),
      objects: [at("p", 0, 0.005, { mesh }), at("a", 1, 0.002, { mesh }), at("b", 2, 0.0005, { mesh })],
    });
    const page = await open(browser, writeReport("numbers.html", fill(TEMPLATE, report, blob)));
    shown = await figures(page);
    headline = plain(await page.locator(".headline").innerText());
    lead = plain(await page.locator(".lead").innerText());
    examples = await page.locator(".example-row").allInnerTexts();
    await expectQuiet(page);
  });

  test("histograms are in units of episode 0, whose own mean is 1.00", () => {
    const { header, rows, bold, labels } = shown["Distribution of graspability"];
    assert.deepEqual(bold, ["2.00", "1.00", "0.50"]);
    assert.ok(labels.includes("graspability / mean of episode 0"));
    assert.deepEqual(header, ["stage", "objects", "10th percentile", "median", "90th percentile"]);
    assert.deepEqual(rows, [
      ["prior set", "2", "1.600", "2.000", "2.400"],
      ["episode 0", "3", "0.600", "1.000", "1.400"],
      ["episode 1", "4", "0.325", "0.500", "0.675"],
    ]);
  });

  // Half widths by the delta method: 0.25 sqrt(0.2^2 + 0.1^2) = 0.056 and so on.
  test("kappa is in units of episode 0, and its table has every reference", () => {
    const { header, rows, bold, labels, circles } = shown["κ per episode"];
    assert.deepEqual(bold, ["0.50"]);
    assert.ok(labels.includes("κ: mean graspability / episode 0"));
    assert.deepEqual(circles.map(({ fill, title }) => `${fill} ${title}`).slice(1), [
      "var(--control) control 1: 0.800 (0.750 to 0.850)",
      "var(--run) episode 0: 1.000 (0.900 to 1.100)",
      "var(--run) episode 1: 0.500 (0.400 to 0.600)",
      "var(--prior) prior set: 2.000 (1.800 to 2.200)",
    ]);
    const graspability = "graspability, ×\u00a010⁻³";
    assert.deepEqual(header, ["stage", "samples", "scored", graspability, "/ prior set", "/ episode 0", "/ control"]);
    assert.deepEqual(rows, [
      ["prior set", "95", "90", "4.00 ± 0.40", "1.000 ± 0.141", "2.000 ± 0.283", "–"],
      ["episode 0", "10", "80", "2.00 ± 0.20", "0.500 ± 0.071", "1.000 ± 0.141", "–"],
      ["episode 1", "200", "70", "1.00 ± 0.20", "0.250 ± 0.056", "0.500 ± 0.112", "0.625 ± 0.131"],
      ["control 1", "10", "60", "1.60 ± 0.10", "0.400 ± 0.047", "0.800 ± 0.094", "–"],
    ]);
  });

  test("the headline and the examples tell the same kappas", () => {
    assert.match(headline, /0\.25\s± 0\.06\s+κ against the prior set: 75 % lower/);
    assert.match(headline, /0\.50\s± 0\.11\s+κ against episode 0: 50 % lower/);
    assert.match(headline, /0\.63\s± 0\.13\s+κ against the control: 38 % lower/);
    assert.equal(lead, "Mean graspability of episode 1: (1.00 ± 0.20) × 10⁻³ over 70 objects, 95 % interval.");
    assert.deepEqual(
      examples.map((row) => row.split(/\s*\n\s*/)),
      [
        ["prior set", "κ 2.00", "5.00"],
        ["episode 0", "κ 1.00", "2.00"],
        ["episode 1", "κ 0.50", "0.50"],
      ],
    );
  });

  test("measures of variety and reasons of rejection stand under their names", () => {
    const variety = shown["Variety and likeness to the prior set"];
    assert.deepEqual(variety.header, [
      "stage",
      "coverage",
      "1-nna",
      "near-duplicates",
      "diversity",
      "flat edges",
      "creases",
    ]);
    assert.deepEqual(
      variety.rows.map((row) => row.map(plain)),
      [
        ["episode 0", "50 %", "0.60", "10 %", "0.90", "31 %", "6.4 %"],
        ["episode 1", "31 %", "0.72", "23 %", "0.84", "–", "–"],
        ["control 1", "45 %", "0.66", "17 %", "0.95", "–", "–"],
      ],
    );
    const rejection = shown["Rejection by reason"];
    assert.deepEqual(rejection.header, ["stage", "samples", "rejected", "disjoint", "gaps"]);
    assert.deepEqual(rejection.rows[2].map(plain), ["episode 1", "200", "25.0 %", "40", "10"]);
  });

  test("losses of discriminator and generator are not exchanged", () => {
    const { header, rows } = shown["Losses"];
    assert.deepEqual(header.slice(1), [
      "last update",
      "discriminator",
      "generator",
      "gradient, d.",
      "gradient, g.",
      "largest σ",
    ]);
    assert.deepEqual(rows, [["episode 0", "20", "1.5000", "4.0000", "7.5000", "10.5000", "13.5000"]]);
  });
});

test("another shape model's scalars have a chart each and their means in the table", async () => {
  const losses = [0, 1].map((episode) => ({
    episode,
    control: false,
    columns: { step: [10, 20], radius: [0.25, 0.75], mean_gap: [4, 8], "<i>": [null, null] },
  }));
  const report = emptyReport({ run: { stages: RUN, losses } });
  const page = await open(browser, writeReport("spheres.html", fill(TEMPLATE, report)));
  const shown = await figures(page);
  assert.equal(shown["Losses"], undefined);
  assert.deepEqual(shown["Radius"].header.slice(1), ["last update", "radius", "mean_gap"]);
  assert.deepEqual(shown["Radius"].rows, [
    ["episode 0", "20", "0.5000", "6.0000"],
    ["episode 1", "20", "0.5000", "6.0000"],
  ]);
  await page.locator("summary", { hasText: /^Mean gap$/ }).click();
  const curve = page.locator(".figure .figure", { hasText: "Mean gap" }).locator("svg g[aria-label=line] path");
  assert.equal((await curve.first().getAttribute("d")).match(/M/g).length, 2, "a curve for every episode");
  await expectQuiet(page);
});

describe("perturbed objects", () => {
  let page;
  before(async () => {
    const blob = new Blob();
    const mesh = meshRecord(blob, cuboidParts([0.1, 0.2, 0.4]));
    const grasp = [0, 0.2, 0, 0, -0.2, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0.003, 0.4];
    const grasps = blob.add(packGrasps([grasp]));
    const displacement = blob.add(new Uint8Array(8));
    const side = (g, more) => ({ label: "was", score: score(g), mesh, metres_per_unit: 0.05, grasps: null, ...more });
    const report = emptyReport({
      kind: "perturbed",
      groups: [{ id: "objects", label: "perturbed objects" }],
      objects: [
        at("a", 0, 0.001, {
          mesh,
          grasps,
          pair: side(0.004, { displacement, max_displacement: 0.1 }),
          numbers: [["faces", "12"]],
          print: {
            size_mm: [60, 40, 38],
            wall_mm: 1.5,
            watertight: true,
            overhang: 0.25,
            pose: null,
            pose_probability: null,
            notes: [],
          },
        }),
        at("b", 0, 0.003, { mesh, pair: side(0.002) }),
      ],
    });
    page = await open(browser, writeReport("pairs.html", fill(TEMPLATE, report, blob)));
  });
  after(() => expectQuiet(page));

  // Means 3 before and 2 after; residuals (1 - 4 * 2/3) / 3 and (3 - 2 * 2/3) / 3 are -+5/9: half 1.96 * 5/9.
  test("are counted against the mean before", async () => {
    const shown = await figures(page);
    const { rows, bold } = shown["Distribution of graspability"];
    assert.deepEqual(bold, ["1.00", "0.67"]);
    assert.deepEqual(rows, [
      ["before", "2", "0.733", "1.000", "1.267"],
      ["after", "2", "0.400", "0.667", "0.933"],
    ]);
    const headline = plain(await page.locator(".headline").innerText());
    assert.match(headline, /33\.3 %\s± 108\.9\s+lower mean graspability/);
    assert.match(headline, /3\.00 → 2\.00/);
    assert.match(headline, /1\s+of 2\s+objects became harder/);
    const { circles, key } = shown["Each object before and after"];
    assert.deepEqual(key, ["harder to grasp", "easier"]);
    assert.deepEqual(
      circles.map(({ fill, title }) => `${fill} ${title}`),
      ["var(--run) a: 4.00 to 1.00", "var(--bad) b: 2.00 to 3.00"],
    );
    const table = shown["Scores"];
    assert.deepEqual(table.header.map(plain), [
      "object",
      "status",
      "before, × 10⁻³",
      "after, × 10⁻³",
      "change",
      "95 % interval after",
      "quality > 0",
      "grasps",
    ]);
    assert.deepEqual(table.rows[0].map(plain), ["a", "ok", "4.000", "1.000", "−75.0 %", "0.90–1.10", "70 %", "100"]);
  });

  test("have their numbers in millimetres and beside those of the original", async () => {
    await go(page, "#/object/0");
    const rows = (await page.locator(".side table tr").allInnerTexts()).map((row) => plain(row).split("\t"));
    assert.deepEqual(rows, [
      ["", "was", "after"],
      ["graspability, × 10⁻³", "4.000", "1.000"],
      ["95 % interval", "3.60–4.40", "0.90–1.10"],
      ["mean quality, × 10⁻³", "3.200", "0.800"],
      ["grasps with quality > 0", "70 %", "70 %"],
      ["grasps sampled", "100", "100"],
      ["faces", "12"],
      ["size, mm", "60.0 × 40.0 × 38.0"],
      ["thinnest wall, mm", "1.50"],
      ["watertight", "yes"],
      ["overhanging share of the surface", "25 %"],
      ["suggested pose", "–"],
    ]);
    assert.match(plain(await page.locator(".big-change").innerText()), /^−75\.0 %/);
    assert.equal(
      plain(await page.locator(".lengths").innerText()),
      "Lengths are millimetres of the object as scored, each scaled to a smallest extent of 40 mm: 10.0 × 20.0 × 40.0.",
    );
    // 0.4 units of 50 mm.
    assert.match(plain(await page.locator(".readout").innerText()), /after\s+quality 3\.00 × 10⁻³, width 20\.0 mm/);
    await page.getByLabel(/distance to the original/).check();
    assert.match(plain(await page.locator(".legend:visible").nth(1).innerText()), /0\s+5\.00 mm/);
    const cut = async (axis, share) => {
      await page.getByLabel(axis, { exact: true }).check({ force: true });
      await slide(page, "Position", share);
      const chart = page.locator(".section-chart").nth(1);
      return [
        plain(await chart.locator(".note").innerText()),
        await chart.locator("svg g[aria-label$=label] text").allTextContents(),
      ];
    };
    // Through a box of 10 x 20 x 40 mm, from low to high.
    const [x, ofX] = await cut("x", 75);
    assert.match(x, /x = 2\.5 mm$/);
    assert.ok(ofX.includes("y, mm") && ofX.includes("z, mm"), ofX);
    const [z, ofZ] = await cut("z", 0);
    assert.match(z, /z = −20\.0 mm$/);
    assert.ok(ofZ.includes("x, mm") && ofZ.includes("y, mm"), ofZ);
  });
});
