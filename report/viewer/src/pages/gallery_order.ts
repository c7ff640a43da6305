import { graspability, isRejected, type ObjectRecord, type Report } from "../data/report";

export type SortKey = "stored" | "ascending" | "descending" | "name";
export type StatusFilter = "all" | "accepted" | "elite" | "rejected";

/** What the gallery shows, and how. Outlives the page: who comes back from an object finds the gallery as it was. */
export interface GalleryState {
  groups: Set<number>;
  sort: SortKey;
  byStage: boolean;
  status: StatusFilter;
  text: string;
  together: boolean;
  scroll: number;
}

export interface Section {
  /** -1: objects of all stages in one. */
  group: number;
  objects: number[];
}

let state: GalleryState | null = null;

export function galleryState(report: Report): GalleryState {
  state ??= {
    groups: new Set(report.groups.map((_, i) => i)),
    sort: "stored",
    byStage: true,
    status: "all",
    text: "",
    together: true,
    scroll: 0,
  };
  return state;
}

function passes(object: ObjectRecord, s: GalleryState): boolean {
  if (!s.groups.has(object.group)) return false;
  if (s.status === "accepted" && isRejected(object)) return false;
  if (s.status === "rejected" && !isRejected(object)) return false;
  if (s.status === "elite" && !object.elite) return false;
  return !s.text || object.name.toLowerCase().includes(s.text.toLowerCase());
}

const names = new Intl.Collator("en", { numeric: true });

/** Indices into report.objects. What has no graspability comes last, whichever way the rest is sorted. */
function ordered(report: Report, objects: number[], sort: SortKey): number[] {
  if (sort === "stored") return objects;
  const byName = (a: number, b: number) => names.compare(report.objects[a].name, report.objects[b].name) || a - b;
  if (sort === "name") return [...objects].sort(byName);
  const sign = sort === "ascending" ? 1 : -1;
  return [...objects].sort((a, b) => {
    const x = graspability(report.objects[a]),
      y = graspability(report.objects[b]);
    if (x === null || y === null) return x === y ? byName(a, b) : x === null ? 1 : -1;
    return sign * (x - y) || byName(a, b);
  });
}

/** The gallery's sections from top to bottom; stages without an object that passes are left out. */
export function gallerySections(report: Report, s: GalleryState): Section[] {
  const all = report.objects.map((_, i) => i).filter((i) => passes(report.objects[i], s));
  if (!s.byStage || report.groups.length < 2)
    return all.length ? [{ group: -1, objects: ordered(report, all, s.sort) }] : [];
  return report.groups
    .map((_, group) => ({
      group,
      objects: ordered(
        report,
        all.filter((i) => report.objects[i].group === group),
        s.sort,
      ),
    }))
    .filter((section) => section.objects.length > 0);
}

/** All objects in the order of the gallery: what "next" means on the object page. */
export function galleryOrder(report: Report): number[] {
  return gallerySections(report, galleryState(report)).flatMap((section) => section.objects);
}
