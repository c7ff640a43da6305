// What `export --format 3mf` writes is for other programs: read by three.js, whose loader takes the document of a browser
// from jsdom here; where that is not installed the test is skipped by its name.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { ThreeMFLoader } from "three/addons/loaders/3MFLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { volumeOf } from "./support/volume.mjs";

const jsdom = await import("jsdom").catch((error) => {
  if (error.code === "ERR_MODULE_NOT_FOUND") return null;
  throw error; // it is there and does not load
});

const folder = mkdtempSync(join(tmpdir(), "antigrasp-3mf-"));
const bytes = (name) => {
  const read = readFileSync(join(folder, name));
  return read.buffer.slice(read.byteOffset, read.byteOffset + read.length);
};

before(() => {
  const binary = process.env.ANTIGRASP_BINARY;
  assert.ok(binary, "ANTIGRASP_BINARY: expected the path of the built binary");
  const call = (...words) => execFileSync(resolve(binary), words, { cwd: folder, stdio: "ignore" });
  call("dataset", "make", "prisms", "--count", "2", "--seed", "5", "--out", "p.h5");
  call("export", "p.h5", "--size-mm", "60", "--format", "3mf", "--out", "plate");
  call("export", "p.h5", "--size-mm", "60", "--out", "stl");
});
after(() => rmSync(folder, { recursive: true }));

describe("a plate of 3MF in three.js", () => {
  it(
    "has the objects of the STL files by their names, beside each other",
    { skip: jsdom ? false : "jsdom is not installed" },
    () => {
      globalThis.DOMParser = new jsdom.JSDOM("").window.DOMParser;
      const plate = new ThreeMFLoader().parse(bytes("plate/plate.3mf"));
      const meshes = [];
      plate.traverse((node) => node.isMesh && meshes.push(node));
      assert.equal(meshes.length, 2);
      let last = -Infinity;
      for (const [i, mesh] of meshes.entries()) {
        const stl = new STLLoader().parse(bytes(`stl/prisms-00000${i}.stl`));
        assert.equal(mesh.geometry.index.count, stl.getAttribute("position").count);
        assert.ok(Math.abs(volumeOf(mesh.geometry) / volumeOf(stl) - 1) < 1e-5);
        assert.ok(volumeOf(stl) > 1000, "millimetres, outside out");
        mesh.geometry.computeBoundingBox();
        const { min, max } = mesh.geometry.boundingBox;
        assert.equal(min.z, 0);
        assert.ok(Math.abs(min.x - last - 5) < 1e-4 || i === 0, "5 mm apart");
        last = max.x;
      }
    },
  );
});
