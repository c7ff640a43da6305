import { details, h, table } from "../dom";
import { afterFirstObjects } from "../early";

export interface Numbers {
  header: string[];
  rows: string[][];
}

export interface FigureOptions {
  title: string;
  caption?: string;
  legend?: Node;
  /** The chart for a width in CSS pixels. */
  draw: (width: number) => Node;
  /** The numbers behind it, for readers who cannot see it or want to copy them. */
  numbers?: Numbers;
  className?: string;
}

/** A chart that follows the width of the page, with its caption and its numbers. */
export function figure({ title, caption, legend, draw, numbers, className }: FigureOptions): HTMLElement {
  const holder = h("div", { class: "chart" });
  let drawn = 0;
  new ResizeObserver(() => {
    const width = Math.floor(holder.clientWidth);
    if (width === drawn || width === 0) return;
    drawn = width;
    afterFirstObjects(() => holder.replaceChildren(draw(width)));
  }).observe(holder);
  return h(
    "section",
    { class: `figure ${className ?? ""}` },
    h("h2", {}, title),
    legend,
    holder,
    caption ? h("p", { class: "note" }, caption) : null,
    numbers?.rows.length ? details("Numbers", table(numbers.header, numbers.rows, title)) : null,
  );
}

/** Colours of the style sheet: charts change with the colour scheme by themselves. */
export const COLOURS = {
  run: "var(--run)",
  control: "var(--control)",
  prior: "var(--prior)",
  bad: "var(--bad)",
  ink: "currentColor",
  grid: "var(--line)",
};

/** A key of coloured words, because a chart's own legend does not wrap on a narrow screen. */
export function key(items: [string, string, ("line" | "area" | "outline")?][]): HTMLElement {
  return h(
    "p",
    { class: "key" },
    ...items.map(([label, colour, shape]) =>
      h("span", {}, h("i", { class: shape ?? "area", style: `--c:${colour}` }), label),
    ),
  );
}
