import { MeshoptDecoder } from "meshoptimizer/decoder";
import { bytesOf } from "./blob";
import type { MeshRecord, Shape } from "./report";

/** A triangle mesh in the units of its record, counter-clockwise from outside. */
export interface Mesh {
  positions: Float32Array;
  indices: Uint32Array;
  min: [number, number, number];
  max: [number, number, number];
}

/** Resolves when meshes can be decoded; rejects where the browser has no WebAssembly. */
export const decoderReady: Promise<void> = MeshoptDecoder.supported
  ? MeshoptDecoder.ready
  : Promise.reject(new Error("This browser has no WebAssembly, in which the objects are decoded."));
decoderReady.catch(() => undefined); // asked for later, by whoever shows an object

/** Throws when the bytes are not what the record says. */
export function decodeMesh(record: MeshRecord): Mesh {
  const packed = new Uint8Array(record.vertices * 8);
  MeshoptDecoder.decodeVertexBuffer(packed, record.vertices, 8, bytesOf(record.positions));
  const quantised = new Uint16Array(packed.buffer);
  const positions = new Float32Array(record.vertices * 3);
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const step = record.extent / 65535;
  for (let v = 0; v < record.vertices; ++v) {
    for (let k = 0; k < 3; ++k) {
      const value = record.min[k] + quantised[4 * v + k] * step;
      positions[3 * v + k] = value;
      if (value < min[k]) min[k] = value;
      if (value > max[k]) max[k] = value;
    }
  }
  const indexBytes = new Uint8Array(record.triangles * 12);
  MeshoptDecoder.decodeIndexBuffer(indexBytes, record.triangles * 3, 4, bytesOf(record.indices));
  const indices = new Uint32Array(indexBytes.buffer);
  for (const index of indices)
    if (index >= record.vertices) throw new RangeError("a triangle names a vertex that does not exist");
  return { positions, indices, min, max };
}

// The last few meshes stay decoded: the object page asks for the same one for shading, sections and downloads.
const recent = new Map<MeshRecord, Mesh>();
const KEEP = 8;

/** The mesh of a shape, null when it has none or cannot be decoded (said on the console). */
export function meshOf(shape: Shape): Mesh | null {
  if (!shape.mesh || shape.mesh.triangles === 0) return null;
  const known = recent.get(shape.mesh);
  if (known) return known;
  try {
    const mesh = decodeMesh(shape.mesh);
    recent.set(shape.mesh, mesh);
    if (recent.size > KEEP) recent.delete(recent.keys().next().value!);
    return mesh;
  } catch (error) {
    console.warn("antigrasp: a mesh cannot be decoded", error);
    return null;
  }
}
