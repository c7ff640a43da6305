type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;
type Child = Node | string | null | undefined | false;

/**
 * An element with attributes, listeners (keys that begin with "on") and children. Strings become text nodes, never
 * markup: names of objects come from files and may hold anything.
 */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(key.slice(2), value as EventListener);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** Rows of text as a table; the first cell of each row is its header. Numbers belong to the right. */
export function table(header: string[], rows: string[][], caption: string): HTMLElement {
  const head = h("tr", {}, ...header.map((text) => h("th", { scope: "col" }, text)));
  const body = rows.map((row) =>
    h("tr", {}, ...row.map((text, i) => (i === 0 ? h("th", { scope: "row" }, text) : h("td", {}, text)))),
  );
  const element = h(
    "table",
    {},
    h("caption", { class: "hidden" }, caption),
    h("thead", {}, head),
    h("tbody", {}, ...body),
  );
  // Wide tables scroll in their own box, which the keyboard must reach.
  return h("div", { class: "table-box", tabindex: 0, role: "region", "aria-label": caption }, element);
}

export function details(summary: string, ...children: Child[]): HTMLDetailsElement {
  return h("details", {}, h("summary", {}, summary), ...children);
}
