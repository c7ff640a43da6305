import * as Plot from "@observablehq/plot";
import { distanceColour } from "../colours";
import { type DistanceGrid, loops, type Outline } from "../data/section";

export interface SectionLook {
  /** Millimetres per mesh unit. */
  mm: number;
  /** Names of the plane's axes. */
  u: string;
  v: string;
  label: string;
  width: number;
  /** Between two contours, millimetres. */
  step: number;
}

/** Contours on either side of the surface; the colours end there. */
export const STEPS = 9;

/** Filled contours of a signed-distance section, as in Fig. 2. */
export function sectionChart(
  grid: DistanceGrid,
  pieces: Outline,
  { mm, u, v, label, width, step }: SectionLook,
): Element {
  const values = grid.values.map((value) => value * mm);
  const span = step * STEPS;
  const thresholds = Array.from({ length: 2 * STEPS + 1 }, (_, i) => (i - STEPS) * step);
  const surface = loops(pieces).flatMap((loop, n) => loop.map(([x, y]) => ({ x: x * mm, y: y * mm, n })));
  const side = Math.min(width, 470);
  return Plot.plot({
    width: side,
    height: side,
    marginLeft: 44,
    marginBottom: 42,
    marginTop: 10,
    marginRight: 10,
    ariaLabel: `Signed distance in the plane ${label}`,
    style: { fontSize: "12px" },
    x: {
      label: `${u}, mm`,
      labelAnchor: "center",
      labelArrow: "none",
      domain: [grid.low[0] * mm, grid.high[0] * mm],
      nice: false,
      ticks: 5,
    },
    y: {
      label: `${v}, mm`,
      labelAnchor: "center",
      labelArrow: "none",
      domain: [grid.low[1] * mm, grid.high[1] * mm],
      nice: false,
      ticks: 5,
    },
    color: {
      type: "linear",
      domain: [-span, span],
      range: [0, 1],
      clamp: true,
      interpolate: () => (t: number) => distanceColour(2 * t - 1),
    } as Plot.ScaleOptions,
    marks: [
      Plot.frame({ fill: distanceColour(-1), stroke: null }), // beyond the last contour
      Plot.contour(values, {
        width: grid.size,
        height: grid.size,
        x1: grid.low[0] * mm,
        y1: grid.low[1] * mm,
        x2: grid.high[0] * mm,
        y2: grid.high[1] * mm,
        thresholds,
        fill: Plot.identity,
        stroke: "#00000030",
        strokeWidth: 0.5,
      } as Plot.ContourOptions),
      Plot.line(surface, { x: "x", y: "y", z: "n", stroke: "#111", strokeWidth: 1.8, strokeLinejoin: "round" }),
    ],
  });
}

/** The largest of 1, 2, 5 times a power of ten that does not exceed the value. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return Number((power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1)).toPrecision(1));
}
