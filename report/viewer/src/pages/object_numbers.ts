import type { ObjectRecord, Score } from "../data/report";
import { h } from "../dom";
import { count, fixed, known, milli, MILLI_UNIT, NONE, percent } from "../format";

/** Rows of a label and its numbers, in a column each where there is a header. */
export function rowsOf(rows: [string, ...string[]][], header: string[] | null): HTMLElement {
  return h(
    "table",
    { class: header ? "numbers pair" : "numbers" },
    header ? h("thead", {}, h("tr", {}, ...header.map((text) => h("th", { scope: "col" }, text)))) : null,
    h(
      "tbody",
      {},
      ...rows.map(([label, ...cells]) =>
        h("tr", {}, h("th", { scope: "row" }, label), ...cells.map((cell) => h("td", {}, cell))),
      ),
    ),
  );
}

function interval(score: Score | null): string {
  return known(score?.ci_low) && known(score?.ci_high) ? `${milli(score!.ci_low)}–${milli(score!.ci_high)}` : NONE;
}

function change(before: Score | null | undefined, after: Score | null): string {
  const a = before?.graspability,
    b = after?.graspability;
  return known(a) && known(b) && a > 0 ? percent(b / a - 1, 1) : NONE;
}

/** The metric of the object, and of its original where there is one. */
export function metricTable(object: ObjectRecord): HTMLElement {
  const sides = object.pair ? [object.pair.score, object.score] : [object.score];
  const row = (label: string, text: (score: Score | null) => string): [string, ...string[]] => [
    label,
    ...sides.map(text),
  ];
  const rows = [
    row(`graspability, ${MILLI_UNIT}`, (s) => milli(s?.graspability, 3)),
    row("95 % interval", interval),
    row(`mean quality, ${MILLI_UNIT}`, (s) => milli(s?.mean, 3)),
    row("grasps with quality > 0", (s) => percent(s?.fraction_nonzero)),
    row("grasps sampled", (s) => count(s?.num_grasps)),
  ];
  const header = object.pair ? ["", object.pair.label ?? "before", object.label ?? "after"] : null;
  return h(
    "section",
    { class: "panel-box" },
    h("h2", {}, "Metric"),
    object.pair
      ? h(
          "p",
          { class: "big-change" },
          h("b", {}, change(object.pair.score, object.score)),
          h("span", {}, " graspability"),
        )
      : null,
    rowsOf(rows, header),
  );
}

/** Similarity and whatever else the binary put beside the object; null when there is nothing. */
export function numbersTable(object: ObjectRecord): HTMLElement | null {
  if (!object.numbers?.length) return null;
  return h(
    "section",
    { class: "panel-box" },
    h("h2", {}, object.pair ? "Similarity" : "Numbers"),
    rowsOf(
      object.numbers.map(([label, text]) => [label, text]),
      null,
    ),
  );
}

export function printTable(object: ObjectRecord): HTMLElement | null {
  const print = object.print;
  if (!print) return null;
  const rows: [string, string][] = [
    ["size, mm", print.size_mm ? print.size_mm.map((x) => fixed(x, 1)).join(" × ") : NONE],
    ["thinnest wall, mm", fixed(print.wall_mm, 2)],
    ["watertight", print.watertight === true ? "yes" : print.watertight === false ? "no" : NONE],
    ["overhanging share of the surface", percent(print.overhang)],
    [
      "suggested pose",
      print.pose
        ? known(print.pose_probability)
          ? `stable, probability ${fixed(print.pose_probability, 2)}`
          : "stable"
        : NONE,
    ],
  ];
  return h(
    "section",
    { class: "panel-box" },
    h("h2", {}, "Print check"),
    h("p", { class: "note" }, "Lengths here are millimetres of the object as printed."),
    rowsOf(rows, null),
    print.notes?.length ? h("ul", { class: "warnings" }, ...print.notes.map((note) => h("li", {}, note))) : null,
  );
}
