// The page's arithmetic, against answers known on paper. The sources are loaded through Vite, as the build does.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { starMesh } from "./support/payload.mjs";
import { asMesh, cuboid, near, sources } from "./support/sources.mjs";

let page;
const load = (path) => page.load(path);
before(async () => {
  page = await sources();
});
after(() => page.close());

test("the signed distances of a cuboid's section are those on paper, for every axis, positive inside", async () => {
  const { distanceTree, outline, signedDistances, PLANE_AXES } = await load("/src/data/section.ts");
  const half = [0.3, 0.2, 0.1];
  const mesh = cuboid(half);
  const tree = distanceTree(mesh);
  for (const axis of [0, 1, 2]) {
    const at = 0.04;
    const grid = signedDistances(tree, outline(mesh, axis, at), axis, at, [-0.5, -0.5], [0.5, 0.5], 21);
    const [u, v] = PLANE_AXES[axis];
    for (let j = 0; j < 21; ++j)
      for (let i = 0; i < 21; ++i) {
        const p = [0, 0, 0];
        p[axis] = at;
        p[u] = -0.5 + i * 0.05;
        p[v] = -0.5 + j * 0.05;
        const q = p.map((x, k) => Math.abs(x) - half[k]);
        const paper = -(Math.hypot(...q.map((x) => Math.max(x, 0))) + Math.min(0, Math.max(...q)));
        if (Math.abs(paper) > 1e-6) near(grid.values[j * 21 + i], paper, 1e-6);
      }
  }
});

test("the outline of a section is closed and as long as the cuboid's rectangle", async () => {
  const { loops, outline } = await load("/src/data/section.ts");
  const mesh = cuboid([0.3, 0.2, 0.1]);
  const pieces = outline(mesh, 2, 0);
  let length = 0,
    area = 0;
  for (let i = 0; i < pieces.length; i += 4) {
    length += Math.hypot(pieces[i + 2] - pieces[i], pieces[i + 3] - pieces[i + 1]);
    area += (pieces[i] * pieces[i + 3] - pieces[i + 2] * pieces[i + 1]) / 2;
  }
  near(length, 2, 1e-6);
  const joined = loops(pieces);
  assert.equal(joined.length, 1, "one loop");
  assert.deepEqual(joined[0][0], joined[0][joined[0].length - 1], "that ends where it began");
  assert.equal(joined[0].length, pieces.length / 4 + 1, "and leaves no piece out");
  near(area, 0.24, 1e-6); // positive: the solid lies to the left
});

test("normals are smooth on a sphere and stay sharp on a cuboid", async () => {
  const { shade } = await load("/src/three/geometry.ts");
  const sphere = asMesh(starMesh(16, () => 1));
  const round = shade(sphere);
  assert.equal(round.source.length, sphere.positions.length / 3, "a sphere needs no vertex twice");
  const p = round.geometry.getAttribute("position"),
    n = round.geometry.getAttribute("normal");
  for (let i = 0; i < p.count; ++i)
    assert.ok(p.getX(i) * n.getX(i) + p.getY(i) * n.getY(i) + p.getZ(i) * n.getZ(i) > 0.98, "normals point outwards");
  const sharp = shade(cuboid([1, 1, 1]));
  assert.equal(sharp.source.length, 24, "three normals for each of the eight corners");
  const m = sharp.geometry.getAttribute("normal");
  for (let i = 0; i < m.count; ++i)
    near(Math.max(Math.abs(m.getX(i)), Math.abs(m.getY(i)), Math.abs(m.getZ(i))), 1, 1e-6);
});

test("a ratio's interval follows the delta method", async () => {
  const { ratio } = await load("/src/data/statistics.ts");
  const r = ratio({ value: 3, half: 0.3 }, { value: 4, half: 0.4 });
  near(r.value, 0.75, 1e-12);
  near(r.half, 0.75 * Math.hypot(0.1, 0.1), 1e-12);
  // Relative half widths 0.1 and 0.2.
  near(ratio({ value: 3, half: 0.3 }, { value: 4, half: 0.8 }).half, 0.75 * Math.sqrt(0.05), 1e-12);
  assert.equal(ratio({ value: 3, half: null }, { value: 4, half: 0.4 }).half, null);
  assert.equal(ratio(null, { value: 4, half: 0.4 }), null);
});

test("a paired reduction has no error when every object loses the same share", async () => {
  const { pairedReduction } = await load("/src/data/statistics.ts");
  const same = pairedReduction([1, 2, 3], [0.7, 1.4, 2.1]);
  near(same.value, 0.3, 1e-12);
  near(same.half, 0, 1e-12);
  const mixed = pairedReduction([1, 1], [0.5, 0.7]); // residuals -0.1 and 0.1: deviation 0.1 sqrt 2, of the mean 0.1
  near(mixed.value, 0.4, 1e-12);
  near(mixed.half, 0.196, 1e-12);
  assert.equal(pairedReduction([], []), null);
});

test("histograms share all objects out, the last bin takes what lies beyond", async () => {
  const { binEdges, histogram } = await load("/src/data/statistics.ts");
  const edges = binEdges(1.7, 36);
  near(edges[1], 0.05, 1e-12);
  near(edges[edges.length - 1], 1.7, 1e-9);
  const bins = histogram([0, 0.05, 0.051, 9], edges);
  assert.deepEqual([bins[0].share, bins[1].share, bins[bins.length - 1].share], [0.25, 0.5, 0.25]);
});

test("an STL is written in millimetres, turned to its pose and set on the plate", async () => {
  const { stlPlan, writeStl } = await load("/src/data/stl.ts");
  const mesh = cuboid([0.3, 0.2, 0.1]);
  const object = {
    metres_per_unit: 0.1,
    print: {
      size_mm: [90, 60, 30],
      pose: [
        [1, 0, 0],
        [0, 0, -1],
        [0, 1, 0],
      ],
    },
  };
  const plan = stlPlan(object, mesh);
  near(plan.scale, 150, 1e-3);
  const view = new DataView(writeStl(mesh, plan));
  assert.equal(view.getUint32(80, true), 12);
  const corners = [];
  for (let t = 0; t < 12; ++t)
    for (let c = 0; c < 3; ++c)
      corners.push([0, 1, 2].map((k) => view.getFloat32(84 + 50 * t + 12 + 12 * c + 4 * k, true)));
  const extent = (k) => [Math.min(...corners.map((p) => p[k])), Math.max(...corners.map((p) => p[k]))];
  [
    [-45, 45],
    [-15, 15],
    [0, 60],
  ].forEach((expected, k) => extent(k).forEach((x, i) => near(x, expected[i], 1e-4)));
  near(stlPlan({ metres_per_unit: 0.1, print: null }, mesh).scale, 100, 1e-9);
});
