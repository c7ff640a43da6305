import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** The box that holds all that is shown, mesh units. */
export interface Bounds {
  min: [number, number, number];
  max: [number, number, number];
  /** The longest side. */
  extent: number;
}

/** One camera for all panels of `host`: both sides of a pair are always seen from the same place. */
export function setUpCamera(
  host: HTMLElement,
  bounds: Bounds,
  redraw: () => void,
): { camera: PerspectiveCamera; controls: OrbitControls } {
  const camera = new PerspectiveCamera(27, 1, 0.01 * bounds.extent, 60 * bounds.extent);
  camera.up.set(0, 0, 1);
  const centre = new Vector3(
    ...([0, 1, 2].map((k) => (bounds.min[k] + bounds.max[k]) / 2) as [number, number, number]),
  );
  camera.position.copy(centre).add(new Vector3(1.5, -3.1, 1.65).multiplyScalar(bounds.extent * 0.84));
  const controls = new OrbitControls(camera, host);
  controls.target.copy(centre);
  controls.enableDamping = false;
  controls.minDistance = 0.4 * bounds.extent;
  controls.maxDistance = 20 * bounds.extent;
  // The wheel belongs to the page until the view has been clicked or tabbed to; fingers may still scroll up and down.
  controls.enableZoom = false;
  host.addEventListener("focusin", () => {
    controls.enableZoom = true;
  });
  host.addEventListener("focusout", () => {
    controls.enableZoom = false;
  });
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
