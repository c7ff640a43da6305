import { qualityColour, QUALITY_GRADIENT } from "../colours";
import { slider, tick } from "../controls";
import type { Gripper, Metric } from "../data/report";
import { h } from "../dom";
import { count, fixed, milli, MILLI_UNIT, NONE } from "../format";
import type { ObjectPanel } from "../three/object_panel";

const FIRST_SHOWN = 25; // Fig. 1: the most robust 25 of 100

export interface GraspControls {
  element: HTMLElement;
  choose: (rank: number) => void;
}

/** The qualities of all grasps as bars, best first; a click chooses one. */
function qualityStrip(
  panel: ObjectPanel,
  best: number,
  choose: (rank: number) => void,
): { element: HTMLElement; mark: (shown: number, chosen: number) => void } {
  const bars = panel.grasps.map((grasp, rank) => {
    const relative = best > 0 ? Math.max(0, grasp.quality / best) : 0;
    return h("i", {
      style: `height:${(4 + 96 * relative).toFixed(1)}%;background:${qualityColour(relative)}`,
      title: `grasp ${rank + 1}: ${milli(grasp.quality)}\u00a0${MILLI_UNIT}`,
    });
  });
  // The slider below does the same for the keyboard.
  const element = h(
    "div",
    {
      class: "strip",
      "aria-hidden": "true",
      onclick: (event: MouseEvent) => {
        const box = element.getBoundingClientRect();
        choose(
          Math.min(bars.length - 1, Math.max(0, Math.floor((bars.length * (event.clientX - box.left)) / box.width))),
        );
      },
    },
    ...bars,
  );
  const mark = (shown: number, chosen: number) =>
    bars.forEach((bar, i) => {
      bar.className = i === chosen ? "chosen" : i < shown ? "" : "off";
    });
  return { element, mark };
}

function describe(panel: ObjectPanel, rank: number): string {
  const grasp = panel.grasps[rank];
  if (!grasp) return NONE;
  const width = grasp.width * panel.shape.metres_per_unit * 1000;
  return `quality ${milli(grasp.quality)}\u00a0${MILLI_UNIT}, width ${fixed(width, 1)}\u00a0mm${grasp.approach ? "" : ", approach unknown"}`;
}

/** Sliders and ticks for the grasps of all panels; null when there are no grasps. */
export function graspControls(
  panels: ObjectPanel[],
  best: number,
  metric: Metric | null,
  gripper: Gripper | null,
  redraw: () => void,
): GraspControls | null {
  const most = Math.max(...panels.map((panel) => panel.grasps.length));
  if (!(most > 0)) return null;
  let shown = Math.min(FIRST_SHOWN, most),
    chosen = 0,
    cones = false,
    withGripper = false,
    chosenOnce = false;
  const strips = panels.map((panel) => qualityStrip(panel, best, (rank) => choose(rank)));
  const readouts = panels.map(() => h("dd", {}));
  const update = () => {
    panels.forEach((panel, i) => {
      panel.showGrasps(shown, chosen, cones, withGripper ? gripper : null);
      strips[i].mark(shown, chosen);
      readouts[i].textContent = describe(panel, chosen);
    });
    redraw();
  };
  // At first the axes have the view to themselves; the gripper comes with the first grasp that is chosen.
  const choose = (rank: number) => {
    chosen = rank;
    rankSlider.set(rank + 1);
    if (gripperTick && !chosenOnce) gripperTick.querySelector("input")!.checked = withGripper = true;
    chosenOnce = true;
    update();
  };
  const countSlider = slider(
    "Grasps shown, best first",
    { min: 0, max: most, step: 1, value: shown },
    (n) => `${n} of ${most}`,
    (n) => {
      shown = n;
      update();
    },
  );
  const rankSlider = slider(
    "Chosen grasp",
    { min: 1, max: most, step: 1, value: 1 },
    (n) => `rank ${n}`,
    (n) => choose(n - 1),
  );
  const gripperTick = gripper
    ? tick("gripper on the chosen grasp", withGripper, (on) => {
        withGripper = on;
        update();
      })
    : null;
  const two = panels.length > 1;
  const element = h(
    "section",
    { class: "panel-box" },
    h("h2", {}, "Grasps"),
    countSlider.element,
    ...panels.flatMap((panel, i) => [
      two ? h("p", { class: "strip-label" }, panel.shape.label ?? "after") : null,
      strips[i].element,
    ]),
    h(
      "div",
      { class: "legend" },
      h("span", {}, "0"),
      h("i", { style: `background:${QUALITY_GRADIENT}` }),
      h("span", {}, `${milli(best)}\u00a0${MILLI_UNIT}`),
    ),
    h("p", { class: "note" }, "Colour: robust quality relative to the best grasp shown here."),
    rankSlider.element,
    h(
      "dl",
      { class: "readout" },
      ...panels.flatMap((panel, i) => [h("dt", {}, two ? (panel.shape.label ?? "after") : "grasp"), readouts[i]]),
    ),
    h(
      "div",
      { class: "ticks" },
      gripperTick,
      tick("friction cones of all", cones, (on) => {
        cones = on;
        update();
      }),
    ),
    metric?.num_grasps
      ? h(
          "p",
          { class: "note" },
          `Of ${count(metric.num_grasps)} sampled grasps, ${count(metric.num_draws)} draws each.`,
        )
      : null,
  );
  update();
  return { element, choose };
}
