import type { Mesh } from "./mesh";
import type { ObjectRecord } from "./report";

export interface StlPlan {
  /** Millimetres per mesh unit. */
  scale: number;
  /** Rows of the rotation to the suggested pose, null: as the object is stored. */
  pose: number[][] | null;
}

/** The size and pose in which an object would be printed; the size of the measurement when no other is known. */
export function stlPlan(object: ObjectRecord, mesh: Mesh): StlPlan {
  const pose =
    object.print?.pose?.length === 3 && object.print.pose.every((row) => row.length === 3) ? object.print.pose : null;
  const size = object.print?.size_mm;
  const largest = size ? Math.max(...size) : 0;
  const extent = Math.max(...[0, 1, 2].map((k) => mesh.max[k] - mesh.min[k]));
  const scale = largest > 0 && extent > 0 ? largest / extent : 1000 * object.metres_per_unit;
  return { scale: Number.isFinite(scale) && scale > 0 ? scale : 1, pose };
}

/** Binary STL in millimetres, standing on z = 0 in the middle of the plate. */
export function writeStl(mesh: Mesh, plan: StlPlan): ArrayBuffer {
  const points = placed(mesh, plan);
  const triangles = mesh.indices.length / 3;
  const buffer = new ArrayBuffer(84 + 50 * triangles);
  const view = new DataView(buffer);
  // "solid" at the start would mean text.
  new Uint8Array(buffer, 0, 80).set(new TextEncoder().encode("antigrasp, millimetres"));
  view.setUint32(80, triangles, true);
  for (let t = 0; t < triangles; ++t) {
    const at = 84 + 50 * t;
    const corner = [0, 1, 2].map((k) => 3 * mesh.indices[3 * t + k]);
    const edge = (to: number, k: number) => points[corner[to] + k] - points[corner[0] + k];
    const normal = [0, 1, 2].map(
      (k) => edge(1, (k + 1) % 3) * edge(2, (k + 2) % 3) - edge(1, (k + 2) % 3) * edge(2, (k + 1) % 3),
    );
    const length = Math.hypot(...normal) || 1;
    normal.forEach((value, k) => view.setFloat32(at + 4 * k, value / length, true));
    corner.forEach((c, i) => {
      for (let k = 0; k < 3; ++k) view.setFloat32(at + 12 + 12 * i + 4 * k, points[c + k], true);
    });
  }
  return buffer;
}

function placed(mesh: Mesh, { scale, pose }: StlPlan): Float64Array {
  const points = new Float64Array(mesh.positions.length);
  const min = [Infinity, Infinity, Infinity],
    max = [-Infinity, -Infinity, -Infinity];
  for (let v = 0; v < points.length; v += 3) {
    const p = [mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]];
    for (let k = 0; k < 3; ++k) {
      const value = scale * (pose ? pose[k][0] * p[0] + pose[k][1] * p[1] + pose[k][2] * p[2] : p[k]);
      points[v + k] = value;
      min[k] = Math.min(min[k], value);
      max[k] = Math.max(max[k], value);
    }
  }
  const shift = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, min[2]];
  for (let v = 0; v < points.length; ++v) points[v] -= shift[v % 3];
  return points;
}
