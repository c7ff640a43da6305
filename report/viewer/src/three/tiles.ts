import {
  type BufferGeometry,
  Group,
  Mesh as ThreeMesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  DoubleSide,
} from "three";
import { meshOf } from "../data/mesh";
import type { Shape } from "../data/report";
import { shade } from "./geometry";
import { cssColour, litScene } from "./scene";
import { Surface, type View } from "./surface";

export interface Turn {
  yaw: number;
  pitch: number;
}

const START: Turn = { yaw: -0.55, pitch: 0 };
// Time for decoding per frame: little, so that scrolling stays fluid while objects arrive; more where drawing itself is
// slow (no GPU), or the last object would come late.
const DECODE_MS = 10,
  MOST_DECODE_MS = 150,
  FIRST_DECODE_MS = 80;
const KEEP_GEOMETRIES = 200;
const MARGIN = 240; // how far the canvas reaches beyond the window, so that scrolling finds it drawn

/**
 * Draws the shapes whose pictures are on the screen: elements with the shape's index as data-object. `whole`: all of
 * them at once, for a host that is no higher than a screen or two.
 */
export class TilePictures {
  together = true;
  private readonly camera = new PerspectiveCamera(27, 1, 0.1, 20);
  private readonly lit = litScene();
  private readonly pivot = new Group();
  private readonly body: ThreeMesh;
  private readonly material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide });
  private readonly geometries = new Map<number, BufferGeometry | null>();
  private readonly visible = new Map<Element, number>();
  private readonly observer: IntersectionObserver;
  private readonly turns = new Map<number, Turn>();
  private shared: Turn = { ...START };
  private deadline = 0;
  private lastFrame = 0;
  private fresh = true;
  private waiting = false;
  readonly surface: Surface | null;

  constructor(
    private readonly host: HTMLElement,
    private readonly shapes: Shape[],
    private readonly whole = false,
  ) {
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(0, -4.1, 1.75);
    this.camera.lookAt(0, 0, 0);
    this.lit.follow(this.camera);
    this.body = new ThreeMesh(undefined, this.material);
    this.pivot.add(this.body);
    this.lit.scene.add(this.pivot);
    this.restyle();
    this.observer = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          if (isIntersecting) this.visible.set(target, Number((target as HTMLElement).dataset.object));
          else this.visible.delete(target);
        }
        this.invalidate();
      },
      { rootMargin: `${MARGIN}px 0px` },
    );
    this.surface = Surface.over(
      host,
      () => this.views(),
      (canvas) => this.place(canvas),
    );
  }

  restyle(): void {
    this.material.color = cssColour("--clay");
    this.invalidate();
  }

  /** The pictures now on the page. */
  watch(pictures: HTMLElement[]): void {
    this.observer.disconnect();
    this.visible.clear();
    this.fresh = true;
    for (const picture of pictures) {
      if (this.whole) this.visible.set(picture, Number(picture.dataset.object));
      else this.observer.observe(picture);
    }
    this.invalidate();
  }

  turn(object: number, yaw: number, pitch: number): void {
    const turn = this.together ? this.shared : this.turnOf(object);
    turn.yaw += yaw;
    turn.pitch = Math.min(1.4, Math.max(-1.4, turn.pitch + pitch));
    if (this.together) this.turns.clear();
    else this.turns.set(object, turn);
    this.invalidate();
  }

  resetTurns(): void {
    this.shared = { ...START };
    this.turns.clear();
    this.invalidate();
  }

  invalidate(): void {
    this.surface?.invalidate();
  }

  dispose(): void {
    this.observer.disconnect();
    this.surface?.dispose();
    for (const geometry of this.geometries.values()) geometry?.dispose();
    this.material.dispose();
  }

  private turnOf(object: number): Turn {
    return this.turns.get(object) ?? { ...this.shared };
  }

  // The canvas is as high as the window and its margins, and slides inside the host: a canvas over all 500 tiles
  // would be larger than browsers allow.
  private place(canvas: HTMLCanvasElement): { width: number; height: number } {
    const box = this.host.getBoundingClientRect();
    const height = this.whole
      ? this.host.clientHeight
      : Math.min(this.host.clientHeight, window.innerHeight + 2 * MARGIN);
    const top = Math.round(Math.min(Math.max(0, -box.top - MARGIN), this.host.clientHeight - height));
    canvas.style.transform = `translateY(${top}px)`;
    const now = performance.now();
    const interval = this.waiting ? now - this.lastFrame : 0;
    this.deadline =
      now +
      Math.min(MOST_DECODE_MS, Math.max(this.fresh && this.visible.size ? FIRST_DECODE_MS : DECODE_MS, 0.6 * interval));
    if (this.visible.size) this.fresh = false;
    this.lastFrame = now;
    this.waiting = false;
    return { width: this.host.clientWidth, height };
  }

  private *views(): Iterable<View> {
    for (const [element, object] of this.visible) {
      const geometry = this.geometry(object);
      if (!geometry) continue;
      yield {
        element: element as HTMLElement,
        scene: this.lit.scene,
        camera: this.camera,
        prepare: (width, height) => this.pose(object, geometry, width / height),
      };
    }
    if (this.waiting) this.invalidate();
  }

  private pose(object: number, geometry: BufferGeometry, aspect: number): void {
    const sphere = geometry.boundingSphere!;
    const scale = 1 / (sphere.radius || 1);
    const turn = this.turnOf(object);
    this.body.geometry = geometry;
    this.body.scale.setScalar(scale);
    this.body.position.copy(sphere.center).multiplyScalar(-scale);
    this.pivot.rotation.set(turn.pitch, 0, turn.yaw, "XYZ");
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  private geometry(object: number): BufferGeometry | null {
    const known = this.geometries.get(object);
    if (known !== undefined) {
      this.geometries.delete(object); // to the end: the first is the one longest unused
      this.geometries.set(object, known);
      return known;
    }
    if (performance.now() > this.deadline) {
      this.waiting = true;
      return null;
    }
    const mesh = meshOf(this.shapes[object]);
    const geometry = mesh ? shade(mesh).geometry : null;
    this.geometries.set(object, geometry);
    if (this.geometries.size > Math.max(KEEP_GEOMETRIES, 2 * this.visible.size)) {
      const [oldest, unused] = this.geometries.entries().next().value!;
      unused?.dispose();
      this.geometries.delete(oldest);
    }
    return geometry;
  }
}
