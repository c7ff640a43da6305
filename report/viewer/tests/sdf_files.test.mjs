// SDF files are for other programs, too: written by the binary in ANTIGRASP_BINARY, read by the two readers
// of HDF5 that people have in a browser. A reader that is not installed is skipped by name.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";

const installed = async (name) =>
  import(name).catch((error) => {
    if (error.code === "ERR_MODULE_NOT_FOUND" && error.message.includes(`'${name.split("/")[0]}'`)) return null;
    throw error; // it is there and does not load
  });
const jsfive = await installed("jsfive");
const h5wasm = await installed("h5wasm/node");
const missing = (reader, name) => (reader ? false : `${name} is not installed`);

const folder = mkdtempSync(join(tmpdir(), "antigrasp-sdf-"));
const file = join(folder, "cylinders.h5");

before(() => {
  const binary = process.env.ANTIGRASP_BINARY;
  assert.ok(binary, "ANTIGRASP_BINARY: expected the path of the built binary");
  execFileSync(resolve(binary), ["dataset", "make", "cylinders", "--count", "3", "--seed", "5", "--out", file], {
    stdio: "ignore",
  });
});
after(() => rmSync(folder, { recursive: true }));

// A solid in the middle of the cube: the middle is inside, the corner outside.
function looksLikeThreeSolids(values) {
  const side = 32;
  assert.equal(values.length, 3 * side ** 3);
  for (let grid = 0; grid < 3; ++grid) {
    const at = (x, y, z) => values[((grid * side + z) * side + y) * side + x];
    assert.ok(at(16, 16, 16) > 0, "the middle is inside, positive");
    assert.ok(at(0, 0, 0) < -0.2, "the corner is far outside");
  }
}

const ROOT = {
  format: "antigrasp.sdf",
  version: 2,
  kind: "cylinders",
  seed: 5,
  spacing: 1 / 32,
  origin: [-0.484375, -0.484375, -0.484375],
  truncation: 0,
  provenance: "prior set cylinders, seed 5, count 3",
};
const NAMES = ["cylinders-000000", "cylinders-000001", "cylinders-000002"];

describe("SDF files are read", () => {
  it("by jsfive: attributes, names and grids", { skip: missing(jsfive, "jsfive") }, () => {
    const bytes = readFileSync(file);
    const read = new jsfive.File(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), file);
    assert.deepEqual(read.attrs, ROOT);
    assert.deepEqual(read.get("names").value, NAMES);
    const sdf = read.get("sdf");
    assert.deepEqual(sdf.shape, [3, 32, 32, 32]);
    assert.equal(sdf.dtype, "<f4");
    assert.deepEqual({ ...sdf.attrs }, { sign: "positive inside", unit: "side of the unit cube" });
    looksLikeThreeSolids(sdf.value);
  });

  it("by h5wasm: attributes, names and grids", { skip: missing(h5wasm, "h5wasm") }, async () => {
    await h5wasm.ready;
    const read = new h5wasm.File(file, "r");
    const plain = (value) => (typeof value === "bigint" ? Number(value) : value.buffer ? [...value] : value);
    const all = (attrs) => Object.fromEntries(Object.entries(attrs).map(([name, { value }]) => [name, plain(value)]));
    assert.deepEqual(all(read.attrs), ROOT);
    assert.deepEqual(read.get("names").value, NAMES);
    const sdf = read.get("sdf");
    assert.deepEqual(sdf.shape, [3, 32, 32, 32]);
    assert.deepEqual(all(sdf.attrs), { sign: "positive inside", unit: "side of the unit cube" });
    looksLikeThreeSolids(sdf.value);
    read.close();
  });
});
