import * as Plot from "@observablehq/plot";
import type { DistanceGrid, Outline } from "../data/section";

export interface SectionLook {
  /** Millimetres per mesh unit. */
  mm: number;
  /** Names of the plane's axes. */
  u: string;
  v: string;
  label: string;
  width: number;
  /** Largest extent of the object, mesh units: the distances that the colours span. */
  extent: number;
}

/** Filled contours of a signed-distance section, as in Fig. 2. */
export function sectionChart(grid: DistanceGrid, pieces: Outline, look: SectionLook): Element {
  const { mm } = look;
  const values = grid.values.map((value) => value * mm);
  const step = niceStep((look.extent * mm) / 22);
  const span = step * 9;
  const thresholds = Array.from({ length: 19 }, (_, i) => (i - 9) * step);
  const segments = Array.from({ length: pieces.length / 4 }, (_, i) => Array.from(pieces.subarray(4 * i, 4 * i + 4), (x) => x * mm));
  const width = Math.min(look.width, 460);
  const chart = Plot.plot({
    width, height: width, marginLeft: 44, marginBottom: 38, marginTop: 24, marginRight: 12,
    ariaLabel: `Signed distance in the plane ${look.label}`,
    x: { label: `${look.u}, mm`, domain: [grid.low[0] * mm, grid.high[0] * mm], nice: false, ticks: 5 },
    y: { label: `${look.v}, mm`, domain: [grid.low[1] * mm, grid.high[1] * mm], nice: false, ticks: 5 },
    color: { type: "diverging", scheme: "PuOr", pivot: 0, symmetric: true, domain: [-span, span], clamp: true },
    marks: [
      Plot.contour(values, {
        width: grid.size, height: grid.size,
        x1: grid.low[0] * mm, y1: grid.low[1] * mm, x2: grid.high[0] * mm, y2: grid.high[1] * mm,
        thresholds, fill: Plot.identity, stroke: "#00000038", strokeWidth: 0.5,
      } as Plot.ContourOptions),
      Plot.link(segments, { x1: "0", y1: "1", x2: "2", y2: "3", stroke: "#111", strokeWidth: 1.8, strokeLinecap: "round" }),
      Plot.frame({ stroke: "currentColor", strokeOpacity: 0.25 }),
    ],
  });
  const figure = document.createElement("figure");
  const caption = document.createElement("figcaption");
  caption.textContent = look.label;
  const legend = Plot.legend({
    color: { type: "diverging", scheme: "PuOr", pivot: 0, symmetric: true, domain: [-span, span] }, label: "signed distance, mm (inside > 0)", width: Math.min(260, width), ticks: 5,
  });
  figure.append(caption, chart, legend);
  return figure;
}

/** The largest of 1, 2, 5 times a power of ten that does not exceed the value. */
function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}
