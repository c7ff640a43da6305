import { download, fileName } from "../data/download";
import { meshOf } from "../data/mesh";
import { isRejected, type ObjectRecord, remark, type Report } from "../data/report";
import { stlPlan, writeStl } from "../data/stl";
import { h } from "../dom";
import { count, fixed } from "../format";
import { objectLink } from "../router";
import type { Surface } from "../three/surface";
import { galleryOrder } from "./gallery_order";

/** In what all lengths of the page are but those of the print: one unit, at one size. */
function lengthsNote(report: Report, object: ObjectRecord): HTMLElement | null {
  const mesh = meshOf(object);
  if (!mesh) return null;
  const size = [0, 1, 2].map((k) => fixed((mesh.max[k] - mesh.min[k]) * 1000 * object.metres_per_unit, 1)).join(" × ");
  const scored = object.score ? `of the object as scored${report.metric?.size ? `, ${report.metric.size}` : ""}` : "";
  const says = `Lengths are millimetres ${scored || "if a unit of the mesh is a metre"}: ${size}.`;
  return h("p", { class: "note lengths" }, says);
}

/** Name and facts of an object, and the way to its neighbours. */
export function objectHead(report: Report, object: ObjectRecord, index: number): HTMLElement {
  const order = galleryOrder(report);
  const at = order.indexOf(index);
  const link = (text: string, to: number | undefined, rel: string) =>
    to === undefined
      ? h("span", { class: "step off" }, text)
      : h("a", { class: "step", href: objectLink(to), rel }, text);
  const facts = [
    report.groups[object.group]?.label ?? "",
    object.elite ? "elite" : "",
    remark(object),
    object.mesh
      ? `${count(object.mesh.triangles)} triangles${object.mesh.full_triangles ? `, decimated from ${count(object.mesh.full_triangles)}` : ""}`
      : "",
  ];
  return h(
    "div",
    { class: "page-head" },
    h(
      "nav",
      { class: "steps", "aria-label": "Neighbouring objects" },
      h("a", { href: "#/gallery" }, "All objects"),
      link("← previous", at > 0 ? order[at - 1] : undefined, "prev"),
      link("next →", at >= 0 ? order[at + 1] : order[0], "next"),
    ),
    h("h1", { tabindex: -1 }, object.name),
    h("p", { class: "lead" }, facts.filter(Boolean).join(" · ")),
    lengthsNote(report, object),
    isRejected(object) ? h("p", { class: "notice bad" }, `Rejected: ${object.status}`) : null,
  );
}

/** "Download STL" and "Save PNG"; STL works without WebGL. */
export function objectButtons(object: ObjectRecord, surface: Surface | null): HTMLElement {
  const mesh = meshOf(object);
  const save = mesh
    ? h(
        "button",
        {
          type: "button",
          onclick: () => {
            download(
              new Blob([writeStl(mesh, stlPlan(object, mesh))], { type: "model/stl" }),
              fileName(object.name, "stl"),
            );
          },
        },
        "Download STL",
      )
    : null;
  const plan = mesh ? stlPlan(object, mesh) : null;
  const size = mesh && plan ? [0, 1, 2].map((k) => fixed((mesh.max[k] - mesh.min[k]) * plan.scale, 0)).join(" × ") : "";
  const says = plan
    ? `STL: ${size} mm${plan.pose ? ", turned to the suggested print pose" : ""}${object.mesh?.full_triangles ? ", decimated as shown" : ""}.`
    : "";
  return h(
    "div",
    { class: "buttons" },
    save,
    surface
      ? h(
          "button",
          {
            type: "button",
            onclick: async () => {
              const blob = await surface.png();
              if (blob) download(blob, fileName(object.name, "png"));
            },
          },
          "Save PNG",
        )
      : null,
    h("span", { class: "note" }, says),
  );
}
