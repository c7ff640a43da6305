// Reports of the real thing: a smoke run and perturbed objects, made by the binary in ANTIGRASP_BINARY.
import { execFile } from "node:child_process";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { folder } from "./browser.mjs";

const SMOKE = fileURLToPath(new URL("../../../../configs/smoke.toml", import.meta.url));

async function antigrasp(...args) {
  const binary = process.env.ANTIGRASP_BINARY;
  if (!binary)
    throw new Error(
      "ANTIGRASP_BINARY: expected the path of the built binary, for example ../build/release/bin/antigrasp",
    );
  await promisify(execFile)(resolve(binary), args, { cwd: folder, maxBuffer: 1 << 26 });
}

// The shortest run with all a report shows: an episode after 0, its control, a row of losses.
const SHORT = [
  "cem.episodes=1",
  "cem.prior_iterations=10",
  "cem.iterations=1",
  "cem.samples=12",
  "cem.keep=4",
  "cem.prior_scored=8",
  "cem.compared=8",
  "prior.count=16",
];

/** Path of the report of a finished smoke run. */
export async function runReport() {
  await antigrasp("train", SMOKE, ...SHORT.flatMap((setting) => ["--set", setting]), "--out", "run");
  await antigrasp("report", "run", "--per-stage", "10", "--out", "run.html");
  return join(folder, "run.html");
}

/** Path of the report of objects changed by random perturbation, and their number. */
export async function perturbedReport() {
  const count = 5;
  await antigrasp("dataset", "make", "cylinders", "--count", String(count), "--seed", "1", "--out", "cylinders.h5");
  await antigrasp("perturb", "random", "cylinders.h5", "--out", "random");
  await antigrasp("report", "random", "--out", "random.html");
  return { path: join(folder, "random.html"), count };
}
