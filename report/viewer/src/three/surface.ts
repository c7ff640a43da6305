import { type Camera, type Scene, SRGBColorSpace, WebGLRenderer } from "three";
import { firstObjectsDrawn } from "../early";

/** One picture inside the canvas: where it belongs on the page, and what it shows. */
export interface View {
  element: HTMLElement;
  scene: Scene;
  camera: Camera;
  /** Called just before the view is drawn: sets what views share, a mesh or the camera's aspect. */
  prepare?: (width: number, height: number) => void;
}

export const NO_WEBGL =
  "This browser offers no WebGL, so the objects cannot be drawn in 3D. Charts and tables work without it. Switch hardware acceleration on, or open the report in another browser.";

// Browsers allow a page few WebGL contexts, and a new one compiles every shader again: all pages share this one.
let renderer: WebGLRenderer | null | undefined;

/** null without WebGL. Its canvas lies where its last user put it. */
export function sharedRenderer(): WebGLRenderer | null {
  if (renderer !== undefined) return renderer;
  try {
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("webgl2", { antialias: true, alpha: true });
    renderer = context ? new WebGLRenderer({ canvas, context, antialias: true, alpha: true }) : null;
  } catch {
    renderer = null;
  }
  if (renderer) {
    renderer.outputColorSpace = SRGBColorSpace;
    renderer.setScissorTest(true);
    renderer.domElement.className = "surface";
    renderer.domElement.setAttribute("aria-hidden", "true"); // what it shows is said by the elements it lies over
  }
  return renderer;
}

/** Canvas pixels a CSS pixel. */
export function pixelRatio(): number {
  return Math.min(window.devicePixelRatio || 1, 2);
}

/**
 * The shared canvas laid over `host`: draws every view into the rectangle of its element. Nothing is drawn until
 * invalidate() asks for a frame, so that a still page costs nothing.
 */
export class Surface {
  readonly canvas: HTMLCanvasElement;
  private frame = 0;
  private readonly renderer: WebGLRenderer;
  private readonly resize: ResizeObserver;

  private constructor(
    renderer: WebGLRenderer,
    private readonly host: HTMLElement,
    private readonly views: () => Iterable<View>,
  ) {
    this.renderer = renderer;
    this.canvas = renderer.domElement;
    host.append(this.canvas);
    this.resize = new ResizeObserver(() => this.invalidate());
    this.resize.observe(host);
  }

  /** null without WebGL. */
  static over(host: HTMLElement, views: () => Iterable<View>): Surface | null {
    const shared = sharedRenderer();
    return shared && new Surface(shared, host, views);
  }

  invalidate(): void {
    if (this.frame) return;
    this.canvas.dataset.busy = "";
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
      if (!this.frame) delete this.canvas.dataset.busy; // drawing may have asked for another frame
    });
  }

  draw(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    const ratio = pixelRatio();
    const w = Math.round(width * ratio),
      hgt = Math.round(height * ratio);
    if (this.canvas.width !== w || this.canvas.height !== hgt) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height);
    }
    const base = this.canvas.getBoundingClientRect();
    this.renderer.setClearColor(0x000000, 0);
    this.renderer.setScissor(0, 0, width, height);
    this.renderer.clear();
    let drawn = 0;
    for (const view of this.views()) {
      const box = view.element.getBoundingClientRect();
      if (box.width < 2 || box.height < 2) continue;
      const left = box.left - base.left;
      const bottom = base.bottom - box.bottom;
      if (left + box.width <= 0 || left >= width || bottom + box.height <= 0 || bottom >= height) continue;
      view.prepare?.(box.width, box.height);
      this.renderer.setViewport(left, bottom, box.width, box.height);
      this.renderer.setScissor(left, bottom, box.width, box.height);
      this.renderer.render(view.scene, view.camera);
      ++drawn;
    }
    if (drawn) firstObjectsDrawn();
  }

  /** The canvas as PNG. Drawn in the same turn, because a canvas forgets its picture once it has been shown. */
  png(): Promise<Blob | null> {
    this.draw();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.frame = -1; // no later call may ask for a frame
    this.resize.disconnect();
    this.canvas.remove();
  }
}
