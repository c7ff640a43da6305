import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { HEAT_GRADIENT } from "../colours";
import { tick } from "../controls";
import { download, fileName } from "../data/download";
import { decodeGrasps, type Grasp } from "../data/grasps";
import { type Mesh, meshOf } from "../data/mesh";
import { graspability, isRejected, type ObjectRecord, remark, type Report, type Shape } from "../data/report";
import { stlPlan, writeStl } from "../data/stl";
import { h } from "../dom";
import { count, fixed, known, milli, MILLI_UNIT } from "../format";
import { objectLink, type Page } from "../router";
import { ObjectPanel } from "../three/object_panel";
import { onSchemeChange } from "../three/scene";
import { NO_WEBGL, Surface } from "../three/surface";
import { galleryOrder } from "./gallery_order";
import { graspControls } from "./object_grasps";
import { metricTable, numbersTable, printTable } from "./object_numbers";
import { sectionFigure } from "./object_section";

interface Side {
  shape: Shape;
  mesh: Mesh;
  grasps: Grasp[];
}

function sidesOf(object: ObjectRecord): Side[] {
  const shapes: Shape[] = object.pair ? [{ label: "before", ...object.pair }, { ...object, label: object.label ?? "after" }] : [object];
  return shapes.flatMap((shape) => {
    const mesh = meshOf(shape);
    return mesh ? [{ shape, mesh, grasps: decodeGrasps(shape.grasps) }] : [];
  });
}

function boundsOf(sides: Side[]) {
  const pick = (k: number, f: (...x: number[]) => number, key: "min" | "max") => f(...sides.map((s) => s.mesh[key][k]));
  const min = [0, 1, 2].map((k) => pick(k, Math.min, "min")) as [number, number, number];
  const max = [0, 1, 2].map((k) => pick(k, Math.max, "max")) as [number, number, number];
  return { min, max, extent: Math.max(...[0, 1, 2].map((k) => max[k] - min[k])) };
}

function head(report: Report, object: ObjectRecord, index: number): HTMLElement {
  const order = galleryOrder(report);
  const at = order.indexOf(index);
  const link = (text: string, to: number | undefined, rel: string) => (to === undefined
    ? h("span", { class: "step off" }, text)
    : h("a", { class: "step", href: objectLink(to), rel }, text));
  const facts = [report.groups[object.group]?.label ?? "", object.elite ? "elite" : "", remark(object), object.mesh ? `${count(object.mesh.triangles)} triangles${object.mesh.full_triangles ? `, decimated from ${count(object.mesh.full_triangles)}` : ""}` : ""];
  return h("div", { class: "page-head" },
    h("nav", { class: "steps", "aria-label": "Neighbouring objects" }, h("a", { href: "#/gallery" }, "All objects"),
      link("← previous", at > 0 ? order[at - 1] : undefined, "prev"), link("next →", at >= 0 ? order[at + 1] : order[0], "next")),
    h("h1", { tabindex: -1 }, object.name),
    h("p", { class: "lead" }, facts.filter(Boolean).join(" · ")),
    isRejected(object) ? h("p", { class: "notice bad" }, `Rejected: ${object.status}`) : null);
}

/** "Download STL" and "Save PNG"; STL works without WebGL. */
function buttons(object: ObjectRecord, surface: Surface | null): HTMLElement {
  const mesh = meshOf(object);
  const save = mesh ? h("button", { type: "button", onclick: () => {
    download(new Blob([writeStl(mesh, stlPlan(object, mesh))], { type: "model/stl" }), fileName(object.name, "stl"));
  } }, "Download STL") : null;
  const plan = mesh ? stlPlan(object, mesh) : null;
  const size = mesh && plan ? [0, 1, 2].map((k) => fixed((mesh.max[k] - mesh.min[k]) * plan.scale, 0)).join(" × ") : "";
  const says = plan ? `STL: millimetres, ${size} mm${plan.pose ? ", in the suggested print pose" : ""}${object.mesh?.full_triangles ? ", decimated as shown" : ""}.` : "";
  return h("div", { class: "buttons" }, save,
    surface ? h("button", { type: "button", onclick: async () => {
      const blob = await surface.png();
      if (blob) download(blob, fileName(object.name, "png"));
    } }, "Save PNG") : null, h("span", { class: "note" }, says));
}

function heatControls(object: ObjectRecord, panel: ObjectPanel, redraw: () => void): HTMLElement | null {
  const pair = object.pair;
  if (!pair?.displacement || !known(pair.max_displacement)) return null;
  const part = pair.displacement;
  const legend = h("div", { class: "legend", hidden: true }, h("span", {}, "0"), h("i", { style: `background:${HEAT_GRADIENT}` }),
    h("span", {}, `${fixed(pair.max_displacement * object.metres_per_unit * 1000, 2)} mm`));
  return h("section", { class: "panel-box" }, h("h2", {}, "Displacement"),
    tick("colour the changed object by its distance to the original", false, (on) => {
      legend.hidden = !on;
      panel.showHeat(on ? part : null);
      redraw();
    }), legend);
}

function setUpCamera(host: HTMLElement, bounds: ReturnType<typeof boundsOf>, redraw: () => void): { camera: PerspectiveCamera; controls: OrbitControls } {
  const camera = new PerspectiveCamera(27, 1, 0.01 * bounds.extent, 60 * bounds.extent);
  camera.up.set(0, 0, 1);
  const centre = new Vector3(...[0, 1, 2].map((k) => (bounds.min[k] + bounds.max[k]) / 2) as [number, number, number]);
  camera.position.copy(centre).add(new Vector3(1.5, -3.1, 1.65).multiplyScalar(bounds.extent * 0.84));
  const controls = new OrbitControls(camera, host);
  controls.target.copy(centre);
  controls.enableDamping = false;
  controls.minDistance = 0.4 * bounds.extent;
  controls.maxDistance = 20 * bounds.extent;
  // The wheel belongs to the page until the view has been clicked or tabbed to; fingers may still scroll up and down.
  controls.enableZoom = false;
  host.addEventListener("focusin", () => { controls.enableZoom = true; });
  host.addEventListener("focusout", () => { controls.enableZoom = false; });
  host.style.touchAction = "pan-y";
  host.addEventListener("keydown", (event) => {
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const zoom = event.key === "+" || event.key === "=" ? 0.9 : event.key === "-" ? 1 / 0.9 : 1;
    if (!turn && zoom === 1) return;
    event.preventDefault();
    const offset = camera.position.clone().sub(controls.target).multiplyScalar(zoom);
    if (turn) {
      offset.applyAxisAngle(camera.up, (turn[0] * Math.PI) / 18);
      const side = offset.clone().cross(camera.up).normalize();
      const tilted = offset.clone().applyAxisAngle(side, (-turn[1] * Math.PI) / 18);
      if (Math.abs(tilted.clone().normalize().z) < 0.98) offset.copy(tilted);
    }
    camera.position.copy(controls.target).add(offset);
    controls.update();
    redraw();
  });
  controls.addEventListener("change", redraw);
  controls.update();
  return { camera, controls };
}

export function objectPage(report: Report, index: number): Page {
  const object = report.objects[index];
  const sides = sidesOf(object);
  const tables = [metricTable(object), numbersTable(object), printTable(object)];
  if (!sides.length) {
    const why = object.mesh ? "The mesh of this object cannot be decoded." : "This object has no mesh.";
    return { title: object.name, element: h("main", { class: "object" }, head(report, object, index), h("p", { class: "notice" }, why), h("div", { class: "tables" }, ...tables)) };
  }
  const bounds = boundsOf(sides);
  const pictures = sides.map(() => h("div", { class: "panel-picture" }));
  const host = h("div", { class: "panels", tabindex: 0, role: "application", "aria-label": `3D view of ${object.name}: arrow keys turn, plus and minus zoom` },
    ...sides.map(({ shape }, i) => h("figure", {}, pictures[i], h("figcaption", {},
      sides.length > 1 || object.pair ? h("b", {}, shape.label ?? "") : null,
      h("span", {}, `graspability ${milli(graspability(shape))}\u00a0${MILLI_UNIT}`)))));
  const panels: ObjectPanel[] = [];
  const surface = Surface.over(host, () => panels);
  const redraw = () => surface?.invalidate();
  const { camera, controls } = setUpCamera(host, bounds, redraw);
  const best = Math.max(0, ...sides.flatMap((side) => side.grasps.map((grasp) => grasp.quality)));
  const friction = report.metric?.friction ?? 0.5;
  sides.forEach((side, i) => panels.push(new ObjectPanel(pictures[i], camera, side.shape, side.mesh, side.grasps, bounds.extent, { extent: bounds.extent, best, friction })));

  const grasps = graspControls(panels, best, report.metric, report.gripper, redraw);
  const changed = panels[panels.length - 1];
  let pressed: { x: number; y: number } | null = null;
  host.addEventListener("pointerdown", (event) => { pressed = { x: event.clientX, y: event.clientY }; });
  host.addEventListener("click", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4) return;
    // Not by the event's target: the camera's controls have captured the pointer for the whole host.
    const panel = panels.find((p) => p.covers(event.clientX, event.clientY));
    const rank = panel?.pick(event.clientX, event.clientY) ?? null;
    if (rank !== null) grasps?.choose(rank);
  });
  const section = sectionFigure(panels, bounds, bounds.extent, redraw);
  const stopScheme = onSchemeChange(() => {
    panels.forEach((panel) => panel.restyle());
    redraw();
  });
  const translucent = tick("see through the object", false, (on) => {
    panels.forEach((panel) => panel.showTranslucent(on));
    redraw();
  });
  const element = h("main", { class: "object" }, head(report, object, index),
    surface ? null : h("p", { class: "notice", role: "alert" }, NO_WEBGL),
    h("div", { class: "object-grid" },
      h("div", { class: "object-main" }, surface ? host : null,
        surface ? h("p", { class: "note hint" }, "Drag to turn; click first, then the wheel zooms; click an axis to choose its grasp.") : null,
        h("div", { class: "under" }, buttons(object, surface), surface ? translucent : null)),
      h("div", { class: "side" }, grasps?.element ?? h("section", { class: "panel-box" }, h("h2", {}, "Grasps"), h("p", { class: "note" }, "No grasps of this object are stored.")),
        sides.length > 1 ? heatControls(object, changed, redraw) : null, ...tables),
      section.element));
  return {
    title: object.name,
    element,
    mounted: redraw,
    dispose: () => {
      stopScheme();
      section.dispose();
      controls.dispose();
      panels.forEach((panel) => panel.dispose());
      surface?.dispose();
    },
  };
}
