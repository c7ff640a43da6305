// Simulated trials beside the metric, and their executions in motion: reports built in code, because a page of the
// binary would need a run of the physics engine.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import {
  expectQuiet,
  frames,
  go,
  heading,
  launch,
  open,
  settled,
  slide,
  TEMPLATE,
  writeReport,
} from "./support/browser.mjs";
import { picture, readable } from "./support/looks.mjs";
import { Blob, bumpy, emptyReport, fill, meshRecord, objects } from "./support/payload.mjs";
import { difference, ink } from "./support/png.mjs";
import { near, sources } from "./support/sources.mjs";

const SECONDS = 1.2;
const FRAMES = 61;

/** Closes until 0.3 s, then holds; a lost one falls from 0.6 s on, and turns by a right angle about z. */
function execution(lost) {
  return Array.from({ length: FRAMES }, (_, i) => {
    const t = (SECONDS * i) / (FRAMES - 1);
    const gap = 0.03 - 0.02 * Math.min(1, t / 0.3);
    const falling = lost ? Math.max(0, t - 0.6) : 0;
    const half = (falling * Math.PI) / 4 / 0.6;
    const presses = t >= 0.3 && falling === 0;
    return {
      t,
      object: [0, 0, -0.1 * falling, Math.cos(half), 0, 0, Math.sin(half)],
      tips: [
        [-gap, 0, 0],
        [gap, 0, 0],
      ],
      forces: presses
        ? [
            [-0.012, 0, 0, 15, 0, 1],
            [0.012, 0, 0, -15, 0, 1],
          ]
        : [],
      table: t < 0.4 ? -0.015 : null,
    };
  });
}

function replay(blob, more, lost) {
  return {
    protocol: "six-ways",
    side: "after",
    friction: 0.5,
    metres_per_unit: 0.04,
    tip: { kind: "sphere", radius: 0.005 },
    up: [0, 0, 1],
    frames: blob.add(Buffer.from(JSON.stringify(execution(lost)))),
    ...more,
  };
}

const grasp = (series, rank, held, executions) => ({
  series,
  grasp: rank,
  quality: 0.003 - 0.0002 * rank,
  held,
  executions,
  outcomes: [
    ["held", held],
    ["slipped", executions - held],
  ],
});

function trials(blob) {
  return {
    series: [
      { protocol: "six-ways", side: "before", friction: 0.25, held: 0.65, low: 0.6, high: 0.7 },
      { protocol: "six-ways", side: "after", friction: 0.25, held: 0.54, low: 0.49, high: 0.6 },
      { protocol: "paper", side: "after", masses: "equal", friction: 0.3, held: 0.8, low: null, high: null },
    ],
    grasps: [
      ...Array.from({ length: 8 }, (_, i) => grasp(0, i, 5 - (i % 3), 5)),
      ...Array.from({ length: 6 }, (_, i) => grasp(1, i, 4 - (i % 4), 5)),
      ...Array.from({ length: 3 }, (_, i) => grasp(2, i, 2, 3)),
    ],
    replays: [
      replay(blob, { grasp: 7, execution: 1, outcome: "slipped" }, true),
      replay(
        blob,
        { grasp: 2, execution: 0, outcome: "held", tip: { kind: "pad", half: [0.002, 0.01, 0.008] } },
        false,
      ),
      replay(blob, { grasp: 3, execution: 4, outcome: "lost closing", side: "before" }, true),
    ],
  };
}

let browser, path;
before(async () => {
  browser = await launch();
  const blob = new Blob();
  const list = objects(blob, 3);
  list[0].trials = trials(blob);
  list[0].pair = { label: "before", score: null, mesh: meshRecord(blob, bumpy(9)), metres_per_unit: 0.04 };
  list[1].trials = { ...trials(blob), replays: [] };
  path = writeReport("trials.html", fill(TEMPLATE, emptyReport({ objects: list, kind: "perturbed" }), blob));
});
after(() => browser.close());

describe("trials on the object's page", () => {
  test("say what is held before and after, with intervals, and who judged", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    const box = page.locator(".trials");
    const rows = await box.locator("table.numbers tbody tr").allInnerTexts();
    assert.match(rows[0], /six-ways, friction 0\.25\s+65\s%\s\(60–70\)\s+54\s%\s\(49–60\)$/);
    assert.match(rows[1], /paper, friction 0\.30, equal mass\s+–\s+80\s%$/);
    assert.match(await box.innerText(), /Judge: a physics engine[^]*No robot has held it/);
    await expectQuiet(page);
  });

  test("show every grasp by success over quality, a protocol at a time", async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    const chart = page.locator(".trial-chart");
    assert.equal(await chart.locator("circle").count(), 14);
    const title = await chart.locator("circle title").first().textContent();
    assert.match(title, /grasp 0, before: quality 3\.00.*; 5 held, 0 slipped/);
    await page.getByLabel("Protocol of the chart").selectOption("paper, friction 0.30, equal mass");
    await frames(page);
    assert.equal(await chart.locator("circle").count(), 3);
    await expectQuiet(page);
  });

  test("are absent where there were none, and without replays nothing is offered to watch", async () => {
    const page = await open(browser, path, { hash: "#/object/2" });
    assert.equal(await page.locator(".trials").count(), 0);
    await go(page, "#/object/1");
    assert.equal(await page.locator(".trials").count(), 1);
    assert.equal(await page.getByRole("link", { name: /Watch/ }).count(), 0);
    await go(page, "#/object/1/replay");
    await heading(page, "No execution of this object is stored.");
    await expectQuiet(page);
  });

  test("are readable at both widths in light and dark", () =>
    readable(browser, path, ["#/object/0", "#/object/0/replay"]));
});

describe("a replay", () => {
  const openReplay = async () => {
    const page = await open(browser, path, { hash: "#/object/0" });
    await page.getByRole("link", { name: "Watch 3 executions" }).click();
    await page.waitForFunction(() => location.hash === "#/object/0/replay");
    await frames(page);
    return page;
  };
  const captions = (page) => page.locator("figcaption").allInnerTexts();

  test("begins with a held execution beside a lost one, at rest", async () => {
    const page = await openReplay();
    assert.deepEqual(await page.locator("figcaption b").allInnerTexts(), ["held", "slipped"]);
    assert.match(
      await page.getByLabel("Execution on the left").locator("option:checked").textContent(),
      /^held: grasp 2, execution 0 \(six-ways\)$/,
    );
    const start = [await picture(page, ".panel-picture", 0), await picture(page, ".panel-picture", 1)];
    assert.ok(ink(start[0]) > 0.05 && ink(start[1]) > 0.05);
    assert.equal(await page.getByRole("button", { name: "Play" }).count(), 1);
    assert.equal(difference(start[0], await picture(page, ".panel-picture", 0)), 0);
    await expectQuiet(page);
  });

  test("is scrubbed: jaws close, forces come, and the lost one falls while the other stays", async () => {
    const page = await openReplay();
    const both = async () => [await picture(page, ".panel-picture", 0), await picture(page, ".panel-picture", 1)];
    const open_ = await both();
    assert.match((await captions(page))[0], /contacts 0/);
    await slide(page, "Time", 450);
    assert.match((await captions(page))[0], /contacts 2, largest force 15\.0\sN, friction 0\.50/);
    const closed = await both();
    assert.ok(difference(open_[0], closed[0]) > 0.01, "the jaws have closed");
    await slide(page, "Time", 1000);
    const end = await both();
    assert.equal(difference(closed[0], end[0]), 0, "the held one stays");
    assert.ok(difference(closed[1], end[1]) > 0.05, "the lost one has gone");
    assert.match((await captions(page))[1], /contacts 0/);
    await page.getByLabel("forces on the object").uncheck();
    assert.ok(difference(end[0], await picture(page, ".panel-picture", 0)) > 0.001, "its forces can be hidden");
    await expectQuiet(page);
  });

  test("plays at the speed that is chosen, pauses, and plays again from its end", async () => {
    const page = await openReplay();
    const at = () => page.getByLabel("Time", { exact: true }).evaluate((input) => input.valueAsNumber);
    await page.getByLabel("Speed").selectOption("real time");
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForFunction(() => document.querySelector(".clock input").valueAsNumber > 100);
    await page.getByRole("button", { name: "Pause" }).click();
    const paused = await at();
    await frames(page);
    assert.equal(await at(), paused);
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForFunction(() => document.querySelector(".clock input").valueAsNumber === 1000);
    await page.getByRole("button", { name: "Play" }).click();
    await page.getByRole("button", { name: "Pause" }).click();
    assert.ok((await at()) < 1000);
    await expectQuiet(page);
  });

  test("shows another execution when it is chosen, with the mesh of its side", async () => {
    const page = await openReplay();
    const last = await picture(page, ".panel-picture", 0);
    await page.getByLabel("Execution on the left").selectOption("2");
    await settled(page);
    assert.equal(await page.locator("figcaption b").first().innerText(), "lost closing");
    assert.ok(difference(last, await picture(page, ".panel-picture", 0)) > 0.02);
    await expectQuiet(page);
  });

  test("without WebGL says so, and its words still follow the time", async () => {
    const page = await open(browser, path, { hash: "#/object/0/replay", webgl: false });
    assert.match(await page.getByRole("alert").innerText(), /no WebGL/);
    await slide(page, "Time", 450);
    assert.match((await captions(page))[0], /contacts 2/);
    await expectQuiet(page);
  });
});

describe("the data of a replay", () => {
  let page;
  before(async () => {
    page = await sources();
  });
  after(() => page.close());

  test("between two frames poses are between theirs, contacts those of the earlier one", async () => {
    const { momentAt } = await page.load("/src/data/trials.ts");
    const half = Math.SQRT1_2;
    const pair = [
      {
        t: 1,
        object: [0, 0, 0, 1, 0, 0, 0],
        tips: [
          [-2, 0, 0],
          [2, 0, 0],
        ],
        forces: [[1, 2, 3, 4, 5, 6]],
        table: -1,
      },
      {
        t: 3,
        object: [4, 2, 0, half, 0, 0, half],
        tips: [
          [-1, 0, 0],
          [1, 0, 0],
        ],
        forces: [],
        table: -3,
      },
    ]; // a quarter turn about z
    const moment = momentAt(pair, 2);
    assert.deepEqual(moment.position.toArray(), [2, 1, 0]);
    near(moment.rotation.z, Math.sin(Math.PI / 8), 1e-12);
    near(moment.rotation.w, Math.cos(Math.PI / 8), 1e-12);
    assert.equal(moment.tips[0].x, -1.5);
    assert.equal(moment.table, -2);
    assert.equal(moment.forces.length, 1);
    assert.equal(momentAt(pair, 0).position.x, 0);
    assert.equal(momentAt(pair, 9).position.x, 4);
    assert.equal(momentAt(pair, 9).forces.length, 0);
  });

  test("the first pair is one held and one lost of the same protocol and side", async () => {
    const { firstPair } = await page.load("/src/data/trials.ts");
    const of = (outcome, protocol = "paper", side = "after") => ({ outcome, protocol, side });
    assert.deepEqual(firstPair([of("slipped", "six-ways"), of("held"), of("slipped")]), [1, 2]);
    assert.deepEqual(firstPair([of("slipped", "six-ways"), of("held")]), [1, 0]);
    assert.deepEqual(firstPair([of("held")]), [0]);
    assert.deepEqual(firstPair([of("held"), of("held")]), [0, 1]);
    assert.deepEqual(firstPair([of("turned away"), of("slipped")]), [0, 1]);
  });
});
