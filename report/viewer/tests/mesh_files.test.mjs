// What `export --format stl|obj|ply` writes is for other programs: read by the loaders of three.js.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { volumeOf } from "./support/volume.mjs";

const folder = mkdtempSync(join(tmpdir(), "antigrasp-meshes-"));
const bytes = (format) => {
  const read = readFileSync(join(folder, format, `prisms-000000.${format}`));
  return read.buffer.slice(read.byteOffset, read.byteOffset + read.length);
};

before(() => {
  const binary = process.env.ANTIGRASP_BINARY;
  assert.ok(binary, "ANTIGRASP_BINARY: expected the path of the built binary");
  const call = (...words) => execFileSync(resolve(binary), words, { cwd: folder, stdio: "ignore" });
  call("dataset", "make", "prisms", "--count", "1", "--seed", "5", "--out", "p.h5");
  for (const format of ["stl", "obj", "ply"])
    call("export", "p.h5", "--size-mm", "60", "--format", format, "--out", format);
});
after(() => rmSync(folder, { recursive: true }));

const corners = (geometry) => (geometry.index ?? geometry.getAttribute("position")).count;

describe("a solid in three.js", () => {
  const stl = () => new STLLoader().parse(bytes("stl"));

  it("is 60 mm long and outside out as STL", () => {
    const geometry = stl();
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    const sides = ["x", "y", "z"].map((axis) => max[axis] - min[axis]);
    assert.ok(Math.abs(Math.max(...sides) - 60) < 1e-4);
    assert.ok(volumeOf(geometry) > 1000);
  });

  it("is the same as OBJ", () => {
    const { children } = new OBJLoader().parse(new TextDecoder().decode(bytes("obj")));
    assert.equal(children.length, 1);
    assert.equal(corners(children[0].geometry), corners(stl()));
    assert.ok(Math.abs(volumeOf(children[0].geometry) / volumeOf(stl()) - 1) < 1e-5);
  });

  it("is the same as PLY", () => {
    const geometry = new PLYLoader().parse(bytes("ply"));
    assert.equal(corners(geometry), corners(stl()));
    assert.ok(Math.abs(volumeOf(geometry) / volumeOf(stl()) - 1) < 1e-5);
  });
});
