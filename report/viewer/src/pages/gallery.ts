import { graspability, isRejected, type ObjectRecord, remark, type Report } from "../data/report";
import { meanOf } from "../data/statistics";
import { h } from "../dom";
import { count, fixed, known, milli, MILLI_UNIT, NONE } from "../format";
import { objectLink, type Page } from "../router";
import { NO_WEBGL } from "../three/surface";
import { onSchemeChange } from "../three/scene";
import { TilePictures } from "../three/tiles";
import { galleryControls } from "./gallery_controls";
import { gallerySections, galleryState, type Section } from "./gallery_order";

const KEY_TURN = Math.PI / 12;

/** "−36 %" of an object that was changed, "" where there is nothing to compare. */
function changeText(object: ObjectRecord): string {
  const before = graspability(object.pair),
    after = graspability(object);
  if (before === null || after === null || before <= 0) return "";
  const change = Math.round(100 * (after / before - 1));
  return `${change > 0 ? "+" : ""}${fixed(change, 0)} %`;
}

function tile(report: Report, index: number, largest: number, withStage: boolean): HTMLElement {
  const object = report.objects[index];
  const value = graspability(object);
  const rejected = isRejected(object);
  const stage = report.groups[object.group]?.label ?? "";
  const change = changeText(object);
  const score = known(value) ? milli(value) : NONE;
  const says = [
    object.name,
    stage,
    rejected ? `rejected: ${object.status}` : remark(object),
    `graspability ${known(value) ? `${score}\u00a0${MILLI_UNIT}` : "not measured"}`,
    change,
    object.elite ? "elite" : "",
  ];
  const picture = h("span", { class: "picture", "data-object": index });
  if (!object.mesh) picture.append(h("span", { class: "no-mesh" }, "no mesh"));
  if (object.elite) picture.append(h("span", { class: "badge" }, "elite"));
  if (rejected || remark(object))
    picture.append(
      h("span", { class: rejected ? "badge bad" : "badge low" }, rejected ? object.status : remark(object)),
    );
  return h(
    "a",
    {
      class: rejected ? "tile rejected" : "tile",
      href: objectLink(index),
      draggable: "false",
      "aria-label": says.filter(Boolean).join(", "),
      title: object.name,
    },
    picture,
    h(
      "span",
      { class: "tile-bar" },
      known(value) && largest > 0
        ? h("i", { style: `width:${((100 * Math.max(0, value)) / largest).toFixed(1)}%` })
        : null,
    ),
    h(
      "span",
      { class: "tile-text" },
      h("b", {}, score),
      " ",
      change ? h("span", {}, change) : null,
      " ",
      h("span", { class: "tile-name" }, withStage && stage ? `${stage} · ${object.name}` : object.name),
    ),
  );
}

function sectionHeading(report: Report, section: Section): HTMLElement | null {
  if (section.group < 0) return null;
  const group = report.groups[section.group];
  // The mean of the whole stage: that of the objects shown would be low where the least graspable were picked.
  const mean = meanOf(report.run?.stages.find((stage) => stage.id === group.id));
  const facts = [
    `${count(section.objects.length)} shown`,
    group.note ?? "",
    mean ? `mean of the stage ${milli(mean.value)}${known(mean.half) ? ` ± ${milli(mean.half)}` : ""}` : "",
  ];
  return h("h2", {}, group.label, h("small", {}, facts.filter(Boolean).join(" · ")));
}

/** Drags rotate, clicks open: a press that moves by more than a few pixels is no click. */
function listenToDrags(host: HTMLElement, pictures: TilePictures): void {
  let from: { x: number; y: number; object: number; moved: boolean } | null = null;
  host.addEventListener("pointerdown", (event) => {
    const picture = (event.target as HTMLElement).closest<HTMLElement>(".tile")?.querySelector<HTMLElement>(".picture");
    if (!picture || event.button !== 0) return;
    from = { x: event.clientX, y: event.clientY, object: Number(picture.dataset.object), moved: false };
  });
  const move = (event: PointerEvent) => {
    if (!from) return;
    const dx = event.clientX - from.x,
      dy = event.clientY - from.y;
    if (!from.moved && Math.hypot(dx, dy) < 5) return;
    from.moved = true;
    pictures.turn(from.object, dx * 0.012, dy * 0.012);
    from.x = event.clientX;
    from.y = event.clientY;
  };
  host.addEventListener("pointermove", move);
  host.addEventListener("pointerleave", () => {
    if (from && !from.moved) from = null;
  });
  host.addEventListener("pointercancel", () => {
    from = null;
  });
  host.addEventListener("pointerup", () => {
    setTimeout(() => {
      from = null;
    }, 0);
  }); // the click comes first
  host.addEventListener("click", (event) => {
    if (from?.moved) event.preventDefault();
  });
  host.addEventListener("dragstart", (event) => event.preventDefault());
  host.addEventListener("keydown", (event) => {
    const picture = (event.target as HTMLElement).querySelector?.<HTMLElement>(".picture");
    if (!picture || (event.key !== "ArrowLeft" && event.key !== "ArrowRight")) return;
    event.preventDefault();
    pictures.turn(Number(picture.dataset.object), event.key === "ArrowLeft" ? -KEY_TURN : KEY_TURN, 0);
  });
}

export function galleryPage(report: Report): Page {
  const state = galleryState(report);
  const host = h("div", { class: "tiles-host" });
  const status = h("p", { class: "status", role: "status" });
  const pictures = new TilePictures(host, report.objects);
  pictures.together = state.together;
  const largest = report.objects.reduce((m, object) => Math.max(m, graspability(object) ?? 0), 0);
  const content = h("div", {});
  host.prepend(content);

  const show = () => {
    const sections = gallerySections(report, state);
    const total = sections.reduce((n, s) => n + s.objects.length, 0);
    const single = sections.length === 1 && sections[0].group < 0;
    content.replaceChildren(
      ...sections.map((section) =>
        h(
          "section",
          { class: "stage" },
          sectionHeading(report, section),
          h(
            "div",
            { class: "tiles" },
            ...section.objects.map((i) => tile(report, i, largest, single && report.groups.length > 1)),
          ),
        ),
      ),
    );
    status.textContent = total
      ? `${count(total)} of ${count(report.objects.length)} objects. Number: graspability, ${MILLI_UNIT}.`
      : "No object passes these filters.";
    pictures.watch([...content.querySelectorAll<HTMLElement>(".picture")]);
  };
  const controls = galleryControls(report, state, show, pictures);
  const scrolled = () => pictures.scrolled();
  const stopScheme = onSchemeChange(() => pictures.restyle());
  listenToDrags(host, pictures);
  const main = h(
    "main",
    { class: "gallery" },
    h(
      "div",
      { class: "page-head" },
      h("h1", { tabindex: -1 }, "Objects"),
      h("p", { class: "lead" }, "Drag an object to turn it, or use the arrow keys; click or press Enter to open it."),
    ),
    pictures.available ? null : h("p", { class: "notice", role: "alert" }, NO_WEBGL),
    report.objects.length ? null : h("p", { class: "notice" }, "This report holds no objects."),
    controls,
    status,
    host,
  );
  return {
    title: "Objects",
    element: main,
    mounted: () => {
      show();
      window.addEventListener("scroll", scrolled, { passive: true });
      if (state.scroll) window.scrollTo(0, state.scroll);
    },
    dispose: () => {
      state.scroll = window.scrollY;
      window.removeEventListener("scroll", scrolled);
      stopScheme();
      pictures.dispose();
    },
  };
}
