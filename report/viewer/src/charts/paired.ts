import * as Plot from "@observablehq/plot";
import { graspability, isRejected, type ObjectRecord } from "../data/report";
import { known, milli, MILLI_UNIT } from "../format";
import { objectLink } from "../router";
import { COLOURS, figure, key } from "./figure";
import { quantile, stackedHistograms } from "./histograms";

export interface PairPoint {
  index: number;
  name: string;
  before: number;
  after: number;
}

/** Objects with a result, scored before and after the change. */
export function pairPoints(objects: ObjectRecord[]): PairPoint[] {
  return objects.flatMap((object, index) => {
    const before = graspability(object.pair),
      after = graspability(object);
    return !isRejected(object) && known(before) && known(after) ? [{ index, name: object.name, before, after }] : [];
  });
}

const mean = (x: number[]) => (x.length ? x.reduce((a, b) => a + b, 0) / x.length : null);

/** Histograms before and after, in units of the mean before. */
export function pairedHistograms(pairs: PairPoint[]): HTMLElement | null {
  const base = mean(pairs.map((p) => p.before));
  if (!base) return null;
  const rows = (["before", "after"] as const).map((side) => {
    const values = pairs.map((p) => p[side] / base);
    return {
      label: side,
      values,
      mean: mean(values),
      colour: side === "before" ? COLOURS.prior : COLOURS.run,
      other: [],
    };
  });
  return figure({
    title: "Distribution of graspability",
    caption: "Share of objects per bin, in units of the mean before; the line and the number are the means.",
    draw: (width) => stackedHistograms(rows, "graspability / mean before", width),
    numbers: {
      header: ["", "objects", "10th percentile", "median", "90th percentile"],
      rows: rows.map((row) => [
        row.label,
        String(row.values.length),
        ...[0.1, 0.5, 0.9].map((q) => quantile(row.values, q)),
      ]),
    },
  });
}

/** Every object as a dot: below the diagonal it became harder to grasp. A dot leads to its object. */
export function pairedScatter(pairs: PairPoint[]): HTMLElement | null {
  if (!pairs.length) return null;
  const top = 1.05 * Math.max(...pairs.flatMap((p) => [p.before, p.after])) * 1000;
  return figure({
    title: "Each object before and after",
    legend: key([
      ["harder to grasp", COLOURS.run],
      ["easier", COLOURS.bad],
    ]),
    draw: (width) => {
      const side = Math.min(width, 460);
      return Plot.plot({
        width: side,
        height: side,
        marginLeft: 48,
        marginBottom: 44,
        marginTop: 24,
        marginRight: 14,
        ariaLabel: "Graspability after against before",
        style: { fontSize: "12px" },
        x: {
          domain: [0, top],
          label: `before, ${MILLI_UNIT}`,
          labelAnchor: "center",
          labelArrow: "none",
          grid: true,
          ticks: 5,
        },
        y: { domain: [0, top], label: `after, ${MILLI_UNIT}`, labelArrow: "none", grid: true, ticks: 5 },
        marks: [
          Plot.link([0], {
            x1: 0,
            y1: 0,
            x2: top,
            y2: top,
            stroke: COLOURS.ink,
            strokeOpacity: 0.45,
            strokeDasharray: "3 4",
          }),
          Plot.dot(pairs, {
            x: (p: PairPoint) => 1000 * p.before,
            y: (p: PairPoint) => 1000 * p.after,
            r: 4,
            fill: (p: PairPoint) => (p.after <= p.before ? COLOURS.run : COLOURS.bad),
            fillOpacity: 0.7,
            title: (p: PairPoint) => `${p.name}: ${milli(p.before)} to ${milli(p.after)}`,
            href: (p: PairPoint) => objectLink(p.index),
            target: "_self",
          }),
        ],
      });
    },
  });
}
