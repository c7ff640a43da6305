// The report as the binary writes it (report/*_report.cpp). null stands for a number that does not exist: NaN,
// not measured, not finished. Keys that are absent mean "not there"; unknown ones are ignored.

import type { Trials } from "./trials";

export type Num = number | null;
/** A part of the blob: where its stream begins, how long it is, how many bytes it becomes. */
export type Part = [offset: number, length: number, size: number];

export interface MeshRecord {
  vertices: number;
  triangles: number;
  positions: Part;
  indices: Part;
  min: [number, number, number];
  extent: number;
  full_triangles?: number;
}

export interface Score {
  graspability: Num;
  ci_low: Num;
  ci_high: Num;
  mean: Num;
  fraction_nonzero: Num;
  num_grasps: Num;
}

/** One solid with its measurement: the object itself, or the original it was made from. */
export interface Shape {
  label?: string;
  score: Score | null;
  mesh: MeshRecord | null;
  metres_per_unit: number;
  com?: [number, number, number] | null;
  grasps?: Part | null;
}

export interface Pair extends Shape {
  displacement?: Part | null;
  max_displacement?: Num;
}

export interface PrintCheck {
  size_mm?: [number, number, number] | null;
  wall_mm?: Num;
  watertight?: boolean | null;
  overhang?: Num;
  pose?: number[][] | null;
  pose_probability?: Num;
  notes?: string[];
}

export interface ObjectRecord extends Shape {
  name: string;
  group: number;
  status: string;
  elite?: boolean;
  /** Absent: true. False: picked by its score. */
  random?: boolean;
  pair?: Pair | null;
  numbers?: [string, string][];
  print?: PrintCheck | null;
  trials?: Trials | null;
}

export interface Stage {
  id: string;
  label: string;
  episode: number;
  control: boolean;
  samples: Num;
  statuses: [string, number][];
  graspability: { mean: Num; half_width: Num; count: Num } | null;
  elite_threshold?: Num;
  coverage?: Num;
  nna?: Num;
  duplicates?: Num;
  diversity?: Num;
  flat_share?: Num;
  crease_share?: Num;
  scores?: Num[] | null;
}

export interface Losses {
  episode: number;
  control: boolean;
  columns: Record<string, Num[]>;
}

export interface Gripper {
  palm_distance: number;
  fingertip_overlap: number;
  finger_width: number;
  finger_thickness: number;
  palm_depth: number;
  palm_length: number;
  palm_width: number;
}

export interface Metric {
  percentile?: Num;
  friction?: Num;
  num_grasps?: Num;
  num_draws?: Num;
  noise?: string | null;
  finger_radius?: Num;
  /** At which size objects are scored, in words. */
  size?: string | null;
}

export interface Report {
  title: string;
  kind: "run" | "perturbed" | "objects";
  missing: string[];
  provenance: [string, string][];
  config: string | null;
  metric: Metric | null;
  gripper: Gripper | null;
  run: { stages: Stage[]; losses: Losses[] } | null;
  /** Stages of the gallery; note: how their objects were chosen. */
  groups: { id: string; label: string; note?: string }[];
  objects: ObjectRecord[];
}

const VERSION = 2;

/** The report in this page; a sentence that says why there is none. */
export function readReport(text: string): Report | string {
  let raw: Partial<Report> & { format?: string; version?: number };
  try {
    raw = JSON.parse(text);
  } catch (error) {
    return `The data of this report cannot be read: ${(error as Error).message}.`;
  }
  if (typeof raw !== "object" || raw === null) {
    return "This is the empty page from which antigrasp makes reports: it holds no data. Write a report with: antigrasp report RUN --out report.html";
  }
  if (raw.format !== "antigrasp.report") return "The data in this page are not an antigrasp report.";
  if (raw.version !== VERSION)
    return `This page reads reports of version ${VERSION}; its data are of version ${String(raw.version)}.`;
  const objects = raw.objects ?? [];
  const groups = raw.groups?.length ? raw.groups : [{ id: "objects", label: "objects" }];
  return {
    title: raw.title ?? "",
    kind: raw.kind ?? "objects",
    missing: raw.missing ?? [],
    provenance: raw.provenance ?? [],
    config: raw.config ?? null,
    metric: raw.metric ?? null,
    gripper: raw.gripper ?? null,
    run: raw.run ? { stages: raw.run.stages ?? [], losses: raw.run.losses ?? [] } : null,
    groups,
    // An object of no known stage is shown with the first: no object is ever lost.
    objects: objects.map((object) => normalised(object, groups.length)),
  };
}

// Pages divide by the size and look the stage up: neither may be missing.
function normalised(object: ObjectRecord, groups: number): ObjectRecord {
  const size = (shape: Shape) => (shape.metres_per_unit > 0 ? shape.metres_per_unit : 1);
  const pair = object.pair ? { ...object.pair, metres_per_unit: size(object.pair) } : null;
  const group = object.group >= 0 && object.group < groups ? object.group : 0;
  return { ...object, group, pair, metres_per_unit: size(object) };
}

/** Graspability of an object, null where it was not measured. */
export function graspability(shape: Shape | null | undefined): Num {
  return shape?.score?.graspability ?? null;
}

// Scored like any other, on few grasps or none.
const USABLE = new Set(["ok", "few_grasps", "no_grasps"]);

/** True for what is no object: not a closed solid, or no printable result. It may still have a mesh and numbers. */
export function isRejected(object: ObjectRecord): boolean {
  return !USABLE.has(object.status);
}

/** What the status of a usable object says beyond "ok". */
export function remark(object: ObjectRecord): string {
  return isRejected(object) || object.status === "ok" ? "" : object.status.replace(/_/g, " ");
}
