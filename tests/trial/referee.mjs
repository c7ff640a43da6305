// Plays the scenes of referee_scenes in MuJoCo 3, by its own contacts on convex meshes and with phases of fixed length,
// and compares what is held. node referee.mjs SCENES_PROGRAM VIEWER_FOLDER [fixed]; exit code 0 where enough outcomes are equal,
// 1 where not, 77 where the package is missing.
// node referee.mjs SCENES_PROGRAM VIEWER_FOLDER objects FRICTION GRASPS FOLDER...: the meshes of folders, as convex parts;
// prints what is held, here and there, and paired by name against the first folder (docs/perturbation.md).
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const EQUAL = 0.95; // of the outcomes
const FEWEST = 300; // outcomes
const MARGIN = 0.0002; // of a contact; the surfaces are drawn back by it, so that they rest where they meet
const PACKAGE = "@mujoco/mujoco";

// What "held" means: the same rule as ours (trial/execution.cpp).
const STILL = 0.001,
  STILL_SECONDS = 0.01; // m/s
const LOST_SECONDS = 0.03; // without a touch of one fingertip
const GONE = 0.08,
  MET = 0.0002; // m
const LIFT_SPEED = 0.1,
  LIFT_ACCELERATION = 1.0;

const [scenesProgram, viewer, ...pace] = process.argv.slice(2);

async function loadPackage() {
  let place;
  try {
    place = createRequire(pathToFileURL(`${viewer}/package.json`)).resolve(PACKAGE);
  } catch {
    console.log(`skipped: npm's ${PACKAGE} is not in ${viewer}/node_modules (npm ci there)`);
    process.exit(77);
  }
  return (await import(pathToFileURL(place))).default();
}

// Plane, body, two fingertips, as trial/mujoco_engine.cpp has them; the body's geom is MuJoCo's own mesh.
function mjcf(all, solid) {
  const solref = `${3.5 * all.time_step} 1`;
  const tip = (name, axis) => `<body name="${name}"><joint name="${name}" type="slide" axis="${axis} 0 0"/>
    <inertial pos="0 0 0" mass="${all.finger_mass}" diaginertia="1 1 1"/>
    <geom name="${name}" type="sphere" size="${all.tip_radius - MARGIN}" contype="0" conaffinity="0"/>
    <site name="${name}" type="sphere" size="${2 * all.tip_radius}"/></body>`;
  const pair = (name, condim) =>
    solid.parts.map((_, k) => `<pair geom1="${name}" geom2="part${k}" condim="${condim}" margin="${MARGIN}"
    solref="${solref}" solimp="0.99 0.999 0.0001"/>`).join("");
  return `<mujoco><option timestep="${all.time_step}" gravity="0 0 0" cone="elliptic" impratio="100" solver="Newton"
    tolerance="1e-8"/>
   <asset>${solid.parts.map((corners, k) => `<mesh name="part${k}" vertex="${corners.flat().join(" ")}"/>`).join("")}</asset>
   <worldbody>
    <body name="table" mocap="true"><geom name="table" type="plane" size="1 1 1" contype="0" conaffinity="0"/></body>
    <body name="solid"><freejoint/>
     <inertial pos="0 0 0" mass="${solid.mass}" diaginertia="${solid.inertia.join(" ")}"/>
     ${solid.parts.map((_, k) => `<geom name="part${k}" type="mesh" mesh="part${k}" contype="0" conaffinity="0"/>`).join("")}</body>
    ${tip("tip1", 1)} ${tip("tip2", -1)}
   </worldbody>
   <equality><joint joint1="tip1" joint2="tip2" polycoef="0 1 0 0 0" solref="${solref}"/></equality>
   <contact>${pair("table", 3)} ${pair("tip1", 4)} ${pair("tip2", 4)}</contact>
   <sensor><touch site="tip1"/><touch site="tip2"/></sensor></mujoco>`;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a) => Math.sqrt(dot(a, a));
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

// The rotation that takes z to the unit vector `up`.
function turnOf(up) {
  if (up[2] < -1 + 1e-12) return [0, 1, 0, 0];
  const q = [1 + up[2], -up[1], up[0], 0];
  const norm = Math.hypot(...q);
  return q.map((x) => x / norm);
}

class Solid {
  constructor(mujoco, all, solid) {
    Object.assign(this, { mujoco, all, solid });
    this.model = mujoco.MjModel.from_xml_string(mjcf(all, solid));
    this.data = new mujoco.MjData(this.model);
    this.radius = Math.max(...solid.parts.flat().map(length));
  }

  // "closing", "lifting" or "loading": where it was lost; "held".
  play(scene) {
    this.begin(scene);
    if (!this.close()) return "closing";
    this.closed = [...this.qpos.slice(0, 3)];
    if (!this.lift()) return "lifting";
    this.setTable(-1e3);
    for (const way of [
      [0, 0, -1],
      [0, 0, 1],
      [1, 0, 0],
      [-1, 0, 0],
      [0, 1, 0],
      [0, -1, 0],
    ]) {
      this.accelerate(way.map((x) => this.all.gravity * x));
      if (!this.steps(this.all.load_seconds)) return "loading";
    }
    return "held";
  }

  begin(scene) {
    const { all, model, data } = this;
    this.scene = scene;
    const friction = model.pair_friction; // tangential, tangential, torsional (a length), rolling, rolling
    const parts = this.solid.parts.length;
    [all.table_friction, scene.friction, scene.friction].forEach((mu, pairs) => {
      for (let k = 0; k < parts; ++k) friction.set([mu, mu, mu * all.torsion], 5 * (pairs * parts + k));
    });
    const out = 0.5 * scene.opening + all.tip_radius;
    model.body_pos.set([-out, 0, 0, out, 0, 0], 9);
    this.mujoco.mj_resetData(model, data);
    // Views of the engine's memory, kept: they are costly to get.
    this.qpos = data.qpos;
    this.qvel = data.qvel;
    this.qfrc = data.qfrc_applied;
    this.xfrc = data.xfrc_applied;
    this.touch = data.sensordata;
    this.mocap = data.mocap_pos;
    this.qpos.set([...scene.place, ...scene.turn, 0, 0]);
    data.mocap_quat.set(turnOf(scene.up));
    this.setTable(scene.table);
    this.weight = scene.up.map((x) => -all.gravity * x);
    this.accelerate(this.weight);
    Object.assign(this, { touched: false, sinceBoth: 0, closed: null });
  }

  setTable(height) {
    this.mocap.set(this.scene.up.map((x) => (height - MARGIN) * x));
  }

  accelerate(acceleration) {
    this.xfrc.set(
      acceleration.map((x) => this.solid.mass * x),
      6 * 2,
    ); // of body 2: world, table, solid
  }

  step() {
    const { all, qvel, touch } = this;
    for (const dof of [6, 7]) this.qfrc[dof] = all.force * (1 - qvel[dof] / all.close_speed);
    this.mujoco.mj_step(this.model, this.data);
    const first = touch[0] > 0,
      second = touch[1] > 0;
    this.sinceBoth = first && second ? 0 : this.sinceBoth + all.time_step;
    this.touched ||= first || second;
  }

  pressed() {
    return this.touched && this.sinceBoth < 0.5 * LOST_SECONDS;
  }
  met() {
    return this.scene.opening - this.qpos[7] - this.qpos[8] < MET;
  }
  move() {
    return length(minus(this.qpos, this.closed));
  }

  close() {
    const { all, qvel } = this;
    const dt = all.time_step;
    for (let t = 0, still = 0; t < all.close_seconds; t += this.touched ? dt : 0) {
      this.step();
      const speed = length(qvel.slice(0, 3)) + length(qvel.slice(3, 6)) * this.radius;
      const jaws = Math.abs(0.5 * (qvel[6] + qvel[7]));
      still = this.pressed() && speed < STILL && jaws < STILL ? still + dt : 0;
      if (still > STILL_SECONDS) return true;
      if (this.met()) return false;
    }
    return this.pressed() && !this.met();
  }

  lift() {
    const { all, scene } = this;
    const ramp = LIFT_SPEED / LIFT_ACCELERATION;
    for (let t = 0; t < all.lift_height / LIFT_SPEED + 0.5 * ramp; t += all.time_step) {
      const speeding = t < ramp;
      this.accelerate(this.weight.map((x, k) => x - (speeding ? LIFT_ACCELERATION * scene.up[k] : 0)));
      this.setTable(scene.table - (speeding ? 0.5 * LIFT_ACCELERATION * t * t : LIFT_SPEED * (t - 0.5 * ramp)));
      this.step();
      if (this.gone()) return false;
    }
    return this.pressed() && !this.met();
  }

  steps(seconds) {
    for (let t = 0; t < seconds; t += this.all.time_step) {
      this.step();
      if (this.gone()) return false;
    }
    return this.pressed() && !this.met();
  }

  // For good: nothing brings it back between the jaws.
  gone() {
    return this.met() || this.sinceBoth > LOST_SECONDS || this.move() > GONE;
  }

  end() {
    this.data.delete();
    this.model.delete();
  }
}

const mujoco = await loadPackage();
const all = JSON.parse(execFileSync(scenesProgram, pace, { encoding: "utf8", maxBuffer: 1 << 30 }));

// [{ scene, theirs }] of a solid; what began in a collision is nothing to play.
function playAll(solid) {
  const scenes = solid.scenes.filter((scene) => scene.outcome !== "started in collision");
  if (scenes.length === 0) return [];
  const body = new Solid(mujoco, all, solid);
  const played = scenes.map((scene) => ({ scene, theirs: body.play(scene) }));
  body.end();
  return played;
}

const same = ({ scene, theirs }) => scene.held === (theirs === "held");
const percent = (part, whole) => `${((100 * part) / whole).toFixed(1)} %`;

function testConvexSolids() {
  const others = [];
  let played = 0,
    equal = 0,
    held = 0;
  for (const solid of all.solids) {
    for (const one of playAll(solid)) {
      const { scene, theirs } = one;
      ++played;
      held += scene.held ? 1 : 0;
      if (same(one)) ++equal;
      else
        others.push(
          `${solid.name}, grasp ${scene.grasp}, execution ${scene.draw}: ${scene.outcome} here, ` +
            `${theirs === "held" ? "held" : `lost ${theirs}`} there (friction ${scene.friction.toFixed(3)})` +
            (scene.penetration > 1e-4 ? `, not trusted: ${(1000 * scene.penetration).toFixed(2)} mm deep` : ""),
        );
    }
  }
  const share = equal / played;
  console.log(
    `${all.solids.length} convex solids. MuJoCo ${all.engine} with our contacts, MuJoCo ${mujoco.mj_versionString()} with its own: ` +
      `${equal} of ${played} outcomes equal (${percent(equal, played)}), ${held} held here; the others:`,
  );
  for (const line of others) console.log(`  ${line}`);
  if (played < FEWEST) console.log(`expected at least ${FEWEST} outcomes`);
  if (share < EQUAL) console.log(`expected at least ${100 * EQUAL} % equal`);
  return played < FEWEST || share < EQUAL ? 1 : 0;
}

// Mean and 95 % half width (normal) of numbers.
function interval(numbers) {
  const mean = numbers.reduce((a, b) => a + b, 0) / numbers.length;
  const variance = numbers.reduce((a, b) => a + (b - mean) ** 2, 0) / (numbers.length - 1);
  return `${mean.toFixed(1)} +-${(1.96 * Math.sqrt(variance / numbers.length)).toFixed(1)}`;
}

function compareFolders() {
  const folders = new Map(); // name of the folder -> name of the object -> percent held, here and there
  for (const solid of all.solids) {
    const played = playAll(solid);
    if (!folders.has(solid.group)) folders.set(solid.group, new Map());
    if (played.length === 0) continue;
    const share = (holds) => (100 * played.filter(holds).length) / played.length;
    folders.get(solid.group).set(solid.name, {
      played: played.length,
      equal: played.filter(same).length,
      here: share(({ scene }) => scene.held),
      there: share(({ theirs }) => theirs === "held"),
    });
    console.error(`${solid.group} ${solid.name}: ${played.length} executions`);
  }
  const first = folders.values().next().value;
  console.log("folder, objects, executions, equal outcomes, held here, held there, change here, change there (paired by name)");
  for (const [folder, objects] of folders) {
    const rows = [...objects];
    const executions = rows.reduce((sum, [, row]) => sum + row.played, 0);
    const equal = rows.reduce((sum, [, row]) => sum + row.equal, 0);
    const mean = (side) => (rows.reduce((sum, [, row]) => sum + row[side], 0) / rows.length).toFixed(1);
    const pairs = rows.filter(([name]) => first.has(name));
    const change = (side) => interval(pairs.map(([name, row]) => row[side] - first.get(name)[side]));
    const changes = objects === first ? ["", ""] : [`${change("here")} (${pairs.length})`, change("there")];
    console.log([folder, rows.length, executions, percent(equal, executions), mean("here"), mean("there"), ...changes].join(", "));
  }
  return 0;
}

process.exit(pace[0] === "objects" ? compareFolders() : testConvexSolids());
