import { Script } from "node:vm";

const MODULE = /<script type="module"[^>]*>([^]*?)<\/script>\n?/g;
const GEOMETRY = /<script type="application\/octet-stream"/;

/**
 * The page with its one module as a plain script in front of the geometry. Throws where that would not be the same
 * program: more modules than one, imports, a top-level await.
 */
export function programFirst(html) {
  const modules = [...html.matchAll(MODULE)];
  if (modules.length !== 1) throw new Error(`expected one module in the page, found ${modules.length}`);
  const program = `(() => {"use strict";${modules[0][1]}})();`;
  new Script(program);
  if (!GEOMETRY.test(html)) throw new Error("the page has no element for the geometry");
  return html.replace(MODULE, "").replace(GEOMETRY, (element) => `<script>${program}</script>\n    ${element}`);
}
