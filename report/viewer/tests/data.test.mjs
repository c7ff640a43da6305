// What the page reads from the payload and how it orders and colours it, against literal bytes and lopsided shapes.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { Blob, meshRecord, packGrasps, score } from "./support/payload.mjs";
import { allNear, cuboid, cuboidParts, near, sources } from "./support/sources.mjs";

const blob = new Blob();
const BYTES = [0, 1, 2, 250, 251, 252, 253];
// Streams of every length begin at each of the three places in a group of base64.
const parts = [0, 1, 2, 3, 4, 5, 6, 7].map((length) => blob.add(Uint8Array.from(BYTES.slice(0, length))));
const tooLong = [...blob.addStored(deflateRawSync(Buffer.alloc(5000))), 4999];
const literal = [...blob.addStored([0x4b, 0xcc, 0x2b, 0xc9, 0x4c, 0x2f, 0x4a, 0x2c, 0x2e, 0x00, 0x00]), 9];
const noStream = [...blob.addStored([255, 255, 255, 255]), 4];
let page;
const load = (path) => page.load(path);
before(async () => {
  page = await sources();
  // Read when first asked for; pieces of 96 bytes, so that parts lie across them.
  const elements = () => blob.pieces(96).map((textContent) => ({ textContent }));
  globalThis.document = { readyState: "complete", getElementsByClassName: elements };
});
after(() => page.close());

// One grasp as the binary packs it: every number another one.
const GRASP = [1, 2, 3, 4, 6, 3, 0, 0, -1, 0, 1, 0, 1, 0, 0, 0.25, 5];
const graspPart = blob.add(packGrasps([GRASP, GRASP.map((x) => -x)]));
const box = meshRecord(blob, cuboidParts([1, 2, 4], [10, 20, 30]));

test("a part has arrived once the element that holds its end is complete", async () => {
  const { hasArrived } = await load("/src/data/blob.ts");
  document.readyState = "loading";
  assert.ok(hasArrived([0, 96 * (blob.pieces(96).length - 1), 1]));
  assert.ok(!hasArrived([0, 96 * (blob.pieces(96).length - 1) + 1, 1]));
  document.readyState = "interactive";
  assert.ok(hasArrived([0, blob.length, 1]));
});

test("a part of the blob is its bytes, wherever it begins", async () => {
  const { bytesOf } = await load("/src/data/blob.ts");
  for (const [length, part] of parts.entries()) assert.deepEqual([...bytesOf(part)], BYTES.slice(0, length));
  // "antigrasp" as zlib of Python deflates it.
  assert.equal(Buffer.from(bytesOf(literal)).toString(), "antigrasp");
});

test("a part that is cut short, longer than it says or no stream is refused", async () => {
  const { bytesOf } = await load("/src/data/blob.ts");
  const [offset, length, size] = parts[7];
  assert.throws(() => bytesOf([blob.length, 4, 4]), /cut short/);
  assert.throws(() => bytesOf([offset, length, size + 1]), /cut short/);
  assert.throws(() => bytesOf([offset, length - 1, size]));
  assert.throws(() => bytesOf([offset, length, 1e15]), /cut short/);
  assert.throws(() => bytesOf([offset, length, NaN]), /cut short/);
  assert.throws(() => bytesOf(tooLong));
  assert.throws(() => bytesOf(noStream));
});

test("a grasp is its two contacts, their normals, the approach, its quality and its width", async () => {
  const { graspsOf } = await load("/src/data/grasps.ts");
  const grasps = graspsOf(graspPart);
  assert.equal(grasps.length, 2);
  assert.deepEqual(grasps[0], {
    p1: [1, 2, 3],
    p2: [4, 6, 3],
    n1: [0, 0, -1],
    n2: [0, 1, 0],
    approach: [1, 0, 0],
    quality: 0.25,
    width: 5,
  });
  assert.equal(grasps[1].width, -5);
});

test("a mesh is decoded to its place and size, axis by axis", async () => {
  const { decodeMesh, decoderReady } = await load("/src/data/mesh.ts");
  await decoderReady;
  const mesh = decodeMesh(box);
  allNear(mesh.min, [9, 18, 26], 1e-9);
  allNear(mesh.max, [11, 22, 34], 8 / 65535);
  assert.equal(box.extent, 8);
  allNear([...mesh.positions.slice(0, 3)], [9, 18, 26], 1e-6); // the first corner is all the lows
  near(mesh.positions[3 * 3 + 2], 34, 1e-4);
  assert.deepEqual([...mesh.indices].sort((a, b) => a - b).slice(-1), [7]);
  assert.throws(() => decodeMesh({ ...box, vertices: 7 }));
});

test("the best quality is green, none is red; inside is brown, outside blue; far is yellow", async () => {
  const colours = await load("/src/colours.ts");
  assert.equal(colours.qualityColour(1), "rgb(26, 152, 80)");
  assert.equal(colours.qualityColour(0), "rgb(214, 39, 40)");
  assert.equal(colours.qualityColour(0.75), "rgb(140, 190, 60)");
  assert.equal(colours.qualityColour(2), "rgb(26, 152, 80)");
  assert.equal(colours.distanceColour(-1), "rgb(36, 84, 130)");
  assert.equal(colours.distanceColour(0), "rgb(250, 249, 246)");
  assert.equal(colours.distanceColour(1), "rgb(178, 82, 14)");
  assert.deepEqual(colours.heatRgb(0), [68, 1, 84]);
  assert.deepEqual(colours.heatRgb(1), [253, 231, 37]);
  assert.match(colours.QUALITY_GRADIENT, /to right, rgb\(214, 39, 40\)/);
  assert.match(colours.DISTANCE_GRADIENT, /to right, rgb\(36, 84, 130\)/);
  assert.match(colours.HEAT_GRADIENT, /to right, rgb\(68, 1, 84\)/);
});

test("a section's plane has the other two axes, in their order", async () => {
  const { outline, PLANE_AXES } = await load("/src/data/section.ts");
  assert.deepEqual(PLANE_AXES, { 0: [1, 2], 1: [0, 2], 2: [0, 1] });
  const mesh = cuboid([1, 2, 4], [10, 20, 30]);
  const low = [9, 18, 26],
    high = [11, 22, 34];
  for (const [axis, u, v] of [
    [0, 1, 2],
    [1, 0, 2],
    [2, 0, 1],
  ]) {
    const pieces = outline(mesh, axis, low[axis] + 0.25);
    const us = [...pieces].filter((_, i) => i % 2 === 0),
      vs = [...pieces].filter((_, i) => i % 2 === 1);
    allNear([Math.min(...us), Math.max(...us)], [low[u], high[u]], 1e-5);
    allNear([Math.min(...vs), Math.max(...vs)], [low[v], high[v]], 1e-5);
    assert.equal(outline(mesh, axis, high[axis] + 0.25).length, 0);
  }
});

test("an STL is turned by the rows of its pose", async () => {
  const { writeStl } = await load("/src/data/stl.ts");
  // Rows z, x, y: what was z lies along x, what was y stands up.
  const pose = [
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0],
  ];
  const view = new DataView(writeStl(cuboid([0.3, 0.2, 0.1], [5, 6, 7]), { scale: 100, pose }));
  const low = [9, 9, 9],
    high = [-9, -9, -9];
  for (let t = 0; t < 12; ++t)
    for (let c = 0; c < 9; ++c) {
      const x = view.getFloat32(84 + 50 * t + 12 + 4 * c, true);
      low[c % 3] = Math.min(low[c % 3], x);
      high[c % 3] = Math.max(high[c % 3], x);
    }
  allNear(low, [-10, -30, 0], 1e-3);
  allNear(high, [10, 30, 40], 1e-3);
});

const object = (name, g, more = {}) => ({ name, group: 0, status: "ok", score: g === null ? null : score(g), ...more });

test("the gallery sorts by graspability or name, what was not scored last, and filters", async () => {
  const { gallerySections, galleryOrder } = await load("/src/pages/gallery_order.ts");
  const report = {
    groups: [{ label: "a" }, { label: "b" }],
    objects: [
      object("o10", 0.2, { elite: true }),
      object("o9", null, { status: "disjoint" }),
      object("o2", 0.3, { group: 1 }),
      object("o1", 0.1, { status: "few_grasps" }),
    ],
  };
  const state = { groups: new Set([0, 1]), sort: "stored", byStage: false, status: "all", text: "" };
  const order = (more) => gallerySections(report, { ...state, ...more }).map((s) => [s.group, ...s.objects]);
  assert.deepEqual(order({}), [[-1, 0, 1, 2, 3]]);
  assert.deepEqual(order({ sort: "ascending" }), [[-1, 3, 0, 2, 1]]);
  assert.deepEqual(order({ sort: "descending" }), [[-1, 2, 0, 3, 1]]);
  assert.deepEqual(order({ sort: "name" }), [[-1, 3, 2, 1, 0]]);
  assert.deepEqual(order({ byStage: true, sort: "ascending" }), [
    [0, 3, 0, 1],
    [1, 2],
  ]);
  assert.deepEqual(order({ status: "accepted" }), [[-1, 0, 2, 3]]);
  assert.deepEqual(order({ status: "rejected" }), [[-1, 1]]);
  assert.deepEqual(order({ status: "elite" }), [[-1, 0]]);
  assert.deepEqual(order({ groups: new Set([1]), text: "O2" }), [[-1, 2]]);
  assert.deepEqual(galleryOrder(report), [0, 1, 3, 2]);
});

test("pairs hold before and after of the objects that have both", async () => {
  const { pairPoints } = await load("/src/charts/paired.ts");
  const list = [
    object("a", 0.1, { pair: { score: score(0.4) } }),
    object("b", 0.1),
    object("c", 0.2, { pair: { score: score(0.5) }, status: "after: open" }),
    object("d", 0.3, { pair: { score: score(0.2) } }),
  ];
  assert.deepEqual(pairPoints(list), [
    { index: 0, name: "a", before: 0.4, after: 0.1 },
    { index: 3, name: "d", before: 0.2, after: 0.3 },
  ]);
});

test("quantiles, thousandths and percent are written as on paper", async () => {
  const { quantile } = await load("/src/charts/histograms.ts");
  assert.deepEqual(
    [0.1, 0.5, 0.9].map((q) => quantile([4, 1, 2], q)),
    ["1.200", "2.000", "3.600"],
  );
  assert.equal(quantile([], 0.5), "–");
  const { milli, percent, plusMinus, count } = await load("/src/format.ts");
  assert.equal(milli(0.0123456), "12.35");
  assert.equal(percent(-0.256, 1), "−25.6\u202f%");
  assert.equal(plusMinus(1.5, 0.25, 2), "1.50 ± 0.25");
  assert.equal(count(1234567), "1\u202f234\u202f567");
});

test("a contour's step is 1, 2 or 5 times a power of ten and not above what was asked for", async () => {
  const { niceStep } = await load("/src/charts/section.ts");
  assert.deepEqual([0.99, 1, 1.99, 2, 4.9, 5, 70].map(niceStep), [0.5, 1, 1, 2, 2, 5, 50]);
});

test("axes of grasps reach beyond both contacts and cones open outwards, coloured by quality", async () => {
  const { GraspMarks } = await load("/src/three/grasp_marks.ts");
  const { Color, Matrix4, Vector3 } = await load("three");
  const { qualityColour } = await load("/src/colours.ts");
  const grasp = (quality) => ({ p1: [1, 2, 3], p2: [4, 6, 3], n1: [0, 0, -1], n2: [0, 1, 0], approach: null, quality });
  const marks = new GraspMarks([grasp(0.4), grasp(0.1)], { extent: 10, best: 0.4, friction: 0.5 });
  marks.show(2, 0, false);
  const [axes, balls, cones] = marks.group.children;
  const placed = (mesh, i, point) => {
    const matrix = new Matrix4();
    mesh.getMatrixAt(i, matrix);
    return new Vector3(...point).applyMatrix4(matrix).toArray();
  };
  assert.deepEqual([axes.count, balls.count, cones.count], [2, 4, 2]);
  // Half of 0.3 extents beyond either contact, 1.5, along (0.6, 0.8, 0).
  allNear(placed(axes, 1, [0, -0.5, 0]), [1 - 0.9, 2 - 1.2, 3], 1e-5);
  allNear(placed(axes, 1, [0, 0.5, 0]), [4 + 0.9, 6 + 1.2, 3], 1e-5);
  allNear(placed(balls, 0, [0, 0, 0]), [1, 2, 3], 1e-6);
  allNear(placed(balls, 1, [0, 0, 0]), [4, 6, 3], 1e-6);
  allNear(placed(cones, 0, [0, 1, 0]), [1, 2, 3 - 1.6], 1e-5); // 0.16 extents along the outward normal
  allNear(placed(cones, 1, [0, 1, 0]), [4, 6 + 1.6, 3], 1e-5);
  const edge = placed(cones, 1, [1, 1, 0]);
  near(Math.hypot(edge[0] - 4, edge[2] - 3), 0.8, 1e-5); // as wide as friction says
  const colour = (mesh, i) => {
    const found = new Color();
    mesh.getColorAt(i, found);
    return found.getStyle();
  };
  assert.equal(colour(axes, 0), new Color(qualityColour(1)).getStyle());
  assert.equal(colour(axes, 1), new Color(qualityColour(0.25)).getStyle());
});

test("the gripper closes on the contacts from where it came, in mesh units", async () => {
  const { gripperOn } = await load("/src/three/gripper.ts");
  const { Vector3 } = await load("three");
  const gripper = {
    palm_distance: 0.05,
    fingertip_overlap: 0.01,
    finger_width: 0.02,
    finger_thickness: 0.004,
    palm_depth: 0.08,
    palm_length: 0.06,
    palm_width: 0.03,
  };
  const grasp = { p1: [0, 1, 0], p2: [0, 5, 0], approach: [0, 0, -1], width: 4, quality: 1 };
  const group = gripperOn(grasp, gripper, 0.01); // a unit is a centimetre
  const [one, other, palm] = group.children;
  const middle = (mesh) => new Vector3().copy(mesh.position).applyMatrix4(group.matrix).toArray();
  allNear(middle(one), [0, 3 + 2.2, 2], 1e-6); // 2 cm and half a finger off the middle; from 5 above to 1 below
  allNear(middle(other), [0, 3 - 2.2, 2], 1e-6);
  allNear(middle(palm), [0, 3, 9], 1e-6);
  const size = (mesh) => [
    mesh.geometry.parameters.width,
    mesh.geometry.parameters.height,
    mesh.geometry.parameters.depth,
  ];
  allNear(size(one), [0.06, 0.004, 0.02], 1e-12);
  allNear(size(palm), [0.08, 0.06, 0.03], 1e-12);
  assert.equal(gripperOn({ ...grasp, approach: null }, gripper, 0.01), null);
});
