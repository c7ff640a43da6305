import { bytesOf } from "./blob";
import type { Part } from "./report";

type Vec = [number, number, number];

/** A parallel-jaw grasp: contacts and width in mesh units, outward unit normals, approach from palm to fingertips. */
export interface Grasp {
  p1: Vec;
  p2: Vec;
  n1: Vec;
  n2: Vec;
  approach: Vec | null;
  quality: number;
  width: number;
}

const FLOATS = 17;

function decodeGrasps(part: Part | null | undefined): Grasp[] {
  if (!part) return [];
  const bytes = bytesOf(part);
  const view = new DataView(bytes.buffer);
  const grasps: Grasp[] = [];
  for (let g = 0; (g + 1) * FLOATS * 4 <= bytes.length; ++g) {
    const at = (k: number) => view.getFloat32((g * FLOATS + k) * 4, true);
    const vec = (k: number): Vec => [at(k), at(k + 1), at(k + 2)];
    const approach = vec(12);
    grasps.push({
      p1: vec(0),
      p2: vec(3),
      n1: vec(6),
      n2: vec(9),
      approach: Math.hypot(...approach) > 0.5 ? approach : null,
      quality: at(15),
      width: at(16),
    });
  }
  return grasps;
}

/** Grasps of a part, best quality first, as they are stored; none where they cannot be read (said on the console). */
export function graspsOf(part: Part | null | undefined): Grasp[] {
  try {
    return decodeGrasps(part);
  } catch (error) {
    console.warn("antigrasp: grasps cannot be decoded", error);
    return [];
  }
}
