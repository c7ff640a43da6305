// What `bundle` writes is for other programs: MJCF in MuJoCo 3.14, URDF in urdf-loader, USDA in three.js and tinyusdz. A
// reader that is not installed is skipped by name.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { Mesh } from "three";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { USDAParser } from "three/addons/loaders/usd/USDAParser.js";
import { USDLoader } from "three/addons/loaders/USDLoader.js";

const require = createRequire(import.meta.url);

async function reader(name) {
  let place;
  try {
    place = require.resolve(name);
  } catch {
    return null;
  }
  return import(pathToFileURL(place)); // one that is there and does not load fails the test
}
const [mujocoPackage, jsdom, urdfLoader, tinyusdz] = await Promise.all(
  ["@mujoco/mujoco", "jsdom", "urdf-loader", "tinyusdz/tinyusdz.js"].map(reader),
);
const without = (...readers) => readers.find(([, found]) => !found)?.[0].concat(" is not installed") ?? false;

const folder = mkdtempSync(join(tmpdir(), "antigrasp-bundle-"));
const NAME = "3-way mug & co";
const made = join(folder, "out", NAME);
const text = (file) => readFileSync(join(made, file), "utf8");
const buffer = (path) => {
  const bytes = readFileSync(path);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
};
const near = (a, b, share = 1e-6) => Math.abs(a - b) <= share * Math.abs(b);
let row; // of bundle.csv, by column

before(() => {
  const binary = process.env.ANTIGRASP_BINARY;
  assert.ok(binary, "ANTIGRASP_BINARY: expected the path of the built binary");
  const call = (...words) => execFileSync(resolve(binary), words, { cwd: folder, stdio: "ignore" });
  call("dataset", "make", "prisms", "--count", "1", "--seed", "5", "--out", "p.h5");
  call("export", "p.h5", "--size-mm", "60", "--out", "stl");
  execFileSync("mv", ["stl/prisms-000000.stl", `${NAME}.stl`], { cwd: folder });
  call("bundle", `${NAME}.stl`, "--scale", "true", "--units", "mm", "--mass", "0.03", "--out", "out");
  const lines = readFileSync(join(folder, "out", "bundle.csv"), "utf8")
    .trim()
    .split("\n");
  const [names, values] = lines.map((line) => line.split(","));
  row = Object.fromEntries(names.map((name, i) => [name, values[i]]));
});
after(() => rmSync(folder, { recursive: true }));

const center = () => ["com_x", "com_y", "com_z"].map((column) => Number(row[column]));

// Six times the volume under the triangles of a mesh of three.js.
function volume({ geometry }) {
  const at = geometry.getAttribute("position");
  const count = geometry.index ? geometry.index.count : at.count;
  let sum = 0;
  for (let i = 0; i < count; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const j = geometry.index ? geometry.index.getX(i + k) : i + k;
      return [at.getX(j), at.getY(j), at.getZ(j)];
    });
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}
const solid = () => volume(new Mesh(new STLLoader().parse(buffer(join(made, `${NAME}.stl`)))));

describe("MJCF in MuJoCo 3", { skip: without(["@mujoco/mujoco", mujocoPackage]) }, () => {
  it("has the mass and the centre that were written, and a geom a part", async () => {
    const mujoco = await mujocoPackage.default();
    const vfs = new mujoco.MjVFS();
    for (const file of readdirSync(made).filter((name) => name.endsWith(".stl"))) {
      vfs.addBuffer(file, new Uint8Array(readFileSync(join(made, file))));
    }
    const model = mujoco.MjModel.from_xml_string(text(`${NAME}.xml`), vfs);
    assert.equal(model.nbody, 2);
    assert.equal(model.ngeom, 1 + Number(row.parts));
    assert.ok(near(model.body_mass[1], 0.03));
    center().forEach((x, axis) => assert.ok(near(model.body_ipos[3 + axis], x)));
    model.delete();
  });

  it("lets the box of friction 0.14 fall and keeps that of 0.16", async () => {
    const mujoco = await mujocoPackage.default();
    const model = mujoco.MjModel.from_xml_string(text("self_check.xml"));
    const data = new mujoco.MjData(model);
    while (data.time < 2) mujoco.mj_step(model, data);
    const height = (name) => data.xpos[3 * mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY.value, name) + 2];
    assert.ok(height("falls") < 0.2);
    assert.ok(Math.abs(height("stays") - 0.3) < 0.001);
    data.delete();
    model.delete();
  });
});

describe("URDF in urdf-loader", { skip: without(["urdf-loader", urdfLoader], ["jsdom", jsdom]) }, () => {
  it("is one link with its mass, a mesh that is seen and a collider a part", () => {
    const { DOMParser, Document, Element } = new jsdom.JSDOM().window;
    Object.assign(globalThis, { DOMParser, Document, Element });
    const loader = new urdfLoader.default();
    loader.parseCollision = true;
    const loaded = [];
    loader.loadMeshCb = (path, _manager, _material, done) => {
      loaded.push(path.slice(made.length + 1));
      done(new Mesh(new STLLoader().parse(buffer(path))));
    };
    const robot = loader.parse(text(`${NAME}.urdf`), `${made}/`);
    assert.deepEqual(Object.keys(robot.links), [NAME]);
    const { children, inertial } = robot.links[NAME];
    assert.ok(near(inertial.mass, 0.03));
    center().forEach((x, axis) => assert.ok(near(inertial.origin.xyz[axis], x)));
    const kinds = children.map((child) => child.type);
    assert.equal(kinds.filter((kind) => kind === "URDFVisual").length, 1);
    assert.equal(kinds.filter((kind) => kind === "URDFCollider").length, Number(row.parts));
    assert.deepEqual(
      loaded.sort(),
      readdirSync(made)
        .filter((file) => file.endsWith(".stl"))
        .sort(),
    );
    assert.ok(near(volume(children.find((child) => child.type === "URDFVisual").children[0]), solid()));
  });
});

describe("USDA in three.js", () => {
  it("has the mesh in metres, and a convex one a part", () => {
    const group = new USDLoader().parse(text(`${NAME}.usda`));
    const meshes = new Map();
    group.traverse((node) => node.isMesh && meshes.set(node.name, node));
    assert.ok(near(volume(meshes.get("visual")), solid(), 1e-4));
    assert.equal([...meshes.keys()].filter((name) => name.startsWith("part_")).length, Number(row.parts));
    for (const mesh of meshes.values()) assert.ok(volume(mesh) > 0);
  });

  it("has a rigid body with the mass and the centre that were written, and friction on every part", () => {
    const stage = new USDAParser().parseText(text(`${NAME}.usda`));
    assert.equal(stage["#usda 1.0"].defaultPrim, '"_3_way_mug___co"');
    const body = stage['def Xform "_3_way_mug___co"'];
    assert.equal(body["prepend apiSchemas"], '["PhysicsRigidBodyAPI", "PhysicsMassAPI"]');
    assert.ok(near(Number(body["float physics:mass"]), 0.03));
    const place = body["point3f physics:centerOfMass"].slice(1, -1).split(",").map(Number);
    center().forEach((x, axis) => assert.ok(near(place[axis], x)));
    const parts = Object.entries(body).filter(([name]) => name.startsWith('def Mesh "part_'));
    assert.equal(parts.length, Number(row.parts));
    for (const [, part] of parts) {
      assert.equal(part["uniform token physics:approximation"], '"convexHull"');
      assert.equal(part["rel material:binding:physics"], "</_3_way_mug___co/friction>");
    }
    assert.equal(body['def Material "friction"']["float physics:staticFriction"], "0.5");
  });
});

describe("USDA in tinyusdz", { skip: without(["tinyusdz", tinyusdz]) }, () => {
  const load = async (file) => {
    const wasmBinary = readFileSync(require.resolve("tinyusdz/tinyusdz.wasm"));
    // It is built for browsers and refuses Node.js, but needs no more than a window.
    globalThis.window = globalThis;
    process.type = "renderer";
    const native = await tinyusdz.default({ wasmBinary });
    delete globalThis.window;
    delete process.type;
    const stage = new native.TinyUSDZLoaderNative();
    assert.ok(stage.loadFromBinary(new Uint8Array(readFileSync(join(made, file))), file), stage.error());
    return stage;
  };
  it("loads as a stage with every mesh", async () => {
    const stage = await load(`${NAME}.usda`);
    assert.equal(stage.numMeshes(), 1 + Number(row.parts));
  });
  it("loads the self-check", async () => {
    await load("self_check.usda");
  });
});
