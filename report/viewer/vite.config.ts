import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { checkTemplate } from "./scripts/check_template.mjs";

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

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    // The polyfill fetches modules; nothing here may ask the network for anything.
    modulePreload: false,
    reportCompressedSize: false,
    rollupOptions: { input: "template.html" },
  },
  plugins: [viteSingleFile(), markersIntact()],
});
