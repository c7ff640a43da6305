import * as Plot from "@observablehq/plot";
import type { Losses } from "../data/report";
import { details, h } from "../dom";
import { fixed, known } from "../format";
import { COLOURS, figure, key } from "./figure";

interface Curve {
  column: string;
  label: string;
  colour: string;
}

const LOSSES: Curve[] = [
  { column: "loss_discriminator", label: "discriminator", colour: "var(--run)" },
  { column: "loss_generator", label: "generator", colour: "var(--control)" },
];
const GRADIENTS: Curve[] = [
  { column: "gradient_discriminator", label: "discriminator", colour: "var(--run)" },
  { column: "gradient_generator", label: "generator", colour: "var(--control)" },
];
const RATES: Curve[] = [
  { column: "rate_discriminator", label: "discriminator", colour: "var(--run)" },
  { column: "rate_generator", label: "generator", colour: "var(--control)" },
];
const SIGMA: Curve[] = [{ column: "largest_sigma", label: "largest singular value", colour: "var(--run)" }];

/** Curves of all episodes one after the other: a line breaks where an episode begins or a value is missing. */
function points(losses: Losses[], curve: Curve) {
  const out: { update: number; value: number }[] = [];
  const starts: { update: number; episode: number }[] = [];
  let offset = 0;
  for (const { episode, columns } of losses) {
    const steps = columns.step ?? [],
      values = columns[curve.column] ?? [];
    const first = steps.find(known) ?? 0;
    // Updates are counted anew in every episode, or on over all of them: both become one axis.
    const shift = first < offset ? offset : 0;
    if (steps.length) starts.push({ update: first + shift, episode });
    steps.forEach((step, i) =>
      out.push({ update: (step ?? NaN) + shift, value: known(values[i]) ? (values[i] as number) : NaN }),
    );
    out.push({ update: NaN, value: NaN });
    offset = (steps.filter(known).pop() ?? 0) + shift;
  }
  return { out, starts };
}

function lossChart(
  losses: Losses[],
  curves: Curve[],
  log: boolean,
  label: string,
  width: number,
  height: number,
): Element {
  const { starts } = points(losses, curves[0]);
  const positive = (v: number) => (log && v <= 0 ? NaN : v);
  return Plot.plot({
    width,
    height,
    marginLeft: 52,
    marginRight: 14,
    marginBottom: 40,
    marginTop: 24,
    ariaLabel: label,
    style: { fontSize: "12px" },
    x: { label: "update", labelAnchor: "center", labelArrow: "none" },
    y: {
      label,
      type: log ? "log" : "linear",
      grid: true,
      ticks: 5,
      labelArrow: "none",
      ...(log ? { tickFormat: "~g" } : {}),
    },
    marks: [
      Plot.ruleX(starts, { x: "update", stroke: COLOURS.ink, strokeOpacity: 0.3, strokeDasharray: "2 3" }),
      starts.length > 1
        ? Plot.text(starts, {
            x: "update",
            text: (d: { episode: number }) => `ep. ${d.episode}`,
            frameAnchor: "top",
            textAnchor: "start",
            dx: 4,
            dy: -12,
            fillOpacity: 0.7,
          })
        : null,
      ...curves.map((curve) =>
        Plot.lineY(points(losses, curve).out, {
          x: "update",
          y: (d: { value: number }) => positive(d.value),
          stroke: curve.colour,
          strokeWidth: 1.4,
        }),
      ),
    ],
  });
}

function has(losses: Losses[], curves: Curve[]): boolean {
  return curves.some((curve) => losses.some((l) => (l.columns[curve.column] ?? []).some(known)));
}

function summary(losses: Losses[]): string[][] {
  return losses.map(({ episode, columns }) => {
    const steps = (columns.step ?? []).filter(known);
    const tail = (name: string) => {
      const values = (columns[name] ?? []).filter(known).slice(-10);
      return values.length ? fixed(values.reduce((a, b) => a + b, 0) / values.length, 4) : "–";
    };
    return [
      `episode ${episode}`,
      String(steps[steps.length - 1] ?? "–"),
      tail("loss_discriminator"),
      tail("loss_generator"),
      tail("gradient_discriminator"),
      tail("gradient_generator"),
      tail("largest_sigma"),
    ];
  });
}

/** Losses, with gradient norms, rates, singular values and the control's losses folded away. */
export function lossFigure(all: Losses[], control = false): HTMLElement | null {
  const losses = all.filter((l) => l.control === control).sort((a, b) => a.episode - b.episode);
  if (!has(losses, LOSSES)) return null;
  const element = figure({
    title: control ? "Losses of the control" : "Losses",
    legend: key([
      ["discriminator", "var(--run)", "line"],
      ["generator", "var(--control)", "line"],
    ]),
    draw: (width) => lossChart(losses, LOSSES, false, "loss", width, 260),
    numbers: {
      header: [
        "last ten records",
        "last update",
        "discriminator",
        "generator",
        "gradient, d.",
        "gradient, g.",
        "largest σ",
      ],
      rows: summary(losses),
    },
  });
  const more: [string, Curve[], string][] = [
    ["Gradient norms", GRADIENTS, "2-norm over all parameters"],
    ["Learning rates", RATES, "learning rate"],
    ["Singular values", SIGMA, "largest σ of a discriminator's weight"],
  ];
  const folded = more.filter(([, curves]) => has(losses, curves));
  if (folded.length) {
    element.append(
      details(
        "Gradient norms, rates, singular values",
        ...folded.map(([title, curves, label]) => {
          const inner = figure({ title, draw: (width) => lossChart(losses, curves, true, label, width, 210) });
          return h("div", {}, inner);
        }),
      ),
    );
  }
  const twin = control ? null : lossFigure(all, true);
  if (twin) element.append(details("Losses of the control", twin));
  return element;
}
