// Our convex parts beside those of V-HACD (npm's vhacd-js), 32 at most, on a torus and on binary STL files:
//   node bench/vhacd.mjs PACKAGES BENCH_PARTS [SOLID.stl...]
// PACKAGES is a folder in which `npm install vhacd-js` was called, BENCH_PARTS the program build/release/bin/bench_parts. Both are
// measured by the latter; lines of `ratio NAME VALUE`, above 1: ours is better.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const PARTS = 32;
const [packages, benchParts, ...solids] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "antigrasp-vhacd-"));

function writeStl(path, positions, indices) {
  const bytes = Buffer.alloc(84 + (50 * indices.length) / 3);
  bytes.writeUInt32LE(indices.length / 3, 80);
  for (let i = 0; i < indices.length; ++i) {
    const at = 84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3);
    for (let axis = 0; axis < 3; ++axis) bytes.writeFloatLE(positions[3 * indices[i] + axis], at + 4 * axis);
  }
  writeFileSync(path, bytes);
}

// Corners that are equal are one, as V-HACD wants them.
function readStl(path) {
  const bytes = readFileSync(path);
  const positions = [],
    indices = [],
    known = new Map();
  for (let i = 0; i < 3 * bytes.readUInt32LE(80); ++i) {
    const at = 84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3);
    const corner = [0, 4, 8].map((offset) => bytes.readFloatLE(at + offset));
    const key = corner.join();
    if (!known.has(key)) {
      known.set(key, positions.length / 3);
      positions.push(...corner);
    }
    indices.push(known.get(key));
  }
  return { positions: new Float64Array(positions), indices: new Uint32Array(indices) };
}

function writeTorus(path) {
  const around = 48,
    about = 24,
    positions = [],
    indices = [];
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < about; ++j) {
      const [u, v] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / about];
      const radius = 0.03 + 0.012 * Math.cos(v);
      positions.push(radius * Math.cos(u), radius * Math.sin(u), 0.012 * Math.sin(v));
      const at = (a, b) => (a % around) * about + (b % about);
      indices.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  writeStl(path, positions, indices);
}

// covered %, missing %, Hausdorff and dent in cells, seconds
function measured(...words) {
  const text = execFileSync(resolve(benchParts), words, { encoding: "utf8" });
  return text.split("\n")[1].split(",").slice(-6, -1).map(Number);
}

const place = createRequire(pathToFileURL(`${resolve(packages)}/package.json`)).resolve("vhacd-js/lib/vhacd.js");
const { ConvexMeshDecomposition } = await import(pathToFileURL(place));
const decomposer = await ConvexMeshDecomposition.create();
const torus = join(folder, "torus.stl");
writeTorus(torus);
for (const solid of [torus, ...solids]) {
  const start = process.cpuUsage().user;
  const hulls = decomposer.computeConvexHulls(readStl(solid), { maxHulls: PARTS });
  const seconds = (process.cpuUsage().user - start) / 1e6;
  const files = hulls.map((hull, i) => join(folder, `hull_${i}.stl`));
  hulls.forEach((hull, i) => writeStl(files[i], hull.positions, hull.indices));
  const theirs = [...measured("given", solid, ...files).slice(0, 4), seconds];
  const ours = measured(String(PARTS), solid);
  const name = basename(solid, ".stl");
  const line = (numbers) =>
    `${numbers[4].toFixed(2)} s, ${numbers[0].toFixed(2)} % of the volume too much, ${numbers[1].toFixed(2)} % missing, ` +
    `Hausdorff ${numbers[2].toFixed(2)} cells, dent ${numbers[3].toFixed(2)}`;
  console.log(`${name}: V-HACD, ${hulls.length} parts: ${line(theirs)}`);
  console.log(`${name}: ours: ${line(ours)}`);
  console.log(`ratio parts_${name}_vs_vhacd_seconds ${(theirs[4] / ours[4]).toPrecision(3)}`);
  console.log(`ratio parts_${name}_vs_vhacd_covered ${(theirs[0] / ours[0]).toPrecision(3)}`);
  console.log(`ratio parts_${name}_vs_vhacd_hausdorff ${(theirs[2] / ours[2]).toPrecision(3)}`);
}
rmSync(folder, { recursive: true });
