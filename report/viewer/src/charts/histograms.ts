import * as Plot from "@observablehq/plot";
import type { Stage } from "../data/report";
import { binEdges, histogram, meanOf, stagesOf } from "../data/statistics";
import { known, percent, short } from "../format";
import { COLOURS, figure, key } from "./figure";

interface Row {
  label: string;
  values: number[];
  colour: string;
  mean: number | null;
  /** The control of the same episode: drawn as an outline. */
  other: number[];
}

const BINS = 36;
const ROW_HEIGHT = 74,
  FEW_ROWS_HEIGHT = 120;

/** One histogram per row over a shared axis. Values and means in units of the axis. */
export function stackedHistograms(rows: Row[], label: string, width: number): Element {
  const all = rows.flatMap((row) => [...row.values, ...row.other]).sort((a, b) => a - b);
  // One outlier would squeeze everything else: the last bin takes the highest thousandth.
  const high = all.length ? all[Math.ceil(0.999 * all.length) - 1] : 1;
  const edges = binEdges(high, BINS);
  const bars = rows.flatMap((row) =>
    histogram(row.values, edges).map((bin) => ({ ...bin, row: row.label, colour: row.colour })),
  );
  const outlines = rows.flatMap((row) =>
    row.other.length ? steps(histogram(row.other, edges)).map((p) => ({ ...p, row: row.label })) : [],
  );
  const means = rows
    .filter((row) => row.mean !== null)
    .map((row) => ({ row: row.label, mean: row.mean, text: row.mean!.toFixed(2) }));
  const empty = rows.filter((row) => row.values.length === 0).map((row) => ({ row: row.label }));
  const narrow = width < 520;
  return Plot.plot({
    width,
    height: rows.length * (rows.length < 4 ? FEW_ROWS_HEIGHT : ROW_HEIGHT) + 60,
    marginLeft: narrow ? 42 : 46,
    marginRight: narrow ? 72 : 92,
    marginBottom: 42,
    marginTop: 14,
    ariaLabel: "Histograms of graspability by stage",
    style: { fontSize: "12px" },
    fy: {
      domain: rows.map((row) => row.label),
      label: null,
      padding: 0.16,
      tickFormat: (t: string) => short(t, narrow ? 9 : 13),
    },
    x: { domain: [0, edges[edges.length - 1]], label, labelAnchor: "center", labelArrow: "none", grid: true },
    y: { label: null, ticks: 2, tickFormat: (t: number) => percent(t), insetTop: 4 },
    marks: [
      Plot.rectY(bars, {
        fy: "row",
        x1: "x1",
        x2: "x2",
        y: "share",
        fill: "colour",
        fillOpacity: 0.78,
        insetLeft: 0.5,
        insetRight: 0.5,
      }),
      Plot.line(outlines, { fy: "row", x: "x", y: "y", stroke: COLOURS.control, strokeWidth: 1.6 }),
      Plot.ruleY([0], { stroke: COLOURS.ink, strokeOpacity: 0.5 }),
      Plot.ruleX(means, { fy: "row", x: "mean", stroke: COLOURS.ink, strokeWidth: 1.5 }),
      Plot.text(means, {
        fy: "row",
        x: "mean",
        text: "text",
        frameAnchor: "top",
        dx: 5,
        dy: -2,
        textAnchor: "start",
        fontWeight: 600,
        stroke: "var(--bg)",
        fill: COLOURS.ink,
        strokeWidth: 4,
      }),
      Plot.text(empty, {
        fy: "row",
        text: () => "not scored",
        frameAnchor: "middle",
        fill: COLOURS.ink,
        fillOpacity: 0.6,
      }),
    ],
  });
}

/** The outline of a histogram as points of a line. */
function steps(bins: { x1: number; x2: number; share: number }[]): { x: number; y: number }[] {
  return [
    { x: 0, y: 0 },
    ...bins.flatMap((bin) => [
      { x: bin.x1, y: bin.share },
      { x: bin.x2, y: bin.share },
    ]),
  ];
}

/** The histograms of Fig. 4: graspability of every stage in units of the mean of episode 0. */
export function stageHistograms(stages: Stage[]): HTMLElement | null {
  const { prior, episodes, first, control } = stagesOf(stages);
  const reference = meanOf(first) ?? meanOf(prior);
  if (!reference || reference.value <= 0) return null;
  const values = (stage: Stage | undefined) => (stage?.scores ?? []).filter(known).map((v) => v / reference.value);
  const mean = (stage: Stage) => (meanOf(stage) ? meanOf(stage)!.value / reference.value : null);
  const rows: Row[] = [...(prior ? [prior] : []), ...episodes].map((stage) => ({
    label: stage.label,
    values: values(stage),
    colour: stage === prior ? COLOURS.prior : COLOURS.run,
    mean: mean(stage),
    other: values(control.find((c) => c.episode === stage.episode)),
  }));
  if (!rows.some((row) => row.values.length)) return null;
  const named = meanOf(first) ? "episode 0" : "the prior set";
  return figure({
    title: "Distribution of graspability",
    caption: `Share of a stage's objects per bin; the line and the number are the stage's mean.`,
    legend: key([
      ["run", COLOURS.run],
      ...(control.length ? [["control", COLOURS.control, "outline"] as [string, string, "outline"]] : []),
      ...(prior ? [["prior set", COLOURS.prior] as [string, string]] : []),
    ]),
    draw: (width) => stackedHistograms(rows, `graspability / mean of ${named}`, width),
    numbers: {
      header: ["stage", "objects", "10th percentile", "median", "90th percentile"],
      rows: rows.map((row) => [
        row.label,
        String(row.values.length),
        ...[0.1, 0.5, 0.9].map((q) => quantile(row.values, q)),
      ]),
    },
  });
}

export function quantile(values: number[], q: number): string {
  if (!values.length) return "–";
  const sorted = [...values].sort((a, b) => a - b);
  const at = q * (sorted.length - 1);
  const low = Math.floor(at);
  return (sorted[low] + (at - low) * ((sorted[low + 1] ?? sorted[low]) - sorted[low])).toFixed(3);
}
