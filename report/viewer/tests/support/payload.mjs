// Reports built in code: what the binary cannot be made to write (hostile names, missing numbers), and five hundred
// objects in a second. Everything else is tested with reports of the binary itself.
import { readFileSync } from "node:fs";
import { deflateRawSync } from "node:zlib";
import { MeshoptEncoder } from "meshoptimizer/encoder";

await MeshoptEncoder.ready;

/** Collects deflated parts one after the other, as the binary does. */
export class Blob {
  constructor() {
    this.chunks = [];
    this.length = 0;
  }

  add(bytes) {
    const stream = deflateRawSync(bytes, { level: 9 });
    return [...this.addStored(stream), bytes.length];
  }

  /** Bytes as they are: of no stream, or of a hostile one. */
  addStored(bytes) {
    const place = [this.length, bytes.length];
    this.chunks.push(Buffer.from(bytes));
    this.length += bytes.length;
    return place;
  }

  /** The base64 text of every script element. */
  pieces(most = 3 << 16) {
    const bytes = Buffer.concat(this.chunks);
    return Array.from({ length: Math.max(1, Math.ceil(bytes.length / most)) }, (_, i) =>
      bytes.subarray(i * most, (i + 1) * most).toString("base64"),
    );
  }
}

/** Numbers of grasps, 17 each (contacts, normals, approach, quality, width), in the bytes of the contract. */
export function packGrasps(rows) {
  const columns = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16].map((k) => rows.map((row) => row[k]));
  const low = columns.map((column) => Math.min(...column)),
    high = columns.map((column) => Math.max(...column));
  const q = columns.flatMap((column, k) =>
    column.map((x) => (high[k] > low[k] ? Math.round((65535 * (x - low[k])) / (high[k] - low[k])) : 0)),
  );
  const floats = [...rows.map((row) => row[15]), ...low.flatMap((x, k) => [x, high[k]])];
  return Buffer.concat([Buffer.from(Float32Array.from(floats).buffer), Buffer.from(Uint16Array.from(q).buffer)]);
}

/** A closed surface around the origin: radius(x, y, z) in the direction of a unit vector, an n x 2n grid. */
export function starMesh(n, radius) {
  const positions = [],
    indices = [];
  const vertex = (t, p) => {
    const z = Math.cos(t),
      s = Math.sin(t),
      x = s * Math.cos(p),
      y = s * Math.sin(p);
    const r = radius(x, y, z);
    positions.push(r * x, r * y, r * z);
  };
  vertex(0, 0);
  for (let i = 1; i < n; ++i) for (let j = 0; j < 2 * n; ++j) vertex((Math.PI * i) / n, (Math.PI * j) / n);
  vertex(Math.PI, 0);
  const at = (i, j) => (i === 0 ? 0 : i === n ? 1 + (n - 1) * 2 * n : 1 + (i - 1) * 2 * n + (j % (2 * n)));
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < 2 * n; ++j) {
      if (i > 0) indices.push(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i < n - 1) indices.push(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  return { positions, indices };
}

export const bumpy = (seed, n = 28) =>
  starMesh(
    n,
    (x, y, z) =>
      0.3 +
      0.06 * Math.sin(5 * x + seed) * Math.cos(4 * z - 2 * seed) +
      0.05 * Math.sin(3 * y + 1.7 * seed) +
      0.04 * Math.cos(2 * seed) * z * z,
  );

/** Adds a mesh to the blob in the codecs of the contract. */
export function meshRecord(blob, { positions, indices }) {
  const vertices = positions.length / 3;
  const min = [0, 1, 2].map((k) => positions.reduce((m, x, i) => (i % 3 === k ? Math.min(m, x) : m), Infinity));
  const max = [0, 1, 2].map((k) => positions.reduce((m, x, i) => (i % 3 === k ? Math.max(m, x) : m), -Infinity));
  const extent = Math.max(...[0, 1, 2].map((k) => max[k] - min[k]));
  const quantised = new Uint16Array(vertices * 4);
  for (let v = 0; v < vertices; ++v)
    for (let k = 0; k < 3; ++k) quantised[4 * v + k] = Math.round(((positions[3 * v + k] - min[k]) / extent) * 65535);
  const q = new Uint8Array(quantised.buffer);
  const index = new Uint8Array(new Uint32Array(indices).buffer);
  return {
    vertices,
    triangles: indices.length / 3,
    min,
    extent,
    positions: blob.add(MeshoptEncoder.encodeVertexBuffer(q, vertices, 8)),
    indices: blob.add(MeshoptEncoder.encodeIndexBuffer(index, indices.length, 4)),
  };
}

/** Grasps through the centre of a star-shaped object, best first. */
export function graspPart(blob, radius, count) {
  const rows = [];
  for (let g = 0; g < count; ++g) {
    const p = g * 2.399963,
      z = 0.8 * Math.sin(g * 1.3),
      s = Math.sqrt(1 - z * z);
    const d = [s * Math.cos(p), s * Math.sin(p), z];
    const up = [-Math.sin(p), Math.cos(p), 0];
    const r1 = radius(...d.map((x) => -x)),
      r2 = radius(...d);
    rows.push([
      ...d.map((x) => -r1 * x),
      ...d.map((x) => r2 * x),
      ...d.map((x) => -x),
      ...d,
      ...up,
      0.0025 * (1 - g / count),
      r1 + r2,
    ]);
  }
  return blob.add(packGrasps(rows));
}

export const score = (g, more = {}) => ({
  graspability: g,
  ci_low: g * 0.9,
  ci_high: g * 1.1,
  mean: g * 0.8,
  fraction_nonzero: 0.7,
  num_grasps: 100,
  ...more,
});

export const GRIPPER = {
  palm_distance: 0.046,
  fingertip_overlap: 0.01,
  finger_width: 0.02,
  finger_thickness: 0.01,
  palm_depth: 0.084,
  palm_length: 0.08,
  palm_width: 0.05,
  jaw_opening: 0.05,
};
export const METRIC = {
  percentile: 75,
  friction: 0.5,
  num_grasps: 100,
  num_draws: 25,
  noise: "object 2.5 mm",
  finger_radius: 0.005,
  size: "each scaled to a smallest extent of 40 mm",
};

export function emptyReport(more = {}) {
  return {
    format: "antigrasp.report",
    version: 2,
    title: "runs/test",
    kind: "run",
    missing: [],
    provenance: [
      ["commit", "abc"],
      ["seed", "1"],
    ],
    config: "[run]\nseed = 1\n",
    metric: METRIC,
    gripper: GRIPPER,
    run: null,
    groups: [],
    objects: [],
    ...more,
  };
}

/** A stage with all its numbers; `more` takes some away. */
export const stage = (id, episode, more = {}) => ({
  id,
  label: episode < 0 ? "prior set" : more.control ? `control ${episode}` : `episode ${episode}`,
  episode,
  control: false,
  samples: 10,
  statuses: [
    ["ok", 9],
    ["disjoint", 1],
  ],
  graspability: { mean: 0.002 - 0.0002 * episode, half_width: 0.0001, count: 9 },
  coverage: 0.5,
  nna: 0.6,
  duplicates: 0.1,
  diversity: 0.9,
  scores: [0.001, 0.002, 0.003],
  ...more,
});

/** Scored objects of twelve shapes over five stages. */
export function objects(blob, count, names) {
  const meshes = Array.from({ length: 12 }, (_, i) => meshRecord(blob, bumpy(i)));
  return Array.from({ length: count }, (_, i) => ({
    name: names?.[i] ?? `sample-${String(i).padStart(6, "0")}`,
    group: i % 5,
    status: "ok",
    score: score(0.0005 + 0.000003 * ((i * 37) % 500)),
    mesh: meshes[i % 12],
    metres_per_unit: 0.08,
    com: [0, 0, 0],
    grasps: null,
    numbers: [],
    print: null,
  }));
}

export const GROUPS = ["prior set", "episode 0", "episode 1", "episode 2", "episode 3"].map((label, i) => ({
  id: `g${i}`,
  label,
}));

/** Fills the template as the binary does. */
export function fill(templatePath, report, blob) {
  const between = '</script>\n<script type="application/octet-stream" class="antigrasp-blob">';
  const json = JSON.stringify(report).replace(
    /[<>&\u007f-\uffff]/g,
    (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`,
  );
  const title = report.title.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
  return readFileSync(templatePath, "utf8")
    .replace('"ANTIGRASP_REPORT_JSON"', () => json)
    .replace("ANTIGRASP_BLOB_BASE64", () => (blob ? blob.pieces().join(between) : ""))
    .replace("ANTIGRASP_TITLE", () => title);
}
