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

const COLUMNS = 16,
  RANGES = 8 * COLUMNS, // bytes: low and high of every column
  GRASP = 4 + 2 * COLUMNS;

function decodeGrasps(part: Part | null | undefined): Grasp[] {
  if (!part) return [];
  const bytes = bytesOf(part);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const count = Math.max(0, Math.floor((bytes.length - RANGES) / GRASP));
  const ranges = 4 * count,
    columns = ranges + RANGES;
  const at = (k: number, g: number) => {
    const low = view.getFloat32(ranges + 8 * k, true),
      high = view.getFloat32(ranges + 8 * k + 4, true);
    return low + (view.getUint16(columns + 2 * (k * count + g), true) / 65535) * (high - low);
  };
  return Array.from({ length: count }, (_, g) => {
    const vec = (k: number): Vec => [at(k, g), at(k + 1, g), at(k + 2, g)];
    const approach = vec(12);
    return {
      p1: vec(0),
      p2: vec(3),
      n1: vec(6),
      n2: vec(9),
      approach: Math.hypot(...approach) > 0.5 ? approach : null,
      quality: view.getFloat32(4 * g, true),
      width: at(15, g),
    };
  });
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
