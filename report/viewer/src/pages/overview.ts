import { kappaFigure } from "../charts/kappa";
import { stackedHistograms, stageHistograms, quantile } from "../charts/histograms";
import { lossFigure } from "../charts/losses";
import { pairedHistograms, pairedScatter, pairPoints } from "../charts/paired";
import { rejectionFigure, varietyFigure } from "../charts/stages";
import { COLOURS, figure } from "../charts/figure";
import { graspability, isRejected, type Report } from "../data/report";
import { type Estimate, meanOf, pairedReduction, ratio, stagesOf } from "../data/statistics";
import { details, h, table } from "../dom";
import { count, fixed, known, milli, MILLI_UNIT, NONE, percent, plusMinus } from "../format";
import { objectLink, type Page } from "../router";
import { exampleFigure } from "./examples";

interface Headline {
  value: string;
  half: string;
  says: string;
}

function headlineTiles(lines: Headline[]): HTMLElement | null {
  if (!lines.length) return null;
  return h(
    "dl",
    { class: "headline" },
    ...lines.map((line) =>
      h(
        "div",
        {},
        h("dd", {}, h("b", {}, line.value), line.half ? " " : null, line.half ? h("span", {}, line.half) : null),
        h("dt", {}, line.says),
      ),
    ),
  );
}

function asHeadline(e: Estimate | null, says: (lower: string) => string): Headline[] {
  if (!e) return [];
  const lower = e.value <= 1 ? `${fixed(100 * (1 - e.value), 0)} % lower` : `${fixed(100 * (e.value - 1), 0)} % higher`;
  return [{ value: fixed(e.value, 2), half: known(e.half) ? `± ${fixed(e.half, 2)}` : "", says: says(lower) }];
}

function runHeadline(report: Report): { lead: string; tiles: Headline[] } {
  const { prior, episodes, first, control } = stagesOf(report.run!.stages);
  const scored = episodes.filter((s) => meanOf(s));
  const last = scored[scored.length - 1];
  if (!last) return { lead: "No episode has been scored.", tiles: [] };
  const mean = meanOf(last);
  const twin = control.find((s) => s.episode === last.episode);
  const lead = `Mean graspability of ${last.label}: (${milli(mean!.value)}\u00a0±\u00a0${milli(mean!.half)})\u00a0${MILLI_UNIT} over ${count(last.graspability?.count)} objects, 95 % interval.`;
  return {
    lead,
    tiles: [
      ...asHeadline(ratio(mean, meanOf(prior)), (lower) => `κ against the prior set: ${lower}`),
      ...(last === first ? [] : asHeadline(ratio(mean, meanOf(first)), (lower) => `κ against episode 0: ${lower}`)),
      ...asHeadline(ratio(mean, meanOf(twin)), (lower) => `κ against the control: ${lower}`),
    ],
  };
}

function pairedHeadline(report: Report): { lead: string; tiles: Headline[] } {
  const pairs = pairPoints(report.objects);
  const reduction = pairedReduction(
    pairs.map((p) => p.before),
    pairs.map((p) => p.after),
  );
  if (!reduction) return { lead: "No object was scored before and after.", tiles: [] };
  const mean = (side: "before" | "after") => pairs.reduce((sum, p) => sum + p[side], 0) / pairs.length;
  const lower = pairs.filter((p) => p.after < p.before).length;
  const less = reduction.value >= 0;
  return {
    lead: `${count(pairs.length)} of ${count(report.objects.length)} objects scored before and after, under equal random draws.`,
    tiles: [
      {
        value: percent(Math.abs(reduction.value), 1),
        half: known(reduction.half) ? `± ${fixed(100 * reduction.half, 1)}` : "",
        says: `${less ? "lower" : "higher"} mean graspability, 95 % interval`,
      },
      {
        value: `${milli(mean("before"))} → ${milli(mean("after"))}`,
        half: "",
        says: `mean graspability, ${MILLI_UNIT}`,
      },
      { value: count(lower), half: `of ${count(pairs.length)}`, says: "objects became harder to grasp" },
    ],
  };
}

function objectsHeadline(report: Report): { lead: string; tiles: Headline[] } {
  const values = report.objects.map(graspability).filter(known);
  const n = values.length;
  const rejected = report.objects.filter(isRejected).length;
  const lead = `${count(report.objects.length)} objects, ${count(n)} of them scored${rejected ? `, ${count(rejected)} rejected` : ""}.`;
  if (!n) return { lead, tiles: [] };
  const mean = values.reduce((a, b) => a + b, 0) / n;
  const deviation = Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / Math.max(1, n - 1));
  return {
    lead,
    tiles: [
      {
        value: milli(mean),
        half: n > 1 ? `± ${milli((1.96 * deviation) / Math.sqrt(n))}` : "",
        says: `mean graspability, ${MILLI_UNIT}, 95 % interval`,
      },
      { value: milli(Math.min(...values)), half: "", says: `least graspable, ${MILLI_UNIT}` },
      { value: milli(Math.max(...values)), half: "", says: `most graspable, ${MILLI_UNIT}` },
    ],
  };
}

function objectFigures(report: Report): (HTMLElement | null)[] {
  const groups = report.groups.map((group, g) => ({
    label: group.label,
    values: report.objects
      .filter((o) => o.group === g)
      .map(graspability)
      .filter(known)
      .map((v) => 1000 * v),
  }));
  const rows = groups
    .filter((g) => g.values.length)
    .map((g) => ({
      ...g,
      colour: COLOURS.run,
      mean: g.values.reduce((a, b) => a + b, 0) / g.values.length,
      other: [],
    }));
  const histograms = rows.length
    ? figure({
        title: "Distribution of graspability",
        caption: "Share of objects per bin; the line and the number are the mean.",
        draw: (width) => stackedHistograms(rows, `graspability, ${MILLI_UNIT}`, width),
        numbers: {
          header: ["", "objects", "10th percentile", "median", "90th percentile"],
          rows: rows.map((row) => [
            row.label,
            String(row.values.length),
            ...[0.1, 0.5, 0.9].map((q) => quantile(row.values, q)),
          ]),
        },
        className: "wide",
      })
    : null;
  return [histograms, objectTable(report)];
}

function objectTable(report: Report): HTMLElement | null {
  if (!report.objects.length) return null;
  const paired = report.kind === "perturbed";
  const header = paired
    ? [
        "object",
        "status",
        `before, ${MILLI_UNIT}`,
        `after, ${MILLI_UNIT}`,
        "change",
        "95 % interval after",
        "quality > 0",
        "grasps",
      ]
    : [
        "object",
        "status",
        `graspability, ${MILLI_UNIT}`,
        "95 % interval",
        `mean quality, ${MILLI_UNIT}`,
        "quality > 0",
        "grasps",
      ];
  const rows = report.objects.map((o) => {
    const score = o.score,
      before = graspability(o.pair),
      after = graspability(o);
    const interval =
      known(score?.ci_low) && known(score?.ci_high) ? `${milli(score!.ci_low)}–${milli(score!.ci_high)}` : NONE;
    const change = known(before) && known(after) && before > 0 ? percent(after / before - 1, 1) : NONE;
    const middle = paired
      ? [milli(before, 3), milli(after, 3), change, interval]
      : [milli(after, 3), interval, milli(score?.mean, 3)];
    return [o.name, o.status, ...middle, percent(score?.fraction_nonzero), count(score?.num_grasps)];
  });
  const element = table(header, rows, "Scores of all objects");
  element
    .querySelectorAll("tbody th")
    .forEach((cell, i) => cell.replaceChildren(h("a", { href: objectLink(i) }, report.objects[i].name)));
  return h("section", { class: "figure wide" }, h("h2", {}, "Scores"), element);
}

function provenance(report: Report): HTMLElement | null {
  const metric = report.metric;
  const rows: [string, string][] = [...report.provenance];
  if (metric) {
    if (known(metric.percentile))
      rows.push(["graspability", `${fixed(metric.percentile, 0)}th percentile of robust quality`]);
    if (known(metric.num_grasps))
      rows.push(["grasps per object", `${count(metric.num_grasps)}, ${count(metric.num_draws)} draws each`]);
    if (known(metric.friction)) rows.push(["friction coefficient", plusMinus(metric.friction, null, 2)]);
    if (metric.noise) rows.push(["noise", metric.noise]);
  }
  if (!rows.length && report.config === null) return null;
  return h(
    "section",
    { class: "figure wide" },
    h("h2", {}, "Provenance"),
    h("dl", { class: "facts" }, ...rows.map(([label, value]) => h("div", {}, h("dt", {}, label), h("dd", {}, value)))),
    report.config !== null
      ? details("Configuration", h("pre", { tabindex: 0, "aria-label": "Configuration" }, report.config))
      : null,
  );
}

function missingNotice(report: Report): HTMLElement | null {
  const sentences = [...report.missing];
  if (report.kind === "run" && !report.run?.stages.length && !sentences.length)
    sentences.push("This run holds no stage yet: nothing has been trained or scored.");
  if (!report.objects.length && !sentences.length) sentences.push("This report holds no objects.");
  if (!sentences.length) return null;
  return h(
    "section",
    { class: "notice", "aria-label": "What is missing" },
    h("h2", {}, "Not there"),
    h("ul", {}, ...sentences.map((text) => h("li", {}, text))),
  );
}

export function overviewPage(report: Report): Page {
  const { lead, tiles } =
    report.kind === "run" && report.run
      ? runHeadline(report)
      : report.kind === "perturbed"
        ? pairedHeadline(report)
        : objectsHeadline(report);
  const stages = report.run?.stages ?? [];
  const losses = report.run?.losses ?? [];
  const pairs = pairPoints(report.objects);
  const examples = exampleFigure(report);
  const figures =
    report.kind === "run"
      ? [
          kappaFigure(stages),
          stageHistograms(stages),
          varietyFigure(stages),
          rejectionFigure(stages),
          lossFigure(losses),
        ]
      : report.kind === "perturbed"
        ? [pairedHistograms(pairs), pairedScatter(pairs), objectTable(report)]
        : objectFigures(report);
  const toGallery = report.objects.length
    ? h("a", { href: "#/gallery", class: "button" }, `See all ${count(report.objects.length)} objects`)
    : null;
  const element = h(
    "main",
    { class: "overview" },
    h(
      "div",
      { class: "page-head with-button" },
      h("div", {}, h("h1", { tabindex: -1 }, report.title || "Report"), h("p", { class: "lead" }, lead)),
      toGallery,
    ),
    headlineTiles(tiles),
    missingNotice(report),
    h("div", { class: "figures" }, examples?.element, ...figures, provenance(report)),
  );
  return { title: "", element, mounted: examples?.mounted, dispose: examples?.dispose };
}
