import {
  type BufferGeometry,
  Group,
  Mesh as ThreeMesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  DoubleSide,
} from "three";
import { hasArrived } from "../data/blob";
import { meshOf } from "../data/mesh";
import type { Shape } from "../data/report";
import { firstObjectsDrawn } from "../early";
import { shade } from "./geometry";
import { Pace } from "./pace";
import { cssColour, litScene } from "./scene";
import { pixelRatio, sharedRenderer } from "./surface";

export interface Turn {
  yaw: number;
  pitch: number;
}

const START: Turn = { yaw: -0.55, pitch: 0 };
// Time for decoding and drawing per frame: little while the page is scrolled, which must stay fluid; more where
// nothing moves, or the last object would come late.
const SCROLLING_MS = 6,
  RESTING_MS = 60,
  REST_AFTER_MS = 150;
const KEEP_GEOMETRIES = 200;
const KEEP_PICTURES = 300;
const MARGIN = 500; // how far beyond the window objects are drawn, so that scrolling finds them there

/** What is on the page for one object. */
interface Picture {
  element: HTMLElement;
  object: number;
  /** Made when it is first drawn. */
  canvas: HTMLCanvasElement | null;
  drawn: boolean;
}

/**
 * Draws shapes into elements with the shape's index as data-object, each into a canvas of its own, once: scrolling
 * moves finished pictures. Elements that come near the window are drawn, those in it first.
 */
export class TilePictures {
  together = true;
  /** False without WebGL: nothing is drawn. */
  readonly available: boolean;
  private readonly renderer = sharedRenderer();
  private readonly pace = this.renderer && new Pace(this.renderer.getContext() as WebGL2RenderingContext);
  private readonly camera = new PerspectiveCamera(27, 1, 0.1, 20);
  private readonly lit = litScene();
  private readonly pivot = new Group();
  private readonly body: ThreeMesh;
  private readonly material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide });
  private readonly geometries = new Map<number, BufferGeometry | null>();
  private readonly pictures = new Map<Element, Picture>();
  private readonly near = new Set<Picture>();
  private readonly observer: IntersectionObserver;
  private readonly resize: ResizeObserver;
  private readonly turns = new Map<number, Turn>();
  private shared: Turn = { ...START };
  private frame = 0;
  private scrolledAt = -Infinity;
  private width = 0; // of the host when its pictures were drawn

  constructor(
    private readonly host: HTMLElement,
    private readonly shapes: Shape[],
  ) {
    this.available = this.renderer !== null;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(0, -4.1, 1.75);
    this.camera.lookAt(0, 0, 0);
    this.lit.follow(this.camera);
    this.body = new ThreeMesh(undefined, this.material);
    this.pivot.add(this.body);
    this.lit.scene.add(this.pivot);
    host.classList.add("pictured");
    this.observer = new IntersectionObserver((entries) => this.moved(entries), { rootMargin: `${MARGIN}px 0px` });
    this.resize = new ResizeObserver(() => {
      if (this.width !== host.clientWidth) this.redraw();
      this.width = host.clientWidth;
    });
    this.resize.observe(host);
    this.restyle();
  }

  restyle(): void {
    this.material.color = cssColour("--clay");
    this.redraw();
  }

  /** The pictures now on the page. */
  watch(elements: HTMLElement[]): void {
    this.observer.disconnect();
    this.pictures.clear();
    this.near.clear();
    for (const element of elements) {
      this.pictures.set(element, { element, object: Number(element.dataset.object), canvas: null, drawn: false });
      this.observer.observe(element);
    }
    this.invalidate();
  }

  /** The page has been scrolled: what is drawn next must not hold it up. */
  scrolled(): void {
    this.scrolledAt = performance.now();
  }

  turn(object: number, yaw: number, pitch: number): void {
    const turn = this.together ? this.shared : this.turnOf(object);
    turn.yaw += yaw;
    turn.pitch = Math.min(1.4, Math.max(-1.4, turn.pitch + pitch));
    if (this.together) this.turns.clear();
    else this.turns.set(object, turn);
    this.redraw(this.together ? undefined : object);
  }

  resetTurns(): void {
    this.shared = { ...START };
    this.turns.clear();
    this.redraw();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.frame = -1; // no later call may ask for a frame
    this.observer.disconnect();
    this.resize.disconnect();
    for (const geometry of this.geometries.values()) geometry?.dispose();
    this.material.dispose();
  }

  private redraw(object?: number): void {
    for (const picture of this.pictures.values())
      if (object === undefined || picture.object === object) picture.drawn = false;
    this.invalidate();
  }

  private invalidate(): void {
    if (this.frame || !this.renderer) return;
    this.host.dataset.busy = "";
    this.frame = requestAnimationFrame((now) => {
      this.frame = 0;
      if (this.draw(now)) delete this.host.dataset.busy;
      else this.invalidate();
    });
  }

  private moved(entries: IntersectionObserverEntry[]): void {
    for (const { target, isIntersecting } of entries) {
      const picture = this.pictures.get(target)!;
      if (isIntersecting) this.near.add(picture);
      else this.near.delete(picture);
    }
    this.invalidate();
  }

  /** True when nothing is left to draw. */
  private draw(began: number): boolean {
    const scrolling = began - this.scrolledAt < REST_AFTER_MS;
    const budget = scrolling ? SCROLLING_MS : RESTING_MS;
    const start = performance.now();
    if (!this.pace!.ready(start, scrolling)) return false;
    const waiting = this.waiting();
    let left = waiting.length;
    for (const picture of waiting) {
      if (performance.now() - start > budget) break;
      const shape = this.shapes[picture.object];
      if (shape.mesh && !(hasArrived(shape.mesh.positions) && hasArrived(shape.mesh.indices))) continue;
      const geometry = this.geometry(picture.object);
      // Making the geometry may have taken all the time there is: then it is drawn in the next frame.
      if (geometry && scrolling && performance.now() - start > budget) break;
      if (geometry) this.paint(picture, geometry);
      picture.drawn = true;
      --left;
    }
    if (left < waiting.length) this.pace!.handed(start);
    return left === 0;
  }

  // Those that are to be drawn, the nearest to the window first.
  private waiting(): Picture[] {
    const missing = [...this.near].filter((picture) => !picture.drawn);
    if (missing.length < 2) return missing;
    const height = window.innerHeight;
    const away = (picture: Picture) => {
      const { top, bottom } = picture.element.getBoundingClientRect();
      return Math.max(0, top - height, -bottom);
    };
    const distances = new Map(missing.map((picture) => [picture, away(picture)]));
    return missing.sort((a, b) => distances.get(a)! - distances.get(b)!);
  }

  private paint(picture: Picture, geometry: BufferGeometry): void {
    const renderer = this.renderer!;
    const { clientWidth: width, clientHeight: height } = picture.element;
    if (width < 2 || height < 2) return;
    const ratio = pixelRatio();
    const source = renderer.domElement;
    if (source.width !== Math.floor(width * ratio) || source.height !== Math.floor(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height);
    }
    this.pose(picture.object, geometry, width / height);
    renderer.setClearColor(0x000000, 0);
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.render(this.lit.scene, this.camera);
    const canvas = (picture.canvas ??= this.canvasIn(picture));
    if (canvas.width !== source.width) canvas.width = source.width;
    if (canvas.height !== source.height) canvas.height = source.height;
    const context = canvas.getContext("2d")!;
    context.globalCompositeOperation = "copy";
    context.drawImage(source, 0, 0);
    firstObjectsDrawn();
  }

  private canvasIn({ element }: Picture): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-hidden", "true"); // what it shows is said by the element around it
    element.prepend(canvas);
    this.forget();
    return canvas;
  }

  // Pictures far from the window are drawn again when they come back.
  private forget(): void {
    const drawn = [...this.pictures.values()].filter((picture) => picture.canvas);
    if (drawn.length < KEEP_PICTURES) return;
    for (const picture of drawn) {
      if (this.near.has(picture)) continue;
      picture.canvas!.remove();
      picture.canvas = null;
      picture.drawn = false;
    }
  }

  private turnOf(object: number): Turn {
    return this.turns.get(object) ?? { ...this.shared };
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
    const mesh = meshOf(this.shapes[object]);
    const geometry = mesh ? shade(mesh).geometry : null;
    this.geometries.set(object, geometry);
    if (this.geometries.size > Math.max(KEEP_GEOMETRIES, 2 * this.near.size)) {
      const [oldest, unused] = this.geometries.entries().next().value!;
      unused?.dispose();
      this.geometries.delete(oldest);
    }
    return geometry;
  }
}
