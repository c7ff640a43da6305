import { choice, slider } from "../controls";
import { h } from "../dom";
import { fixed } from "../format";

const SPEEDS: [string, string][] = [
  ["1", "real time"],
  ["0.5", "half speed"],
  ["0.1", "a tenth"],
  ["0.02", "a fiftieth"],
];
const STEPS = 1000; // of the slider

export interface Clock {
  element: HTMLElement;
  /** The time runs from here to there, seconds; it goes back to the beginning. */
  span: (from: number, to: number) => void;
  /** Shows the present moment once more. */
  again: () => void;
  stop: () => void;
}

/** Play, pause, scrub, slow motion. Nothing moves until it is asked to. */
export function clock(show: (t: number) => void): Clock {
  let from = 0,
    to = 1,
    now = 0,
    speed = 0.1,
    frame = 0,
    last = 0;
  const button = h("button", { type: "button", class: "play", onclick: () => (frame ? stop() : play()) }, "Play");
  const set = (t: number) => {
    now = Math.min(to, Math.max(from, t));
    show(now);
  };
  const place = () => scrub.set(to > from ? Math.round((STEPS * (now - from)) / (to - from)) : 0);
  const stop = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    button.textContent = "Play";
  };
  const play = () => {
    if (now >= to) set(from);
    last = performance.now();
    button.textContent = "Pause";
    frame = requestAnimationFrame(step);
  };
  const step = (at: number) => {
    set(now + (speed * Math.max(0, at - last)) / 1000);
    last = at;
    place();
    if (now < to) frame = requestAnimationFrame(step);
    else stop();
  };
  const scrub = slider(
    "Time",
    { min: 0, max: STEPS, step: 1, value: 0 },
    (k) => `${fixed(from + (k / STEPS) * (to - from), 3)} s`,
    (k) => {
      stop();
      set(from + (k / STEPS) * (to - from));
    },
  );
  const pace = choice("Speed", String(speed), SPEEDS, (value) => {
    speed = Number(value);
  });
  const span = (first: number, end: number) => {
    stop();
    from = first;
    to = end;
    set(from);
    place();
  };
  return { element: h("div", { class: "clock" }, button, scrub.element, pace), span, again: () => show(now), stop };
}
