import { graspability, isRejected, type ObjectRecord, type Report, type Shape } from "../data/report";
import { meanOf, ratio, stagesOf } from "../data/statistics";
import { h } from "../dom";
import { fixed, milli, MILLI_UNIT } from "../format";
import { objectLink } from "../router";
import { onSchemeChange } from "../three/scene";
import { NO_WEBGL } from "../three/surface";
import { TilePictures } from "../three/tiles";

interface Example {
  object: number;
  /** Index into the shapes that are drawn. */
  shape: number;
  text: string;
}

interface Row {
  label: string;
  says: string;
  examples: Example[];
}

const MOST = 10; // pictures in a row
const WIDTH = 96; // of a picture at least, pixels

// A run's gallery holds the least graspable objects too, which would flatter a stage.
const atRandom = (o: ObjectRecord) => o.random !== false;

/** What can be shown, in the order of the report: examples are picked neither for looks nor for scores. */
function usable(report: Report, group?: number): number[] {
  return report.objects
    .flatMap((o, i) =>
      o.mesh && !isRejected(o) && atRandom(o) && (group === undefined || o.group === group) ? [i] : [],
    )
    .slice(0, MOST);
}

/** Fig. 4: objects of every stage, with the stage's kappa. */
function stageRows(report: Report, shapes: Shape[]): Row[] {
  const stages = report.run?.stages ?? [];
  const { first, prior } = stagesOf(stages);
  const base = meanOf(first) ?? meanOf(prior);
  return report.groups
    .map((group, g) => {
      const kappa = ratio(meanOf(stages.find((s) => s.id === group.id)), base);
      const examples = usable(report, g).map((object) => ({
        object,
        shape: shapes.push(report.objects[object]) - 1,
        text: milli(graspability(report.objects[object])),
      }));
      return { label: group.label, says: kappa ? `κ ${fixed(kappa.value, 2)}` : "", examples };
    })
    .filter((row) => row.examples.length);
}

/** Originals above what they became. */
function pairRows(report: Report, shapes: Shape[]): Row[] {
  const objects = usable(report).filter((i) => report.objects[i].pair?.mesh);
  const row = (label: string, side: (o: ObjectRecord) => Shape): Row => ({
    label,
    says: "",
    examples: objects.map((object) => ({
      object,
      shape: shapes.push(side(report.objects[object])) - 1,
      text: milli(graspability(side(report.objects[object]))),
    })),
  });
  return objects.length ? [row("before", (o) => o.pair!), row("after", (o) => o)] : [];
}

/** A few objects on the overview, a row per stage; null when there are none. */
export function exampleFigure(
  report: Report,
): { element: HTMLElement; mounted: () => void; dispose: () => void } | null {
  const shapes: Shape[] = [];
  const rows = report.kind === "perturbed" ? pairRows(report, shapes) : stageRows(report, shapes);
  if (!rows.length) return null;
  const content = h("div", {});
  const host = h("div", { class: "examples-host" }, content);
  const pictures = new TilePictures(host, shapes);
  const tile = (row: Row, { object, shape, text }: Example) =>
    h(
      "a",
      {
        href: objectLink(object),
        title: report.objects[object].name,
        "aria-label": `${report.objects[object].name}, ${row.label}, graspability ${text} ${MILLI_UNIT}`,
      },
      h("span", { class: "picture", "data-object": shape }),
      text,
    );
  let columns = 0;
  const lay = () => {
    const fit = Math.min(
      MOST,
      Math.max(3, Math.floor((host.clientWidth - (host.clientWidth > 560 ? 118 : 0)) / WIDTH)),
    );
    if (fit === columns) return undefined;
    columns = fit;
    content.replaceChildren(
      ...rows.map((row) =>
        h(
          "div",
          { class: "example-row" },
          h("p", {}, h("b", {}, row.label), h("small", {}, row.says)),
          h(
            "div",
            { class: "example-tiles", style: `grid-template-columns: repeat(${columns}, minmax(0, 1fr))` },
            ...row.examples.slice(0, columns).map((e) => tile(row, e)),
          ),
        ),
      ),
    );
    pictures.watch([...content.querySelectorAll<HTMLElement>(".picture")]);
    return undefined;
  };
  const watcher = new ResizeObserver(lay);
  const stopScheme = onSchemeChange(() => pictures.restyle());
  const element = h(
    "section",
    { class: "figure wide" },
    h("h2", {}, report.kind === "perturbed" ? "Objects before and after" : "Objects"),
    pictures.available ? host : h("p", { class: "notice", role: "alert" }, NO_WEBGL),
    h(
      "p",
      { class: "note" },
      `${report.kind === "run" ? "Of every stage objects drawn at random" : "The first objects, not selected"}; below each its graspability, ${MILLI_UNIT}.`,
    ),
  );
  return {
    element,
    mounted: () => watcher.observe(host),
    dispose: () => {
      watcher.disconnect();
      stopScheme();
      pictures.dispose();
    },
  };
}
