// The page's sources without a browser, loaded through Vite, as the build does.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { createServer } from "vite";

/** `load` gives a module by its path, "/src/colours.ts". */
export async function sources() {
  const vite = await createServer({
    root: fileURLToPath(new URL("../..", import.meta.url)),
    configFile: false,
    server: { middlewareMode: true, hmr: false, watch: null },
    appType: "custom",
    logLevel: "error",
    optimizeDeps: { noDiscovery: true },
  });
  return { load: (path) => vite.ssrLoadModule(path), close: () => vite.close() };
}

export const near = (actual, expected, tolerance) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected} ± ${tolerance}`);

export const allNear = (actual, expected, tolerance) => {
  assert.equal(actual.length, expected.length);
  expected.forEach((x, i) => near(actual[i], x, tolerance));
};

export function asMesh({ positions, indices }) {
  const min = [0, 1, 2].map((k) => Math.min(...positions.filter((_, i) => i % 3 === k)));
  const max = [0, 1, 2].map((k) => Math.max(...positions.filter((_, i) => i % 3 === k)));
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices), min, max };
}

/** The exact cuboid with 8 vertices, half its extents and its centre. */
export function cuboidParts([a, b, c], [x0, y0, z0] = [0, 0, 0]) {
  const positions = [];
  for (const x of [-a, a]) for (const y of [-b, b]) for (const z of [-c, c]) positions.push(x + x0, y + y0, z + z0);
  const quads = [
    [0, 1, 3, 2],
    [4, 6, 7, 5],
    [0, 4, 5, 1],
    [2, 3, 7, 6],
    [0, 2, 6, 4],
    [1, 5, 7, 3],
  ];
  return { positions, indices: quads.flatMap(([p, q, r, s]) => [p, q, r, p, r, s]) };
}
export const cuboid = (half, centre) => asMesh(cuboidParts(half, centre));
