import { readFileSync, readdirSync } from "node:fs";
import { dirname } from "node:path";

const MARKERS = [
  [
    "report data",
    '<script type="application/json" id="antigrasp-report">"ANTIGRASP_REPORT_JSON"</script>',
    "ANTIGRASP_REPORT_JSON",
  ],
  [
    "geometry",
    '<script type="application/octet-stream" class="antigrasp-blob">ANTIGRASP_BLOB_BASE64</script>',
    "ANTIGRASP_BLOB_BASE64",
  ],
  ["title", "<title>ANTIGRASP_TITLE</title>", "ANTIGRASP_TITLE"],
];

/** Throws unless the file at `path` holds every marker exactly once, and is the only file beside it. */
export function checkTemplate(path) {
  const html = readFileSync(path, "utf8");
  for (const [what, element, word] of MARKERS) {
    const words = html.split(word).length - 1;
    if (!html.includes(element))
      throw new Error(`${path}: the marker of the ${what} is missing or was changed: ${element}`);
    if (words !== 1) throw new Error(`${path}: the marker of the ${what} occurs ${words} times, expected once`);
  }
  const external = html.match(/<(?:script|link|img)\b[^>]*\b(?:src|href)="(?!data:)[^"#]*"/g);
  if (external) throw new Error(`${path}: refers to other files: ${external.join(", ")}`);
  const others = readdirSync(dirname(path)).filter((name) => name !== "template.html");
  if (others.length) throw new Error(`${path}: not one file, beside it: ${others.join(", ")}`);
}
