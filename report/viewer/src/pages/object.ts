import { HEAT_GRADIENT } from "../colours";
import { tick } from "../controls";
import { type Grasp, graspsOf } from "../data/grasps";
import { type Mesh, meshOf } from "../data/mesh";
import { graspability, type ObjectRecord, type Report, type Shape } from "../data/report";
import { h } from "../dom";
import { fixed, known, milli, MILLI_UNIT } from "../format";
import type { Page } from "../router";
import { type Bounds, setUpCamera } from "../three/object_camera";
import { ObjectPanel } from "../three/object_panel";
import { onSchemeChange } from "../three/scene";
import { NO_WEBGL, Surface } from "../three/surface";
import { graspControls } from "./object_grasps";
import { objectButtons, objectHead } from "./object_head";
import { metricTable, numbersTable, printTable } from "./object_numbers";
import { sectionFigure } from "./object_section";
import { trialsBox } from "./object_trials";

interface Side {
  shape: Shape;
  mesh: Mesh;
  grasps: Grasp[];
}

function sidesOf(object: ObjectRecord): Side[] {
  const shapes: Shape[] = object.pair
    ? [
        { label: "before", ...object.pair },
        { ...object, label: object.label ?? "after" },
      ]
    : [object];
  return shapes.flatMap((shape) => {
    const mesh = meshOf(shape);
    return mesh ? [{ shape, mesh, grasps: graspsOf(shape.grasps) }] : [];
  });
}

function boundsOf(sides: Side[]): Bounds {
  const pick = (k: number, f: (...x: number[]) => number, key: "min" | "max") => f(...sides.map((s) => s.mesh[key][k]));
  const min = [0, 1, 2].map((k) => pick(k, Math.min, "min")) as [number, number, number];
  const max = [0, 1, 2].map((k) => pick(k, Math.max, "max")) as [number, number, number];
  return { min, max, extent: Math.max(...[0, 1, 2].map((k) => max[k] - min[k])) };
}

function heatControls(object: ObjectRecord, panel: ObjectPanel, redraw: () => void): HTMLElement | null {
  const pair = object.pair;
  if (!pair?.displacement || !known(pair.max_displacement)) return null;
  const part = pair.displacement;
  const legend = h(
    "div",
    { class: "legend", hidden: true },
    h("span", {}, "0"),
    h("i", { style: `background:${HEAT_GRADIENT}` }),
    h("span", {}, `${fixed(pair.max_displacement * object.metres_per_unit * 1000, 2)} mm`),
  );
  return h(
    "section",
    { class: "panel-box" },
    h("h2", {}, "Displacement"),
    tick("colour the changed object by its distance to the original", false, (on) => {
      legend.hidden = !on;
      panel.showHeat(on ? part : null);
      redraw();
    }),
    legend,
  );
}

interface View {
  host: HTMLElement;
  /** null without WebGL. */
  surface: Surface | null;
  panels: ObjectPanel[];
  bounds: Bounds;
  /** Quality of the best grasp of all sides: what is drawn green. */
  best: number;
  redraw: () => void;
  dispose: () => void;
}

/** The 3D view of all sides under one camera. */
function buildView(object: ObjectRecord, sides: Side[], friction: number): View {
  const bounds = boundsOf(sides);
  const pictures = sides.map(() => h("div", { class: "panel-picture" }));
  const caption = (shape: Shape) =>
    h(
      "figcaption",
      {},
      object.pair ? h("b", {}, shape.label ?? "") : null,
      h("span", {}, `graspability ${milli(graspability(shape))}\u00a0${MILLI_UNIT}`),
    );
  const label = `3D view of ${object.name}: arrow keys turn, plus and minus zoom`;
  const host = h(
    "div",
    { class: "panels", tabindex: 0, role: "application", "aria-label": label },
    ...sides.map(({ shape }, i) => h("figure", {}, pictures[i], caption(shape))),
  );
  const panels: ObjectPanel[] = [];
  const surface = Surface.over(host, () => panels);
  const redraw = () => surface?.invalidate();
  const { camera, controls } = setUpCamera(host, bounds, redraw);
  const best = Math.max(0, ...sides.flatMap((side) => side.grasps.map((grasp) => grasp.quality)));
  const scale = { extent: bounds.extent, best, friction };
  sides.forEach(({ shape, mesh, grasps }, i) =>
    panels.push(new ObjectPanel(pictures[i], camera, shape, mesh, grasps, scale)),
  );
  const stopScheme = onSchemeChange(() => {
    panels.forEach((panel) => panel.restyle());
    redraw();
  });
  const dispose = () => {
    stopScheme();
    controls.dispose();
    panels.forEach((panel) => panel.dispose());
    surface?.dispose();
  };
  return { host, surface, panels, bounds, best, redraw, dispose };
}

/** A click on an axis, not the end of a drag, chooses its grasp. */
function listenToClicks({ host, panels }: View, choose: (rank: number) => void): void {
  let pressed: { x: number; y: number } | null = null;
  host.addEventListener("pointerdown", (event) => {
    pressed = { x: event.clientX, y: event.clientY };
  });
  host.addEventListener("click", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4) return;
    // Not by the event's target: the camera's controls have captured the pointer for the whole host.
    const panel = panels.find((p) => p.covers(event.clientX, event.clientY));
    const rank = panel?.pick(event.clientX, event.clientY) ?? null;
    if (rank !== null) choose(rank);
  });
}

/** The view with what belongs right below it. */
function viewColumn(object: ObjectRecord, { host, surface, panels, redraw }: View): HTMLElement {
  if (!surface) return h("div", { class: "object-main" }, objectButtons(object, null));
  const hint = "Drag to turn; click first, then the wheel zooms; click an axis to choose its grasp.";
  const translucent = tick("see through the object", false, (on) => {
    panels.forEach((panel) => panel.showTranslucent(on));
    redraw();
  });
  const under = h("div", { class: "under" }, objectButtons(object, surface), translucent);
  return h("div", { class: "object-main" }, host, h("p", { class: "note" }, hint), under);
}

function noGrasps(): HTMLElement {
  const text = h("p", { class: "note" }, "No grasps of this object are stored.");
  return h("section", { class: "panel-box" }, h("h2", {}, "Grasps"), text);
}

export function objectPage(report: Report, index: number): Page {
  const object = report.objects[index];
  const sides = sidesOf(object);
  const head = objectHead(report, object, index);
  const tables = [metricTable(object), trialsBox(object, index), numbersTable(object), printTable(object)];
  if (!sides.length) {
    const why = object.mesh ? "The mesh of this object cannot be decoded." : "This object has no mesh.";
    const notice = h("p", { class: "notice" }, why);
    const element = h("main", { class: "object" }, head, notice, h("div", { class: "tables" }, ...tables));
    return { title: object.name, element };
  }
  const view = buildView(object, sides, report.metric?.friction ?? 0.5);
  const { panels, redraw } = view;
  const grasps = graspControls(panels, view.best, report.metric, report.gripper, redraw);
  if (grasps) listenToClicks(view, grasps.choose);
  const section = sectionFigure(panels, view.bounds, redraw);
  const heat = sides.length > 1 ? heatControls(object, panels[1], redraw) : null;
  const side = h("div", { class: "side" }, grasps?.element ?? noGrasps(), heat, ...tables);
  const element = h(
    "main",
    { class: "object" },
    head,
    view.surface ? null : h("p", { class: "notice", role: "alert" }, NO_WEBGL),
    h("div", { class: "object-grid" }, viewColumn(object, view), side, section.element),
  );
  const dispose = () => {
    section.dispose();
    view.dispose();
  };
  return { title: object.name, element, mounted: redraw, dispose };
}
