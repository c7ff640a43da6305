import { BufferAttribute, BufferGeometry } from "three";
import type { Mesh } from "../data/mesh";

// Edges sharper than this stay sharp; everything else is shaded smooth. Marching cubes chamfers the edges of a solid
// over one or two triangles, so that an angle near 90 degrees never occurs in one step.
const CREASE_DEGREES = 55;

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
    const length = Math.hypot(nx, ny, nz);
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

/**
 * Normals that are smooth except across creases. A corner's normal is the sum of its vertex' faces that turn by less
 * than the crease angle, weighted by area; a vertex is split only where its corners disagree, so that most stay shared.
 */
export function shade(mesh: Mesh): Shaded {
  const limit = Math.cos((CREASE_DEGREES * Math.PI) / 180);
  const { unit, area } = faceNormals(mesh);
  const { start, corners } = cornersByVertex(mesh);
  const positions: number[] = [];
  const normals: number[] = [];
  const source: number[] = [];
  const index = new Uint32Array(mesh.indices.length);
  for (let v = 0; v + 1 < start.length; ++v) {
    const firstCopy = source.length;
    for (let i = start[v]; i < start[v + 1]; ++i) {
      const f = Math.floor(corners[i] / 3);
      let nx = 0,
        ny = 0,
        nz = 0;
      for (let j = start[v]; j < start[v + 1]; ++j) {
        const g = Math.floor(corners[j] / 3);
        const cosine =
          unit[3 * f] * unit[3 * g] + unit[3 * f + 1] * unit[3 * g + 1] + unit[3 * f + 2] * unit[3 * g + 2];
        if (g !== f && cosine < limit) continue;
        nx += area[g] * unit[3 * g];
        ny += area[g] * unit[3 * g + 1];
        nz += area[g] * unit[3 * g + 2];
      }
      const scale = 1 / (Math.hypot(nx, ny, nz) || 1);
      nx *= scale;
      ny *= scale;
      nz *= scale;
      let copy = firstCopy;
      while (
        copy < source.length &&
        nx * normals[3 * copy] + ny * normals[3 * copy + 1] + nz * normals[3 * copy + 2] < 0.9999
      )
        ++copy;
      if (copy === source.length) {
        source.push(v);
        positions.push(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]);
        normals.push(nx, ny, nz);
      }
      index[corners[i]] = copy;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeBoundingSphere();
  return { geometry, source: new Uint32Array(source) };
}
