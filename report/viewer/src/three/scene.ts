import { type Camera, Color, DirectionalLight, Group, HemisphereLight, Scene } from "three";

export interface LitScene {
  scene: Scene;
  /** Turns the lights with the camera; call before drawing. */
  follow: (camera: Camera) => void;
}

/** A scene with the light of all pictures: soft from above, a key light that travels with the camera. */
export function litScene(): LitScene {
  const scene = new Scene();
  const rig = new Group();
  const key = new DirectionalLight(0xffffff, 2.6);
  key.position.set(-0.6, 0.9, 1);
  const fill = new DirectionalLight(0xffffff, 0.8);
  fill.position.set(1, -0.2, 0.6);
  rig.add(key, key.target, fill, fill.target);
  const sky = new HemisphereLight(0xffffff, 0x857f75, 1.25);
  sky.position.set(0, 0, 1);
  scene.add(sky, rig);
  return { scene, follow: (camera) => rig.quaternion.copy(camera.quaternion) };
}

/** A colour of the page's style sheet, which knows light and dark. */
export function cssColour(name: string): Color {
  return new Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#888888");
}

/** Calls `changed` when the colour scheme of the system changes; the result stops it. */
export function onSchemeChange(changed: () => void): () => void {
  const query = window.matchMedia("(prefers-color-scheme: dark)");
  query.addEventListener("change", changed);
  return () => query.removeEventListener("change", changed);
}
