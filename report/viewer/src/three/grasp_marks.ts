import {
  Color,
  ConeGeometry,
  CylinderGeometry,
  type BufferGeometry,
  DoubleSide,
  Group,
  InstancedMesh,
  type Material,
  Matrix4,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Quaternion,
  type Raycaster,
  SphereGeometry,
  Vector3,
} from "three";
import { qualityColour } from "../colours";
import type { Grasp } from "../data/grasps";

const UP = new Vector3(0, 1, 0);
const CYLINDER = new CylinderGeometry(1, 1, 1, 10);
const SPHERE = new SphereGeometry(1, 14, 10);
const CONE = new ConeGeometry(1, 1, 28, 1, true).rotateX(Math.PI).translate(0, 0.5, 0); // apex at the origin, opens along +y

/** How marks are scaled and coloured: the same for both sides of a pair. */
export interface MarkScale {
  /** Largest extent of the object, mesh units. */
  extent: number;
  /** Quality that is drawn green. */
  best: number;
  friction: number;
}

function stretched(origin: Vector3, direction: Vector3, radius: number, length: number): Matrix4 {
  return new Matrix4().compose(
    origin,
    new Quaternion().setFromUnitVectors(UP, direction),
    new Vector3(radius, length, radius),
  );
}

/** Axes, contacts and friction cones of the first `count` grasps. */
export class GraspMarks {
  readonly group = new Group();
  private axes: InstancedMesh | null = null;

  constructor(
    private readonly grasps: Grasp[],
    private readonly scale: MarkScale,
  ) {}

  /** Shows the best `count`; `chosen` is drawn thicker and with its cones, the others' cones only when asked for. */
  show(count: number, chosen: number, allCones: boolean): void {
    this.clear();
    const shown = this.grasps.slice(0, count).map((grasp, i) => ({ grasp, chosen: i === chosen }));
    if (chosen >= count && this.grasps[chosen]) shown.push({ grasp: this.grasps[chosen], chosen: true });
    if (!shown.length) return;
    const { extent } = this.scale;
    const axisOf = (g: Grasp) => new Vector3(...g.p2).sub(new Vector3(...g.p1));
    this.axes = this.add(CYLINDER, new MeshStandardMaterial({ roughness: 0.5 }), shown, (g, isChosen) => {
      const axis = axisOf(g);
      const length = axis.length() + 0.3 * extent; // sticks out on both sides, as in Fig. 1
      const middle = new Vector3(...g.p1).add(new Vector3(...g.p2)).multiplyScalar(0.5);
      return [stretched(middle, axis.normalize(), extent * (isChosen ? 0.011 : 0.0055), length)];
    });
    this.add(SPHERE, new MeshStandardMaterial({ roughness: 0.4 }), shown, (g, isChosen) =>
      [g.p1, g.p2].map((p) => new Matrix4().makeScale(...ball(extent * (isChosen ? 0.019 : 0.012))).setPosition(...p)),
    );
    const cones = shown.filter((s) => allCones || s.chosen);
    const length = 0.16 * extent;
    this.add(
      CONE,
      new MeshBasicMaterial({ transparent: true, opacity: 0.38, side: DoubleSide, depthWrite: false }),
      cones,
      (g) =>
        [
          [g.p1, g.n1],
          [g.p2, g.n2],
        ].map(([p, n]) =>
          stretched(new Vector3(...p), new Vector3(...n).normalize(), length * this.scale.friction, length),
        ),
    );
  }

  /** Rank of the grasp whose axis the ray hits first, null: none. */
  pick(ray: Raycaster): number | null {
    const hit = this.axes ? ray.intersectObject(this.axes)[0] : undefined;
    return hit?.instanceId ?? null;
  }

  clear(): void {
    for (const child of [...this.group.children] as InstancedMesh[]) {
      (child.material as Material).dispose();
      child.dispose();
    }
    this.group.clear();
    this.axes = null;
  }

  private add(
    geometry: BufferGeometry,
    material: Material,
    marks: { grasp: Grasp; chosen: boolean }[],
    place: (grasp: Grasp, chosen: boolean) => Matrix4[],
  ): InstancedMesh {
    const placed = marks.flatMap(({ grasp, chosen }) => place(grasp, chosen).map((matrix) => ({ matrix, grasp })));
    const mesh = new InstancedMesh(geometry, material, placed.length);
    placed.forEach(({ matrix, grasp }, i) => {
      mesh.setMatrixAt(i, matrix);
      mesh.setColorAt(i, new Color(qualityColour(this.scale.best > 0 ? grasp.quality / this.scale.best : 0)));
    });
    this.group.add(mesh);
    return mesh;
  }
}

function ball(radius: number): [number, number, number] {
  return [radius, radius, radius];
}
