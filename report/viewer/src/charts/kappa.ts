import * as Plot from "@observablehq/plot";
import type { Stage } from "../data/report";
import { type Estimate, meanOf, ratio, stagesOf } from "../data/statistics";
import { count, milli, MILLI_UNIT, NONE, plusMinus } from "../format";
import { COLOURS, figure, key } from "./figure";

interface Point {
  stage: string;
  label: string;
  value: number;
  low: number;
  high: number;
}

/** Mean graspability in units of `base`; NaN leaves a gap in lines. */
function point(name: string, stage: Stage | undefined, base: number): Point {
  const mean = meanOf(stage);
  const value = mean ? mean.value / base : NaN;
  const half = (mean?.half ?? 0) / base;
  return { stage: name, label: stage?.label ?? name, value, low: value - half, high: value + half };
}

const asText = (e: Estimate | null) => (e ? plusMinus(e.value, e.half, 3) : NONE);

/** Kappa per stage with 95 % bands, run and control. */
export function kappaFigure(stages: Stage[]): HTMLElement | null {
  const { prior, episodes, first, control } = stagesOf(stages);
  const reference = meanOf(first) ?? meanOf(prior);
  if (!reference || reference.value <= 0) return null;
  const base = reference.value;
  const named = meanOf(first) ? "episode 0" : "the prior set";
  const last = Math.max(...[...episodes, ...control].map((s) => s.episode), 0);
  const domain = [...(prior ? ["prior"] : []), ...Array.from({ length: last + 1 }, (_, i) => String(i))];
  const series = (list: Stage[]) =>
    Array.from({ length: last + 1 }, (_, i) =>
      point(
        String(i),
        list.find((s) => s.episode === i),
        base,
      ),
    );
  const run = series(episodes);
  // The control leaves from episode 0, which it shares with the run.
  const other = control.length ? series(first ? [first, ...control] : control) : [];
  const priorPoint = prior ? [point("prior", prior, base)] : [];
  const dots = (data: Point[], colour: string) => [
    Plot.ruleX(
      data.filter((d) => d.high > d.low),
      { x: "stage", y1: "low", y2: "high", stroke: colour, strokeWidth: 1.5 },
    ),
    Plot.dot(data, {
      x: "stage",
      y: "value",
      fill: colour,
      r: 3.6,
      title: (d: Point) => `${d.label}: ${d.value.toFixed(3)} (${d.low.toFixed(3)} to ${d.high.toFixed(3)})`,
    }),
  ];
  const band = (data: Point[], colour: string) => [
    Plot.areaY(data, { x: "stage", y1: "low", y2: "high", fill: colour, fillOpacity: 0.16 }),
    Plot.lineY(data, { x: "stage", y: "value", stroke: colour, strokeWidth: 2.2 }),
    ...dots(data, colour),
  ];
  // Lines need no zero; the bands, a few hundredths wide, need room.
  const ends = [...run, ...other, ...priorPoint].flatMap((d) => [d.low, d.high]).filter(Number.isFinite);
  const bottom = Math.min(...ends) > 0.5 ? Math.min(...ends) - 0.1 : 0;
  const top = Math.max(1, ...ends) + 0.02;
  const draw = (width: number) =>
    Plot.plot({
      width,
      height: Math.min(430, Math.max(260, width * 0.72)),
      marginLeft: 46,
      marginBottom: 42,
      marginTop: 26,
      marginRight: 16,
      ariaLabel: "Kappa per episode",
      style: { fontSize: "12px" },
      x: { type: "point", domain, label: "episode", padding: 0.4, labelAnchor: "center", labelArrow: "none" },
      y: {
        label: `κ: mean graspability / ${named}`,
        grid: true,
        domain: [bottom, top],
        nice: true,
        labelArrow: "none",
      },
      marks: [
        Plot.ruleY([1], { stroke: COLOURS.ink, strokeOpacity: 0.35, strokeDasharray: "3 4" }),
        ...band(other, COLOURS.control),
        ...band(run, COLOURS.run),
        ...dots(priorPoint, COLOURS.prior),
        Plot.text(run.filter((d) => Number.isFinite(d.value)).slice(-1), {
          x: "stage",
          y: "value",
          text: (d: Point) => d.value.toFixed(2),
          dy: 18,
          fontWeight: 600,
          fill: COLOURS.run,
        }),
      ],
    });
  const keys: Parameters<typeof key>[0] = [["run", COLOURS.run, "line"]];
  if (other.length) keys.push(["control: random samples kept", COLOURS.control, "line"]);
  if (prior) keys.push(["prior set", COLOURS.prior, "area"]);
  const rows = [...(prior ? [prior] : []), ...episodes, ...control].map((s) => {
    const mean = meanOf(s);
    return [
      s.label,
      count(s.samples),
      count(s.graspability?.count),
      mean ? `${milli(mean.value)} ± ${milli(mean.half)}` : NONE,
      asText(ratio(mean, meanOf(prior))),
      asText(ratio(mean, meanOf(first))),
      s.control ? NONE : asText(ratio(mean, meanOf(control.find((c) => c.episode === s.episode)))),
    ];
  });
  return figure({
    title: "κ per episode",
    caption: `κ is the mean graspability of a stage divided by that of ${named}; bands are 95 % intervals of the stage's mean.`,
    legend: key(keys),
    draw,
    numbers: {
      header: ["stage", "samples", "scored", `graspability, ${MILLI_UNIT}`, "/ prior set", "/ episode 0", "/ control"],
      rows,
    },
  });
}
