import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  EdgesGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh as ThreeMesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import type { Mesh } from "../data/mesh";
import { type Moment, momentAt, type Frame, type Replay, type Tip } from "../data/trials";
import { shade, type Shaded } from "./geometry";
import { cssColour, litScene } from "./scene";
import type { View } from "./surface";

const UP = new Vector3(0, 1, 0);
const MOST_FORCES = 32; // two tips with 8 contacts at most, a table with 6
const LARGEST_ARROW = 0.03; // metres

function tipGeometry(tip: Tip): BufferGeometry {
  if (tip.kind === "sphere") return new SphereGeometry(tip.radius, 32, 20);
  return new BoxGeometry(...(tip.half.map((x) => 2 * x) as [number, number, number]));
}

function largestForce(frames: Frame[]): number {
  const sizes = frames.flatMap(({ forces }) => forces.map(([, , , x, y, z]) => Math.hypot(x, y, z)));
  return sizes.reduce((a, b) => Math.max(a, b), 0);
}

/** One execution: the object between two fingertips, the table, forces as arrows. Metres, the gripper's frame. */
export class ReplayPanel implements View {
  private readonly lit = litScene();
  readonly scene = this.lit.scene;
  private readonly clay = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide });
  private readonly glass = new MeshStandardMaterial({
    color: 0x6f8296,
    roughness: 0.6,
    transparent: true,
    opacity: 0.6,
    depthWrite: false,
  });
  private readonly ground = new MeshBasicMaterial({
    transparent: true,
    opacity: 0.28,
    side: DoubleSide,
    depthWrite: false,
  });
  // Forces are seen through the object and the fingertips: most of an arrow lies inside one of them.
  private readonly ink = new MeshBasicMaterial({ depthTest: false, transparent: true });
  private readonly shaded: Shaded;
  private readonly object = new Group();
  private readonly tips: [Group, Group];
  private readonly table: ThreeMesh;
  private readonly shafts: InstancedMesh;
  private readonly heads: InstancedMesh;
  private readonly arrow: number; // metres a newton
  private withForces = true;

  constructor(
    readonly element: HTMLElement,
    readonly camera: PerspectiveCamera,
    mesh: Mesh,
    readonly replay: Replay,
    readonly frames: Frame[],
  ) {
    this.shaded = shade(mesh);
    const body = new ThreeMesh(this.shaded.geometry, this.clay);
    body.scale.setScalar(replay.metres_per_unit);
    this.object.add(body);
    const tip = tipGeometry(replay.tip);
    const edges = new EdgesGeometry(tip, 40);
    const make = () =>
      new Group().add(
        new ThreeMesh(tip, this.glass),
        new LineSegments(edges, new LineBasicMaterial({ color: 0x5b6c7d })),
      );
    this.tips = [make(), make()];
    this.table = new ThreeMesh(new PlaneGeometry(0.16, 0.16), this.ground);
    this.table.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...replay.up).normalize());
    this.shafts = new InstancedMesh(new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0), this.ink, MOST_FORCES);
    this.heads = new InstancedMesh(new ConeGeometry(1, 1, 16).translate(0, -0.5, 0), this.ink, MOST_FORCES);
    this.shafts.frustumCulled = this.heads.frustumCulled = false;
    this.shafts.renderOrder = this.heads.renderOrder = 2;
    const largest = largestForce(frames);
    this.arrow = largest > 0 ? LARGEST_ARROW / largest : 0;
    this.scene.add(this.object, ...this.tips, this.table, this.shafts, this.heads);
    this.restyle();
  }

  prepare(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.lit.follow(this.camera);
  }

  restyle(): void {
    this.clay.color = cssColour("--clay");
    this.ground.color = new Color(cssColour("--accent"));
    this.ink.color = cssColour("--control");
  }

  showForces(on: boolean): void {
    this.withForces = on;
  }

  /** Moves everything to where it is at this time, seconds; says what is there. */
  show(t: number): Moment {
    const moment = momentAt(this.frames, t);
    this.object.position.copy(moment.position);
    this.object.quaternion.copy(moment.rotation);
    this.tips.forEach((tip, i) => tip.position.copy(moment.tips[i]));
    this.table.visible = moment.table !== null;
    if (moment.table !== null) {
      // Under the object, wherever that is along the plane.
      const up = new Vector3(...this.replay.up).normalize();
      this.table.position.copy(moment.position).addScaledVector(up, moment.table - moment.position.dot(up));
    }
    this.showArrows(this.withForces ? moment.forces : []);
    return moment;
  }

  private showArrows(forces: number[][]): void {
    const count = Math.min(MOST_FORCES, forces.length);
    this.shafts.count = this.heads.count = count;
    forces.slice(0, count).forEach(([px, py, pz, fx, fy, fz], i) => {
      const force = new Vector3(fx, fy, fz);
      const length = force.length() * this.arrow;
      const direction = length > 0 ? force.normalize() : UP;
      const turn = new Quaternion().setFromUnitVectors(UP, direction);
      // A force pushes: its head is at the contact.
      const head = new Vector3(px, py, pz);
      const tail = head.clone().addScaledVector(direction, -length);
      const width = 0.0006;
      this.shafts.setMatrixAt(i, new Matrix4().compose(tail, turn, new Vector3(width, length, width)));
      const cone = Math.min(0.005, Math.max(0.4 * length, 1e-5));
      this.heads.setMatrixAt(i, new Matrix4().compose(head, turn, new Vector3(0.35 * cone, cone, 0.35 * cone)));
    });
    this.shafts.instanceMatrix.needsUpdate = this.heads.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.shaded.geometry.dispose();
    for (const material of [this.clay, this.glass, this.ground, this.ink]) material.dispose();
    this.table.geometry.dispose();
    for (const arrows of [this.shafts, this.heads]) {
      arrows.geometry.dispose();
      arrows.dispose();
    }
  }
}
