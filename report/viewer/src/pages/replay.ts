import { choice, tick } from "../controls";
import { type Mesh, meshOf } from "../data/mesh";
import type { ObjectRecord, Report } from "../data/report";
import { firstPair, type Frame, framesOf, isHeld, type Moment, type Replay } from "../data/trials";
import { h } from "../dom";
import { fixed, known } from "../format";
import { objectLink, type Page } from "../router";
import { type Bounds, setUpCamera } from "../three/object_camera";
import { ReplayPanel } from "../three/replay_panel";
import { onSchemeChange } from "../three/scene";
import { NO_WEBGL, Surface } from "../three/surface";
import { JUDGE } from "./object_trials";
import { clock } from "./replay_clock";

/** A replay that can be drawn: with the mesh of its side and its frames. */
interface Playable {
  replay: Replay;
  mesh: Mesh;
  frames: Frame[];
}

function playableOf(object: ObjectRecord): Playable[] {
  return (object.trials?.replays ?? []).flatMap((replay) => {
    const mesh = meshOf(replay.side === "before" && object.pair ? object.pair : object);
    const frames = mesh ? framesOf(replay) : [];
    return mesh && frames.length > 0 ? [{ replay, mesh, frames }] : [];
  });
}

function titleOf({ replay }: Playable): string {
  const side = replay.side === "before" ? ", before" : "";
  return `${replay.outcome}: grasp ${replay.grasp}, execution ${replay.execution} (${replay.protocol}${side})`;
}

/** Fingertips and object as they stand when the first frame begins: what falls may leave the picture. */
function boundsOf(all: Playable[]): Bounds {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const { replay, mesh, frames } of all) {
    const radius = 0.5 * replay.metres_per_unit * Math.max(...[0, 1, 2].map((k) => mesh.max[k] - mesh.min[k]));
    for (const [k, at] of frames[0].tips[0].entries()) {
      min[k] = Math.min(min[k], at, frames[0].tips[1][k], -radius);
      max[k] = Math.max(max[k], at, frames[0].tips[1][k], radius);
    }
  }
  return { min, max, extent: Math.max(...[0, 1, 2].map((k) => max[k] - min[k])) };
}

function describe({ replay }: Playable, moment: Moment): string {
  const largest = moment.forces.reduce((most, f) => Math.max(most, Math.hypot(f[3], f[4], f[5])), 0);
  const friction = known(replay.friction) ? `, friction ${fixed(replay.friction, 2)}` : "";
  return `contacts ${moment.forces.length}, largest force ${fixed(largest, 1)}\u00a0N${friction}`;
}

/** One side of the view: a choice of executions, a picture, what is there now. */
class Stage {
  readonly picture = h("div", { class: "panel-picture" });
  private readonly readout = h("span", {});
  private readonly badge = h("b", {});
  /** Outside of the picture, which takes arrow keys and drags for its camera. */
  readonly select: HTMLElement;
  readonly element: HTMLElement;
  panel: ReplayPanel | null = null;

  constructor(
    label: string,
    private readonly all: Playable[],
    private chosen: number,
    private readonly make: (element: HTMLElement, playable: Playable) => ReplayPanel,
    changed: () => void,
  ) {
    const options = all.map((playable, i): [string, string] => [String(i), titleOf(playable)]);
    this.select = choice(label, String(chosen), options, (i) => {
      this.set(Number(i));
      changed();
    });
    this.element = h("figure", {}, this.picture, h("figcaption", {}, this.badge, this.readout));
    this.set(chosen);
  }

  get playable(): Playable {
    return this.all[this.chosen];
  }

  private set(chosen: number): void {
    this.chosen = chosen;
    this.panel?.dispose();
    this.panel = this.make(this.picture, this.playable);
    this.badge.textContent = this.playable.replay.outcome;
    this.badge.className = isHeld(this.playable.replay.outcome) ? "outcome held" : "outcome lost";
  }

  show(t: number): void {
    this.readout.textContent = describe(this.playable, this.panel!.show(t));
  }
}

function message(object: ObjectRecord, index: number, text: string): Page {
  const back = h("p", {}, h("a", { href: objectLink(index) }, "Back to the object"));
  return { title: object.name, element: h("main", { class: "message" }, h("h1", { tabindex: -1 }, text), back) };
}

/** Executions in motion, two side by side: play, pause, scrub, slow motion. */
export function replayPage(report: Report, index: number): Page {
  const object = report.objects[index];
  const all = playableOf(object);
  if (!all.length) return message(object, index, "No execution of this object is stored.");
  const host = h("div", { class: "panels", tabindex: 0, role: "application" });
  host.setAttribute("aria-label", `3D view of executions of ${object.name}: arrow keys turn, plus and minus zoom`);
  const stages: Stage[] = [];
  const surface = Surface.over(host, () => stages.flatMap((stage) => (stage.panel ? [stage.panel] : [])));
  const redraw = () => surface?.invalidate();
  const { camera, controls } = setUpCamera(host, boundsOf(all), redraw);
  const pair = firstPair(all.map(({ replay }) => replay));
  const make = (element: HTMLElement, { mesh, replay, frames }: Playable) =>
    new ReplayPanel(element, camera, mesh, replay, frames);
  let forces = true;
  const show = (t: number) => {
    for (const stage of stages) {
      stage.panel?.showForces(forces);
      stage.show(t);
    }
    redraw();
  };
  const time = clock(show);
  const spans = () => stages.map(({ playable: { frames } }) => [frames[0].t, frames[frames.length - 1].t]);
  const reset = () => time.span(Math.min(...spans().map(([a]) => a)), Math.max(...spans().map(([, b]) => b)));
  pair.forEach((chosen, i) => {
    const label = pair.length > 1 ? (i === 0 ? "Execution on the left" : "Execution on the right") : "Execution";
    stages.push(new Stage(label, all, chosen, make, () => reset()));
  });
  host.append(...stages.map((stage) => stage.element));
  const stopScheme = onSchemeChange(() => {
    stages.forEach((stage) => stage.panel?.restyle());
    redraw();
  });
  const element = h(
    "main",
    { class: "object" },
    h(
      "div",
      { class: "page-head" },
      h("nav", { class: "steps", "aria-label": "Back" }, h("a", { href: objectLink(index) }, "← the object")),
      h("h1", { tabindex: -1 }, object.name),
      h("p", { class: "lead" }, "Executions as they were simulated"),
      h("p", { class: "note" }, JUDGE),
    ),
    surface ? null : h("p", { class: "notice", role: "alert" }, NO_WEBGL),
    h("div", { class: "choices" }, ...stages.map((stage) => stage.select)),
    time.element,
    host,
    tick("forces on the object", true, (on) => {
      forces = on;
      time.again();
    }),
    h(
      "p",
      { class: "note" },
      "Arrows end where a fingertip or the table pushes; the longest one is the largest force.",
    ),
  );
  reset();
  const dispose = () => {
    time.stop();
    stopScheme();
    controls.dispose();
    stages.forEach((stage) => stage.panel?.dispose());
    surface?.dispose();
  };
  return { title: `${object.name}, replay`, element, mounted: redraw, dispose };
}
