/** A page on the screen; dispose() stops what it left running. */
export interface Page {
  element: HTMLElement;
  title: string;
  /** After the element has been put into the document: what needs its size. */
  mounted?: () => void;
  dispose?: () => void;
}

export type Route = { page: "overview" } | { page: "gallery" } | { page: "object" | "replay"; index: number };

export function parseRoute(hash: string): Route {
  const path = hash.replace(/^#\/?/, "");
  if (path === "gallery") return { page: "gallery" };
  const object = /^object\/(\d+)$/.exec(path);
  if (object) return { page: "object", index: Number(object[1]) };
  const replay = /^object\/(\d+)\/replay$/.exec(path);
  if (replay) return { page: "replay", index: Number(replay[1]) };
  return { page: "overview" };
}

export function objectLink(index: number): string {
  return `#/object/${index}`;
}

export function replayLink(index: number): string {
  return `${objectLink(index)}/replay`;
}
