import { blobLoaded } from "./data/blob";

const tasks: (() => void)[] = [];

const nextTask = () => {
  tasks.shift()?.();
  if (tasks.length) requestAnimationFrame(nextTask);
};

/**
 * Runs what need not be on the screen first: at once on a page that the browser has read to its end; else a piece a
 * frame after the first objects have been drawn, and all that is left when the end has been read.
 */
export function afterFirstObjects(task: () => void): void {
  if (blobLoaded()) return task();
  if (!tasks.length) document.addEventListener("DOMContentLoaded", () => tasks.splice(0).forEach((left) => left()));
  tasks.push(task);
}

/** For the browser's own performance tools and the tests, and for what waits. */
export function firstObjectsDrawn(): void {
  const name = "antigrasp-first-objects";
  if (performance.getEntriesByName(name).length) return;
  performance.mark(name);
  requestAnimationFrame(nextTask);
}
