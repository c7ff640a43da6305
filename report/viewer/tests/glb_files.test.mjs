// What `export --format glb` writes is for other programs: read by three.js and judged by Khronos' validator. A reader that
// is not installed is skipped by name.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const validator = await import("gltf-validator").catch((error) => {
  if (error.code === "ERR_MODULE_NOT_FOUND") return null;
  throw error; // it is there and does not load
});

const folder = mkdtempSync(join(tmpdir(), "antigrasp-glb-"));
const bytes = () => new Uint8Array(readFileSync(join(folder, "out", "prisms-000000.glb")));

before(() => {
  const binary = process.env.ANTIGRASP_BINARY;
  assert.ok(binary, "ANTIGRASP_BINARY: expected the path of the built binary");
  const call = (...words) => execFileSync(resolve(binary), words, { cwd: folder, stdio: "ignore" });
  call("dataset", "make", "prisms", "--count", "1", "--seed", "5", "--out", "p.h5");
  call("export", "p.h5", "--size-mm", "60", "--format", "glb", "--out", "out");
});
after(() => rmSync(folder, { recursive: true }));

describe("a solid as GLB", () => {
  const missing = validator ? false : "gltf-validator is not installed";
  it("has no error and no warning by the validator", { skip: missing }, async () => {
    const { issues, info } = await validator.default.validateBytes(bytes());
    assert.deepEqual(issues.messages, []);
    assert.equal(info.totalTriangleCount > 100, true);
  });

  it("stands on y = 0 in three.js, 60 mm long and outside out", async () => {
    const buffer = bytes().buffer;
    const { scene } = await new GLTFLoader().parseAsync(buffer, "");
    const meshes = [];
    scene.traverse((node) => node.isMesh && meshes.push(node));
    assert.equal(meshes.length, 1);
    const { geometry, name } = meshes[0];
    assert.equal(name, "prisms-000000");
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    assert.ok(Math.abs(min.y) < 1e-7);
    const sides = ["x", "y", "z"].map((axis) => max[axis] - min[axis]);
    assert.ok(Math.abs(Math.max(...sides) - 0.06) < 1e-6);
    const at = geometry.getAttribute("position");
    const corner = (i) => [at.getX(i), at.getY(i), at.getZ(i)];
    let volume = 0;
    for (let i = 0; i < geometry.index.count; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => corner(geometry.index.getX(i + k)));
      volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
    }
    assert.ok(volume > 0 && volume < sides[0] * sides[1] * sides[2]);
  });
});
