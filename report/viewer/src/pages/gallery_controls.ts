import { choice, tick } from "../controls";
import { isRejected, type Report } from "../data/report";
import { h } from "../dom";
import type { TilePictures } from "../three/tiles";
import type { GalleryState, SortKey, StatusFilter } from "./gallery_order";

/** The gallery's toolbar; `show` draws the gallery anew from the state. */
export function galleryControls(
  report: Report,
  state: GalleryState,
  show: () => void,
  pictures: TilePictures,
): HTMLElement {
  const set =
    <K extends keyof GalleryState>(key: K) =>
    (value: GalleryState[K]) => {
      state[key] = value;
      show();
    };
  const sort = choice<SortKey>(
    "Sort by",
    state.sort,
    [
      ["stored", "order of the run"],
      ["ascending", "least graspable first"],
      ["descending", "most graspable first"],
      ["name", "name"],
    ],
    set("sort"),
  );
  const statuses: [StatusFilter, string][] = [["all", "all"]];
  if (report.objects.some((o) => o.elite)) statuses.push(["elite", "elites"]);
  if (report.objects.some(isRejected)) statuses.push(["accepted", "accepted"], ["rejected", "rejected"]);
  const search = h("input", {
    type: "search",
    value: state.text,
    placeholder: "part of a name",
    oninput: () => set("text")(search.value.trim()),
  });
  const stages =
    report.groups.length > 1
      ? h(
          "fieldset",
          { class: "chips" },
          h("legend", {}, "Stages"),
          ...report.groups.map((group, i) =>
            tick(
              group.label,
              state.groups.has(i),
              (on) => {
                if (on) state.groups.add(i);
                else state.groups.delete(i);
                show();
              },
              "chip",
            ),
          ),
        )
      : null;
  return h(
    "form",
    {
      class: "controls",
      "aria-label": "Which objects, and in what order",
      onsubmit: (event: Event) => event.preventDefault(),
    },
    stages,
    h(
      "div",
      { class: "control-row" },
      sort,
      statuses.length > 1 ? choice<StatusFilter>("Show", state.status, statuses, set("status")) : null,
      h("label", { class: "field" }, h("span", {}, "Find"), search),
      report.groups.length > 1 ? tick("stages apart", state.byStage, set("byStage")) : null,
      tick("turn all together", state.together, (on) => {
        state.together = on;
        pictures.together = on;
      }),
      h("button", { type: "button", onclick: () => pictures.resetTurns() }, "Reset views"),
    ),
  );
}
