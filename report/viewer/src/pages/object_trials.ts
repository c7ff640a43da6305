import * as Plot from "@observablehq/plot";
import { COLOURS, figure, key } from "../charts/figure";
import { choice } from "../controls";
import type { ObjectRecord } from "../data/report";
import type { Side, TrialGrasp, Trials, TrialSeries } from "../data/trials";
import { h } from "../dom";
import { fixed, known, milli, MILLI_UNIT, NONE, percent } from "../format";
import { replayLink } from "../router";
import { rowsOf } from "./object_numbers";

export const JUDGE =
  "Judge: a physics engine that closes two rigid fingertips on the object, lifts and loads it. No robot has held it. Robust quality is the metric's forecast, which sees no motion.";

const SIDES: Side[] = ["before", "after"];
const COLOUR = { before: COLOURS.prior, after: COLOURS.run };

/** Protocol, friction and mass: what both sides of a comparison have in common. */
function conditionsOf({ protocol, friction, masses }: TrialSeries): string {
  const parts = [
    protocol,
    known(friction) ? `friction ${fixed(friction, 2)}` : "",
    masses === "equal" ? "equal mass" : masses === "own" ? "own mass" : (masses ?? ""),
  ];
  return parts.filter(Boolean).join(", ");
}

function share(series: TrialSeries | undefined): string {
  if (!known(series?.held)) return NONE;
  const interval =
    known(series!.low) && known(series!.high)
      ? ` (${fixed(100 * series!.low, 0)}–${fixed(100 * series!.high, 0)})`
      : "";
  return percent(series!.held) + interval;
}

function outcomesOf(grasp: TrialGrasp): string {
  return grasp.outcomes.map(([word, count]) => `${count} ${word}`).join(", ");
}

/** Every grasp as a dot: the share of its executions that was held over its robust quality. */
function successChart(grasps: { grasp: TrialGrasp; side: Side }[]): HTMLElement {
  const shown = grasps.filter(({ grasp }) => known(grasp.quality) && grasp.executions > 0);
  const sides = SIDES.filter((side) => shown.some((g) => g.side === side));
  return figure({
    title: "Held in simulation over robust quality",
    className: "trial-chart",
    legend: sides.length > 1 ? key(sides.map((side) => [side, COLOUR[side]])) : undefined,
    caption: `Each dot is a grasp: the share of its executions that was held, over its robust quality, ${MILLI_UNIT}.`,
    draw: (width) =>
      Plot.plot({
        width,
        height: 200,
        marginLeft: 40,
        marginBottom: 36,
        ariaLabel: "Share of executions held in simulation over robust quality, a dot a grasp",
        style: { fontSize: "12px" },
        x: { label: `robust quality, ${MILLI_UNIT}`, labelAnchor: "center", labelArrow: "none", grid: true, ticks: 4 },
        y: { domain: [0, 100], label: "held, %", labelArrow: "none", grid: true, ticks: 5 },
        marks: [
          Plot.dot(shown, {
            x: ({ grasp }) => 1000 * grasp.quality!,
            y: ({ grasp }) => (100 * grasp.held) / grasp.executions,
            r: 4,
            fill: ({ side }: { side: Side }) => COLOUR[side],
            fillOpacity: 0.55,
            title: ({ grasp, side }) =>
              `grasp ${grasp.grasp}, ${side}: quality ${milli(grasp.quality)} ${MILLI_UNIT}; ${outcomesOf(grasp)}`,
          }),
        ],
      }),
    numbers: {
      header: ["grasp", "side", `quality, ${MILLI_UNIT}`, "held", "outcomes"],
      rows: grasps.map(({ grasp, side }) => [
        String(grasp.grasp),
        side,
        milli(grasp.quality),
        `${grasp.held} of ${grasp.executions}`,
        outcomesOf(grasp),
      ]),
    },
  });
}

/** The chart of one protocol at a time. */
function chartOf({ series, grasps }: Trials, conditions: string[]): HTMLElement | null {
  const sideOf = (grasp: TrialGrasp) => series[grasp.series]?.side ?? "after";
  const of = (wanted: string) =>
    grasps
      .filter((grasp) => series[grasp.series] && conditionsOf(series[grasp.series]) === wanted)
      .map((grasp) => ({ grasp, side: sideOf(grasp) }));
  const offered = conditions.filter((wanted) => of(wanted).length > 0);
  if (!offered.length) return null;
  const holder = h("div", {}, successChart(of(offered[0])));
  const select =
    offered.length > 1
      ? choice(
          "Protocol of the chart",
          offered[0],
          offered.map((name) => [name, name]),
          (name) => holder.replaceChildren(successChart(of(name))),
        )
      : null;
  return h("div", {}, select, holder);
}

/** What simulated trials say about the object; null when it was in none. */
export function trialsBox(object: ObjectRecord, index: number): HTMLElement | null {
  const trials = object.trials;
  if (!trials) return null;
  const conditions = [...new Set(trials.series.map(conditionsOf))];
  const sides = SIDES.filter((side) => trials.series.some((s) => s.side === side));
  const rows = conditions.map((wanted): [string, ...string[]] => [
    wanted,
    ...sides.map((side) => share(trials.series.find((s) => s.side === side && conditionsOf(s) === wanted))),
  ]);
  const replays = trials.replays.length;
  return h(
    "section",
    { class: "panel-box trials" },
    h("h2", {}, "Simulated trials"),
    rows.length ? rowsOf(rows, sides.length > 1 ? ["", ...sides] : null) : null,
    h("p", { class: "note" }, `Share of executions held, 95 % interval in brackets. ${JUDGE}`),
    chartOf(trials, conditions),
    replays
      ? h(
          "p",
          {},
          h("a", { href: replayLink(index) }, `Watch ${replays === 1 ? "an execution" : `${replays} executions`}`),
        )
      : null,
  );
}
