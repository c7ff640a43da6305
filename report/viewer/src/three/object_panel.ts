import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  type Group,
  LineBasicMaterial,
  LineSegments,
  Mesh as ThreeMesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type PerspectiveCamera,
  PlaneGeometry,
  Raycaster,
  Vector2,
} from "three";
import { heatRgb } from "../colours";
import { bytesOf } from "../data/blob";
import type { Grasp } from "../data/grasps";
import type { Mesh } from "../data/mesh";
import type { Gripper, Part, Shape } from "../data/report";
import { type Axis, type Outline, PLANE_AXES } from "../data/section";
import { shade, type Shaded } from "./geometry";
import { GraspMarks, type MarkScale } from "./grasp_marks";
import { gripperOn } from "./gripper";
import { cssColour, litScene } from "./scene";
import type { View } from "./surface";

/** One solid with its grasps, gripper and cutting plane: half of a pair, or all there is. */
export class ObjectPanel implements View {
  private readonly lit = litScene();
  readonly scene = this.lit.scene;
  private readonly material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide });
  private readonly shaded: Shaded;
  private readonly marks: GraspMarks;
  private readonly plane: ThreeMesh;
  private readonly cut = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));
  private gripper: Group | null = null;

  constructor(
    readonly element: HTMLElement,
    readonly camera: PerspectiveCamera,
    readonly shape: Shape,
    readonly mesh: Mesh,
    readonly grasps: Grasp[],
    scale: MarkScale,
  ) {
    const { extent } = scale;
    this.shaded = shade(mesh);
    this.marks = new GraspMarks(grasps, scale);
    this.plane = new ThreeMesh(
      new PlaneGeometry(1.3 * extent, 1.3 * extent),
      new MeshBasicMaterial({ transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false }),
    );
    this.plane.visible = this.cut.visible = false;
    this.cut.renderOrder = 2;
    this.scene.add(new ThreeMesh(this.shaded.geometry, this.material), this.marks.group, this.plane, this.cut);
    this.restyle();
  }

  prepare(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.lit.follow(this.camera);
  }

  restyle(): void {
    this.material.color = this.material.vertexColors ? new Color(0xffffff) : cssColour("--clay");
    (this.plane.material as MeshBasicMaterial).color = cssColour("--accent");
    (this.cut.material as LineBasicMaterial).color = cssColour("--ink");
  }

  showGrasps(count: number, chosen: number, cones: boolean, gripper: Gripper | null): void {
    this.marks.show(count, chosen, cones);
    if (this.gripper) this.scene.remove(this.gripper);
    const grasp = this.grasps[chosen];
    this.gripper = gripper && grasp ? gripperOn(grasp, gripper, this.shape.metres_per_unit) : null;
    if (this.gripper) this.scene.add(this.gripper);
  }

  /** Colours the surface by displacement (a byte per vertex of the mesh as stored); null: plain again. */
  showHeat(part: Part | null): void {
    const geometry = this.shaded.geometry;
    if (part && !geometry.getAttribute("color")) {
      const bytes = bytesOf(part);
      const colours = new Float32Array(this.shaded.source.length * 3);
      const colour = new Color();
      this.shaded.source.forEach((v, i) => {
        const [r, g, b] = heatRgb(bytes[v] / 255);
        colour.setRGB(r / 255, g / 255, b / 255, "srgb").toArray(colours, 3 * i);
      });
      geometry.setAttribute("color", new BufferAttribute(colours, 3));
    }
    this.material.vertexColors = part !== null;
    this.material.needsUpdate = true;
    this.restyle();
  }

  showTranslucent(on: boolean): void {
    this.material.transparent = on;
    this.material.opacity = on ? 0.4 : 1;
    this.material.depthWrite = !on;
    this.material.needsUpdate = true;
  }

  /** The cutting plane with the outline on it; null hides both. */
  showCut(cut: { axis: Axis; at: number; pieces: Outline; centre: [number, number, number] } | null): void {
    this.plane.visible = this.cut.visible = cut !== null;
    if (!cut) return;
    const [u, v] = PLANE_AXES[cut.axis];
    this.plane.position.set(...cut.centre).setComponent(cut.axis, cut.at);
    this.plane.rotation.set(cut.axis === 1 ? Math.PI / 2 : 0, cut.axis === 0 ? Math.PI / 2 : 0, 0);
    const points = new Float32Array((cut.pieces.length / 2) * 3);
    for (let i = 0; i < cut.pieces.length / 2; ++i) {
      points[3 * i + u] = cut.pieces[2 * i];
      points[3 * i + v] = cut.pieces[2 * i + 1];
      points[3 * i + cut.axis] = cut.at;
    }
    this.cut.geometry.dispose();
    this.cut.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
  }

  covers(clientX: number, clientY: number): boolean {
    const box = this.element.getBoundingClientRect();
    return clientX >= box.left && clientX < box.right && clientY >= box.top && clientY < box.bottom;
  }

  /** Rank of the grasp under a point of the window. */
  pick(clientX: number, clientY: number): number | null {
    const box = this.element.getBoundingClientRect();
    const ray = new Raycaster();
    this.prepare(box.width, box.height);
    ray.setFromCamera(
      new Vector2((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height),
      this.camera,
    );
    return this.marks.pick(ray);
  }

  dispose(): void {
    this.shaded.geometry.dispose();
    this.material.dispose();
    this.marks.clear();
    this.plane.geometry.dispose();
    this.cut.geometry.dispose();
  }
}
