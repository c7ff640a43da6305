import { BufferAttribute, BufferGeometry } from "three";
import type { Mesh } from "../data/mesh";

// Edges sharper than this stay sharp; everything else is shaded smooth. Marching cubes chamfers the edges of a solid
// over one or two triangles, so that an angle near 90 degrees never occurs in one step.
const CREASE_DEGREES = 55;
const LIMIT = Math.cos((CREASE_DEGREES * Math.PI) / 180);
const HALF_LIMIT = Math.cos((CREASE_DEGREES * Math.PI) / 360);

/** Geometry to draw, and for each of its vertices the mesh's vertex it came from. */
export interface Shaded {
  geometry: BufferGeometry;
  source: Uint32Array;
}

function faceNormals(mesh: Mesh): { unit: Float32Array; area: Float32Array } {
  const { positions: p, indices } = mesh;
  const faces = indices.length / 3;
  const unit = new Float32Array(faces * 3);
  const area = new Float32Array(faces);
  for (let f = 0; f < faces; ++f) {
    const a = 3 * indices[3 * f],
      b = 3 * indices[3 * f + 1],
      c = 3 * indices[3 * f + 2];
    const ux = p[b] - p[a],
      uy = p[b + 1] - p[a + 1],
      uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a],
      vy = p[c + 1] - p[a + 1],
      vz = p[c + 2] - p[a + 2];
    const nx = uy * vz - uz * vy,
      ny = uz * vx - ux * vz,
      nz = ux * vy - uy * vx;
    const length = Math.sqrt(nx * nx + ny * ny + nz * nz); // Math.hypot takes ten times as long
    area[f] = length;
    const scale = length > 0 ? 1 / length : 0;
    unit[3 * f] = nx * scale;
    unit[3 * f + 1] = ny * scale;
    unit[3 * f + 2] = nz * scale;
  }
  return { unit, area };
}

/** The faces around every vertex, one after the other: those of v are corners[start[v]] ... corners[start[v + 1] - 1]. */
function cornersByVertex(mesh: Mesh): { start: Uint32Array; corners: Uint32Array } {
  const vertices = mesh.positions.length / 3;
  const start = new Uint32Array(vertices + 1);
  for (const v of mesh.indices) ++start[v + 1];
  for (let v = 0; v < vertices; ++v) start[v + 1] += start[v];
  const fill = start.slice();
  const corners = new Uint32Array(mesh.indices.length);
  for (let c = 0; c < mesh.indices.length; ++c) corners[fill[mesh.indices[c]]++] = c;
  return { start, corners };
}

// True when all faces around a vertex lie within half the crease angle of one direction, so that none of them turns
// by more than the crease angle against another: nearly every vertex.
function isSmooth(faces: Uint32Array, from: number, to: number, unit: Float32Array, [x, y, z]: number[]): boolean {
  for (let i = from; i < to; ++i) {
    const f = 3 * faces[i];
    if (unit[f] * x + unit[f + 1] * y + unit[f + 2] * z < HALF_LIMIT) return false;
  }
  return true;
}

/**
 * Normals that are smooth except across creases. A corner's normal is the sum of its vertex' faces that turn by less
 * than the crease angle, weighted by area; a vertex is split only where its corners disagree, so that most stay shared.
 */
export function shade(mesh: Mesh): Shaded {
  const { unit, area } = faceNormals(mesh);
  const { start, corners } = cornersByVertex(mesh);
  const faces = corners.map((corner) => Math.floor(corner / 3));
  const most = mesh.indices.length; // copies: no more than corners
  const positions = new Float32Array(3 * most);
  const normals = new Float32Array(3 * most);
  const source = new Uint32Array(most);
  const index = new Uint32Array(most);
  let count = 0;
  const sum = [0, 0, 0];
  // Unit sum of the normals, by area, of the faces that turn by less than the crease angle against `face`; -1: of all.
  const normalOf = (from: number, to: number, face: number): void => {
    let nx = 0,
      ny = 0,
      nz = 0;
    for (let i = from; i < to; ++i) {
      const g = faces[i];
      const x = unit[3 * g],
        y = unit[3 * g + 1],
        z = unit[3 * g + 2];
      if (face >= 0 && g !== face && unit[3 * face] * x + unit[3 * face + 1] * y + unit[3 * face + 2] * z < LIMIT)
        continue;
      nx += area[g] * x;
      ny += area[g] * y;
      nz += area[g] * z;
    }
    const scale = 1 / (Math.sqrt(nx * nx + ny * ny + nz * nz) || 1);
    sum[0] = nx * scale;
    sum[1] = ny * scale;
    sum[2] = nz * scale;
  };
  // The copy of vertex v with this normal: one of those since `first`, or a new one.
  const copyOf = (v: number, first: number): number => {
    const [x, y, z] = sum;
    for (let i = first; i < count; ++i)
      if (x * normals[3 * i] + y * normals[3 * i + 1] + z * normals[3 * i + 2] >= 0.9999) return i;
    source[count] = v;
    for (let k = 0; k < 3; ++k) {
      positions[3 * count + k] = mesh.positions[3 * v + k];
      normals[3 * count + k] = sum[k];
    }
    return count++;
  };
  for (let v = 0; v + 1 < start.length; ++v) {
    const first = count;
    const from = start[v],
      to = start[v + 1];
    normalOf(from, to, -1);
    const smooth = isSmooth(faces, from, to, unit, sum);
    for (let i = from; i < to; ++i) {
      if (!smooth) normalOf(from, to, faces[i]);
      index[corners[i]] = smooth && i > from ? first : copyOf(v, first);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions.slice(0, 3 * count), 3));
  geometry.setAttribute("normal", new BufferAttribute(normals.slice(0, 3 * count), 3));
  geometry.setIndex(new BufferAttribute(count < 65536 ? new Uint16Array(index) : index, 1));
  geometry.computeBoundingSphere();
  return { geometry, source: source.slice(0, count) };
}
