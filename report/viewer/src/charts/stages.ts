import * as Plot from "@observablehq/plot";
import type { Num, Stage } from "../data/report";
import { stagesOf } from "../data/statistics";
import { h } from "../dom";
import { count, fixed, known, percent, short } from "../format";
import { COLOURS, figure, key } from "./figure";

interface Measure {
  name: string;
  says: string;
  value: (stage: Stage) => Num | undefined;
  text: (value: Num | undefined) => string;
  /** Top of the axis; left out: what the data need. */
  top?: number;
  /** A dashed line; of the prior set where that has one. */
  ideal?: (prior: Stage | undefined) => Num | undefined;
}

function rejectedShare(stage: Stage): Num {
  const total = stage.samples ?? stage.statuses.reduce((sum, [, n]) => sum + n, 0);
  const bad = stage.statuses.filter(([status]) => status !== "ok").reduce((sum, [, n]) => sum + n, 0);
  return total > 0 ? bad / total : null;
}

const MEASURES: Measure[] = [
  {
    name: "Coverage",
    says: "share of the prior set that is some sample's nearest",
    value: (s) => s.coverage,
    text: (v) => percent(v),
    top: 1,
  },
  {
    name: "1-NNA",
    says: "0.5: not to be told from the prior set; 1: apart",
    value: (s) => s.nna,
    text: (v) => fixed(v, 2),
    top: 1,
    ideal: () => 0.5,
  },
  {
    name: "Near-duplicates",
    says: "share of samples with a near copy among them",
    value: (s) => s.duplicates,
    text: (v) => percent(v),
    top: 1,
  },
  {
    name: "Diversity",
    says: "mean distance between samples, relative to the prior set",
    value: (s) => s.diversity,
    text: (v) => fixed(v, 2),
  },
  {
    name: "Flat edges",
    says: "share of the edges' length under 2°; dashed: the prior set's",
    value: (s) => s.flat_share,
    text: (v) => percent(v),
    ideal: (prior) => prior?.flat_share,
  },
  {
    name: "Creases",
    says: "share of the edges' length above 30°; dashed: the prior set's",
    value: (s) => s.crease_share,
    text: (v) => percent(v, 1),
    ideal: (prior) => prior?.crease_share,
  },
];

/** Variety of the samples: one small chart per measure, episodes on a shared axis. */
export function varietyFigure(stages: Stage[]): HTMLElement | null {
  const { prior, episodes, control, first } = stagesOf(stages);
  const shown = MEASURES.filter((m) => [...episodes, ...control].some((s) => known(m.value(s))));
  if (!shown.length) return null;
  const last = Math.max(...[...episodes, ...control].map((s) => s.episode));
  const domain = Array.from({ length: last + 1 }, (_, i) => i);
  const points = (list: Stage[], m: Measure) =>
    domain.map((i) => {
      const stage = list.find((s) => s.episode === i);
      const value = stage ? m.value(stage) : null;
      return { episode: i, value: known(value) ? value : NaN, label: stage?.label ?? "", text: m.text(value) };
    });
  const draw = (width: number) => {
    const columns = width < 420 ? 1 : width < 760 ? 2 : shown.length > 4 ? 3 : shown.length;
    const each = Math.floor((width - (columns - 1) * 20) / columns);
    return h(
      "div",
      { class: "multiples", style: `grid-template-columns: repeat(${columns}, 1fr)` },
      ...shown.map((m) => {
        const line = (list: Stage[], colour: string) => [
          Plot.lineY(points(list, m), { x: "episode", y: "value", stroke: colour, strokeWidth: 2 }),
          Plot.dot(points(list, m), {
            x: "episode",
            y: "value",
            fill: colour,
            r: 3,
            title: (d: { label: string; text: string }) => `${d.label}: ${d.text}`,
          }),
        ];
        const ideal = m.ideal?.(prior);
        const chart = Plot.plot({
          width: each,
          height: 150,
          marginLeft: 46,
          marginRight: 10,
          marginBottom: 30,
          marginTop: 8,
          ariaLabel: `${m.name} per episode`,
          style: { fontSize: "11px" },
          x: { type: "point", domain, label: null, padding: 0.3 },
          y: {
            label: null,
            grid: true,
            zero: true,
            ticks: 4,
            tickFormat: (t: number) => m.text(t),
            ...(m.top ? { domain: [0, m.top] } : {}),
          },
          marks: [
            known(ideal)
              ? Plot.ruleY([ideal], { stroke: COLOURS.ink, strokeOpacity: 0.4, strokeDasharray: "3 4" })
              : null,
            ...(control.length ? line(first ? [first, ...control] : control, COLOURS.control) : []),
            ...line(episodes, COLOURS.run),
          ],
        });
        return h("div", {}, h("h3", {}, m.name), h("p", { class: "note" }, m.says), chart);
      }),
    );
  };
  return figure({
    title: "Variety and likeness to the prior set",
    caption: "Horizontal axes: episode. What the loop wins in low graspability it pays for in variety.",
    legend: key([
      ["run", COLOURS.run, "line"],
      ...(control.length ? [["control", COLOURS.control, "line"] as [string, string, "line"]] : []),
    ]),
    draw,
    numbers: {
      header: ["stage", ...shown.map((m) => m.name.toLowerCase())],
      rows: [...episodes, ...control].map((s) => [s.label, ...shown.map((m) => m.text(m.value(s)))]),
    },
    className: "wide",
  });
}

const REASON_COLOURS = ["#d55e00", "#0072b2", "#cc79a7", "#e69f00", "#56b4e9", "#009e73", "#8c6d31", "#7f7f7f"]; // Okabe and Ito, then browns and greys

/** Samples that became no object, by reason and stage. */
export function rejectionFigure(stages: Stage[]): HTMLElement | null {
  const counted = stages.filter((s) => s.statuses.length);
  if (!counted.length) return null;
  const reasons = [...new Set(counted.flatMap((s) => s.statuses.map(([status]) => status)))].filter(
    (status) => status !== "ok",
  );
  const rows = counted.map((s) => [
    s.label,
    count(s.samples),
    percent(rejectedShare(s), 1),
    ...reasons.map((reason) => count(s.statuses.find(([status]) => status === reason)?.[1] ?? 0)),
  ]);
  const numbers = { header: ["stage", "samples", "rejected", ...reasons], rows };
  if (!reasons.length) {
    return figure({
      title: "Rejection by reason",
      draw: () => h("p", {}, "No sample was rejected in any stage."),
      numbers,
    });
  }
  const bars = counted.flatMap((s) =>
    s.statuses
      .filter(([status]) => status !== "ok")
      .map(([reason, n]) => {
        const total = s.samples || s.statuses.reduce((sum, [, k]) => sum + k, 0);
        return { stage: s.label, reason, share: n / total, title: `${s.label}: ${n} of ${total} ${reason}` };
      }),
  );
  const digits = Math.max(...counted.map((s) => rejectedShare(s) ?? 0)) < 0.05 ? 1 : 0;
  const colour = (reason: string) => REASON_COLOURS[reasons.indexOf(reason) % REASON_COLOURS.length];
  return figure({
    title: "Rejection by reason",
    caption: "Samples that are no single closed solid, or could not be scored.",
    legend: key(reasons.map((reason) => [reason, colour(reason)])),
    draw: (width) =>
      Plot.plot({
        width,
        height: counted.length * 26 + 50,
        marginLeft: 124,
        marginRight: 20,
        marginBottom: 40,
        marginTop: 6,
        ariaLabel: "Rejected samples by reason and stage",
        style: { fontSize: "12px" },
        x: {
          label: "share of samples",
          labelAnchor: "center",
          labelArrow: "none",
          tickFormat: (t: number) => percent(t, digits),
          grid: true,
          ticks: 5,
        },
        y: { domain: counted.map((s) => s.label), label: null, padding: 0.3, tickFormat: (t: string) => short(t, 18) },
        marks: [
          Plot.barX(bars, {
            y: "stage",
            x: "share",
            fill: (d: { reason: string }) => colour(d.reason),
            title: "title",
          }),
          Plot.ruleX([0], { stroke: COLOURS.ink, strokeOpacity: 0.5 }),
        ],
      }),
    numbers,
  });
}
