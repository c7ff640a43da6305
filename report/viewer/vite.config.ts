import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { checkTemplate } from "./scripts/check_template.mjs";
import { programFirst } from "./scripts/program_first.mjs";

// The binary finds its three markers by their text and fills each once. A bundler that moved, doubled or escaped
// one of them would only show in a broken report, so the build itself refuses such a template.
function markersIntact(): Plugin {
  return {
    name: "antigrasp-markers",
    enforce: "post",
    writeBundle(options) {
      checkTemplate(`${options.dir}/template.html`);
    },
  };
}

// The program stands before the geometry and runs at once: a module would wait until the browser has read all of it.
function runsEarly(): Plugin {
  return {
    name: "antigrasp-program-first",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_, bundle) {
        const page = bundle["template.html"];
        if (page?.type === "asset") page.source = programFirst(String(page.source));
      },
    },
  };
}

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    // The polyfill fetches modules; nothing here may ask the network for anything.
    modulePreload: false,
    reportCompressedSize: false,
    rollupOptions: { input: "template.html" },
  },
  plugins: [viteSingleFile(), runsEarly(), markersIntact()],
});
