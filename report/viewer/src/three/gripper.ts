import {
  BoxGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Vector3,
} from "three";
import type { Grasp } from "../data/grasps";
import type { Gripper } from "../data/report";

// Seen through, because a gripper hides most of what it holds; edges keep its shape readable.
const glass = (opacity: number) =>
  new MeshStandardMaterial({ color: 0x6f8296, roughness: 0.6, transparent: true, opacity, depthWrite: false });
const FINGERS = glass(0.55);
const PALM = glass(0.22);
const EDGES = new LineBasicMaterial({ color: 0x5b6c7d, transparent: true, opacity: 0.9 });

function box(x: [number, number], y: [number, number], z: [number, number], material: MeshStandardMaterial): Mesh {
  const geometry = new BoxGeometry(x[1] - x[0], y[1] - y[0], z[1] - z[0]);
  const mesh = new Mesh(geometry, material);
  mesh.add(new LineSegments(new EdgesGeometry(geometry), EDGES));
  mesh.position.set((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, (z[0] + z[1]) / 2);
  return mesh;
}

/**
 * The gripper closed on a grasp, mesh units; null when the grasp's approach is unknown. Frame as in
 * quality/gripper.h: origin at the grasp's centre, x the approach, y from contact 1 to contact 2.
 */
export function gripperOn(grasp: Grasp, gripper: Gripper, metresPerUnit: number): Group | null {
  if (!grasp.approach || !(metresPerUnit > 0)) return null;
  const g = gripper;
  const w = (grasp.width * metresPerUnit) / 2;
  const group = new Group();
  const reach: [number, number] = [-g.palm_distance, g.fingertip_overlap];
  const across: [number, number] = [-g.finger_width / 2, g.finger_width / 2];
  group.add(
    box(reach, [w, w + g.finger_thickness], across, FINGERS),
    box(reach, [-w - g.finger_thickness, -w], across, FINGERS),
    box(
      [-g.palm_distance - g.palm_depth, -g.palm_distance],
      [-g.palm_length / 2, g.palm_length / 2],
      [-g.palm_width / 2, g.palm_width / 2],
      PALM,
    ),
  );
  const x = new Vector3(...grasp.approach).normalize();
  const p1 = new Vector3(...grasp.p1),
    p2 = new Vector3(...grasp.p2);
  const y = p2.clone().sub(p1);
  y.addScaledVector(x, -y.dot(x)).normalize(); // the stored approach is perpendicular up to rounding
  const frame = new Matrix4().makeBasis(x, y, x.clone().cross(y)).setPosition(p1.add(p2).multiplyScalar(0.5));
  frame.scale(new Vector3().setScalar(1 / metresPerUnit));
  group.matrixAutoUpdate = false;
  group.matrix.copy(frame);
  return group;
}
