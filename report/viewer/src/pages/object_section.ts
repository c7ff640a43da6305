import { radios, slider, tick } from "../controls";
import { type Axis, distanceTree, outline, PLANE_AXES, signedDistances } from "../data/section";
import { niceStep, sectionChart, STEPS } from "../charts/section";
import { DISTANCE_GRADIENT } from "../colours";
import { h } from "../dom";
import { fixed } from "../format";
import type { Bounds } from "../three/object_camera";
import type { ObjectPanel } from "../three/object_panel";

const COARSE = 48,
  FINE = 112; // samples a side: while the slider moves, and when it rests
const REST_MS = 140;
const AXES = ["x", "y", "z"];
const MARGIN = 0.14; // of the largest extent, around the objects

/** Low and high corner of a square window of the plane that holds all objects. */
function square(bounds: Bounds, axis: Axis): [[number, number], [number, number]] {
  const centre = PLANE_AXES[axis].map((k) => (bounds.min[k] + bounds.max[k]) / 2);
  const side = Math.max(...PLANE_AXES[axis].map((k) => bounds.max[k] - bounds.min[k]));
  const half = side / 2 + MARGIN * bounds.extent;
  return [
    [centre[0] - half, centre[1] - half],
    [centre[0] + half, centre[1] + half],
  ];
}

/** Cross-sections of the signed distance (Fig. 2), one beside the other for a pair. `dispose` stops what is pending. */
export function sectionFigure(
  panels: ObjectPanel[],
  bounds: Bounds,
  redraw: () => void,
): { element: HTMLElement; dispose: () => void } {
  let axis: Axis = 1,
    share = 0.5,
    inView = false,
    timer = 0;
  const trees = panels.map((panel) => distanceTree(panel.mesh));
  const charts = panels.map(() => h("div", { class: "section-chart" }));
  const at = (where = share) => bounds.min[axis] + where * (bounds.max[axis] - bounds.min[axis]);
  const step = niceStep((bounds.extent * 1000 * panels[0].shape.metres_per_unit) / 22);
  const millimetres = (panel: ObjectPanel) => 1000 * panel.shape.metres_per_unit;

  const draw = (size: number) => {
    const [low, high] = square(bounds, axis);
    const [u, v] = PLANE_AXES[axis];
    panels.forEach((panel, i) => {
      const pieces = outline(panel.mesh, axis, at());
      const grid = signedDistances(trees[i], pieces, axis, at(), low, high, size);
      const label = `${panels.length > 1 ? `${panel.shape.label ?? "after"}, ` : ""}${AXES[axis]} = ${position()}`;
      charts[i].replaceChildren(
        h("p", { class: "note" }, label),
        sectionChart(grid, pieces, {
          mm: millimetres(panel),
          u: AXES[u],
          v: AXES[v],
          label,
          width: charts[i].clientWidth || 340,
          step,
        }),
      );
      const centre = [0, 1, 2].map((k) => (bounds.min[k] + bounds.max[k]) / 2) as [number, number, number];
      panel.showCut(inView ? { axis, at: at(), pieces, centre } : null);
    });
    redraw();
  };
  const update = (touched: boolean) => {
    if (touched && !inView) {
      inView = true;
      viewTick.querySelector("input")!.checked = true;
    }
    draw(COARSE);
    clearTimeout(timer);
    timer = window.setTimeout(() => draw(FINE), REST_MS);
  };
  const position = (where = share) => `${fixed(at(where) * millimetres(panels[0]), 1)} mm`;
  const positionSlider = slider(
    "Position",
    { min: 0, max: 100, step: 0.5, value: 50 },
    (value) => position(value / 100),
    (value) => {
      share = value / 100;
      update(true);
    },
  );
  const axisChoice = radios<"0" | "1" | "2">(
    "Cut perpendicular to",
    "1",
    [
      ["0", "x"],
      ["1", "y"],
      ["2", "z"],
    ],
    (value) => {
      axis = Number(value) as Axis;
      positionSlider.set(positionSlider.input.valueAsNumber);
      update(true);
    },
  );
  const viewTick = tick("show the cut in the 3D view", false, (on) => {
    inView = on;
    draw(FINE);
  });
  const end = Number((STEPS * step).toPrecision(3));
  const measured = panels.some((panel) => panel.grasps.length > 0);
  const scale = `millimetres ${measured ? "at the size at which grasps were measured" : "if a unit of the mesh is a metre"}`;
  const watcher = new ResizeObserver(() => update(false));
  const element = h(
    "section",
    { class: "figure section-figure" },
    h("h2", {}, "Cross-section of the signed distance"),
    h("div", { class: "control-row" }, axisChoice, positionSlider.element, viewTick),
    h("div", { class: "section-charts" }, ...charts),
    h(
      "div",
      { class: "legend" },
      h("span", {}, `−${end} mm, outside`),
      h("i", { style: `background:${DISTANCE_GRADIENT}` }),
      h("span", {}, `inside, ${end} mm`),
    ),
    h(
      "p",
      { class: "note" },
      `A contour every ${step} mm. Exact distance to the surface of the mesh, positive inside, ${scale}. The black line is the surface.`,
    ),
  );
  watcher.observe(element);
  return {
    element,
    dispose: () => {
      clearTimeout(timer);
      watcher.disconnect();
    },
  };
}
