import { BufferAttribute, BufferGeometry, Vector3 } from "three";
import { type HitPointInfo, MeshBVH } from "three-mesh-bvh";
import type { Mesh } from "./mesh";

/** 0, 1, 2: the plane is perpendicular to x, y or z. The plane's own axes are the other two, in this order. */
export type Axis = 0 | 1 | 2;
export const PLANE_AXES: Record<Axis, [number, number]> = { 0: [1, 2], 1: [0, 2], 2: [0, 1] };

/** Where the surface crosses a plane: four numbers per piece, u0 v0 u1 v1, mesh units, the solid to its left. */
export type Outline = Float64Array;

/** Signed distances on a square grid in the plane, positive inside (equation V.1), mesh units; row by row, v upwards. */
export interface DistanceGrid {
  size: number;
  values: Float64Array;
  low: [number, number];
  high: [number, number];
}

/** The distance tree of a mesh: built once, asked for every section. */
export function distanceTree(mesh: Mesh): MeshBVH {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new BufferAttribute(mesh.indices.slice(), 1)); // the tree sorts its index in place
  return new MeshBVH(geometry);
}

/** The outline of the mesh in the plane. A vertex on the plane counts as above it, so that outlines always close. */
export function outline(mesh: Mesh, axis: Axis, at: number): Outline {
  const { positions: p, indices } = mesh;
  const [u, v] = PLANE_AXES[axis];
  // u, v and the plane's axis are a left-handed frame for y, which would put the solid to the right.
  const turn = axis === 1 ? -1 : 1;
  const pieces: number[] = [];
  const cross = (below: number, above: number) => {
    const a = 3 * below,
      b = 3 * above;
    const t = (at - p[a + axis]) / (p[b + axis] - p[a + axis]);
    return [p[a + u] + t * (p[b + u] - p[a + u]), p[a + v] + t * (p[b + v] - p[a + v])];
  };
  for (let f = 0; f < indices.length; f += 3) {
    let up: number[] | null = null,
      down: number[] | null = null;
    for (let k = 0; k < 3; ++k) {
      const from = indices[f + k],
        to = indices[f + ((k + 1) % 3)];
      const above = p[3 * from + axis] >= at;
      if (above === p[3 * to + axis] >= at) continue;
      if (above) down = cross(to, from);
      else up = cross(from, to);
    }
    if (!up || !down) continue;
    const [first, last] = turn > 0 ? [down, up] : [up, down];
    pieces.push(first[0], first[1], last[0], last[1]);
  }
  return new Float64Array(pieces);
}

/**
 * The outline's pieces joined end to end, each loop a list of points. Two triangles compute the crossing of their common
 * edge from the same numbers, so that ends that belong together are equal to the last bit.
 */
export function loops(pieces: Outline): [number, number][][] {
  const starts = new Map<string, number[]>();
  const key = (i: number) => `${pieces[i]},${pieces[i + 1]}`;
  for (let i = 0; i < pieces.length; i += 4) {
    const known = starts.get(key(i));
    if (known) known.push(i);
    else starts.set(key(i), [i]);
  }
  const found: [number, number][][] = [];
  for (let i = 0; i < pieces.length; i += 4) {
    const loop: [number, number][] = [];
    let next: number | undefined = starts.get(key(i))?.pop();
    while (next !== undefined) {
      if (!loop.length) loop.push([pieces[next], pieces[next + 1]]);
      loop.push([pieces[next + 2], pieces[next + 3]]);
      next = starts.get(key(next + 2))?.pop();
    }
    if (loop.length) found.push(loop);
  }
  return found;
}

/**
 * For every sample of the row at height v whether it is inside: how often the outline winds around it is summed up
 * from the left. Exact where a ray through the mesh could hit an edge.
 */
function insideRow(pieces: Outline, v: number, low: number, step: number, inside: Uint8Array): void {
  const crossings: [number, number][] = [];
  for (let i = 0; i < pieces.length; i += 4) {
    const from = pieces[i + 1] >= v,
      to = pieces[i + 3] >= v;
    if (from === to) continue;
    const t = (v - pieces[i + 1]) / (pieces[i + 3] - pieces[i + 1]);
    crossings.push([pieces[i] + t * (pieces[i + 2] - pieces[i]), to ? -1 : 1]);
  }
  crossings.sort((a, b) => a[0] - b[0]);
  let winding = 0,
    next = 0;
  for (let i = 0; i < inside.length; ++i) {
    const u = low + i * step;
    while (next < crossings.length && crossings[next][0] <= u) winding += crossings[next++][1];
    inside[i] = winding === 0 ? 0 : 1;
  }
}

/** Exact signed distances to the whole surface (not to the outline) at size x size samples of the plane. */
export function signedDistances(
  tree: MeshBVH,
  pieces: Outline,
  axis: Axis,
  at: number,
  low: [number, number],
  high: [number, number],
  size: number,
): DistanceGrid {
  const [u, v] = PLANE_AXES[axis];
  const values = new Float64Array(size * size);
  const inside = new Uint8Array(size);
  const point = new Vector3().setComponent(axis, at);
  const hit: HitPointInfo = { point: new Vector3(), distance: 0, faceIndex: 0 };
  const stepU = (high[0] - low[0]) / (size - 1),
    stepV = (high[1] - low[1]) / (size - 1);
  for (let j = 0; j < size; ++j) {
    const atV = low[1] + j * stepV;
    insideRow(pieces, atV, low[0], stepU, inside);
    for (let i = 0; i < size; ++i) {
      point.setComponent(u, low[0] + i * stepU).setComponent(v, atV);
      const distance = tree.closestPointToPoint(point, hit)?.distance ?? NaN;
      values[j * size + i] = inside[i] ? distance : -distance;
    }
  }
  return { size, values, low, high };
}
