import * as Plot from "@observablehq/plot";
import type { Losses, Num } from "../data/report";
import { details, h } from "../dom";
import { fixed, known } from "../format";
import { COLOURS, figure, key, type Numbers } from "./figure";

interface Curve {
  column: string;
  label: string;
  colour: string;
  /** Its heading in the table of numbers; without one it is not there. */
  heading?: string;
}

interface Group {
  title: string;
  label: string;
  log: boolean;
  curves: Curve[];
}

const curve = (column: string, label: string, colour: string, heading?: string) => ({ column, label, colour, heading });

/** The scalars of the GAN, which belong together in pairs. */
const OF_THE_GAN: Group[] = [
  {
    title: "Losses",
    label: "loss",
    log: false,
    curves: [
      curve("loss_discriminator", "discriminator", "var(--run)", "discriminator"),
      curve("loss_generator", "generator", "var(--control)", "generator"),
    ],
  },
  {
    title: "Gradient norms",
    label: "2-norm over all parameters",
    log: true,
    curves: [
      curve("gradient_discriminator", "discriminator", "var(--run)", "gradient, d."),
      curve("gradient_generator", "generator", "var(--control)", "gradient, g."),
    ],
  },
  {
    title: "Learning rates",
    label: "learning rate",
    log: true,
    curves: [
      curve("rate_discriminator", "discriminator", "var(--run)"),
      curve("rate_generator", "generator", "var(--control)"),
    ],
  },
  {
    title: "Singular values",
    label: "largest σ of a discriminator's weight",
    log: true,
    curves: [curve("largest_sigma", "largest singular value", "var(--run)", "largest σ")],
  },
];

/** The charts of whatever was recorded: those of the GAN, then one for every scalar of another name. */
function groupsOf(losses: Losses[]): Group[] {
  const grouped = new Set(["step", ...OF_THE_GAN.flatMap((group) => group.curves.map((c) => c.column))]);
  const names = new Set(losses.flatMap((l) => Object.keys(l.columns)));
  const others = [...names]
    .filter((name) => !grouped.has(name))
    .map((name) => ({
      title: name.charAt(0).toUpperCase() + name.slice(1).replaceAll("_", " "),
      label: name,
      log: false,
      curves: [curve(name, name, "var(--run)", name)],
    }));
  return [...OF_THE_GAN, ...others].filter((group) => has(losses, group.curves));
}

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

function lossChart(losses: Losses[], { label, log, curves }: Group, width: number, height: number): Element {
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

/** The mean of every scalar over the last ten records of an episode. */
function summary(losses: Losses[], curves: Curve[]): Numbers {
  const mean = (values: Num[]) => {
    const last = values.filter(known).slice(-10);
    return last.length ? fixed(last.reduce((a, b) => a + b, 0) / last.length, 4) : "–";
  };
  return {
    header: ["last ten records", "last update", ...curves.map((c) => c.heading ?? c.label)],
    rows: losses.map(({ episode, columns }) => [
      `episode ${episode}`,
      String((columns.step ?? []).filter(known).pop() ?? "–"),
      ...curves.map((c) => mean(columns[c.column] ?? [])),
    ]),
  };
}

/** The first group of scalars, a GAN's losses, with the others and the control's folded away. */
export function lossFigure(all: Losses[], control = false): HTMLElement | null {
  const losses = all.filter((l) => l.control === control).sort((a, b) => a.episode - b.episode);
  const groups = groupsOf(losses);
  if (!groups.length) return null;
  const [first, ...folded] = groups;
  const element = figure({
    title: control ? `${first.title} of the control` : first.title,
    legend: first.curves.length > 1 ? key(first.curves.map((c) => [c.label, c.colour, "line"])) : undefined,
    draw: (width) => lossChart(losses, first, width, 260),
    numbers: summary(
      losses,
      groups.flatMap((group) => group.curves).filter((c) => c.heading),
    ),
  });
  if (folded.length) {
    const titles = folded.map(({ title }, i) => (i ? title.charAt(0).toLowerCase() + title.slice(1) : title));
    element.append(
      details(
        titles.join(", "),
        ...folded.map((group) =>
          h("div", {}, figure({ title: group.title, draw: (width) => lossChart(losses, group, width, 210) })),
        ),
      ),
    );
  }
  const twin = control ? null : lossFigure(all, true);
  if (twin) element.append(details(`${first.title} of the control`, twin));
  return element;
}
