import { Quaternion, Vector3 } from "three";
import { bytesOf } from "./blob";
import type { Num, Part } from "./report";

export type Side = "before" | "after";
export type Vec3 = [number, number, number];

/** One object under one protocol: the share of executions that was held, with its 95 % interval. */
export interface TrialSeries {
  protocol: string;
  side: Side;
  /** "own", "equal" or empty. */
  masses?: string;
  friction: Num;
  held: Num;
  low: Num;
  high: Num;
}

/** One grasp of a series: how many of its executions were held. */
export interface TrialGrasp {
  series: number;
  grasp: number;
  quality: Num;
  held: number;
  executions: number;
  outcomes: [string, number][];
}

export type Tip = { kind: "sphere"; radius: number } | { kind: "pad"; half: Vec3 };

/** An execution to look at; metres, the gripper's frame. */
export interface Replay {
  protocol: string;
  side?: Side;
  grasp: number;
  execution: number;
  outcome: string;
  friction: Num;
  metres_per_unit: number;
  tip: Tip;
  up: Vec3;
  frames: Part;
}

export interface Frame {
  t: number;
  /** x, y, z, then the rotation w, x, y, z. */
  object: number[];
  tips: [Vec3, Vec3];
  /** Where, and the force on the object. */
  forces: number[][];
  table?: Num;
}

export interface Trials {
  series: TrialSeries[];
  grasps: TrialGrasp[];
  replays: Replay[];
}

/** True for a word that says the object stayed in the hand. */
export function isHeld(outcome: string): boolean {
  return outcome.startsWith("held");
}

/** The frames of a replay; none where they cannot be read (said on the console). */
export function framesOf(replay: Replay): Frame[] {
  try {
    return JSON.parse(new TextDecoder().decode(bytesOf(replay.frames))) as Frame[];
  } catch (error) {
    console.warn("antigrasp: a replay cannot be decoded", error);
    return [];
  }
}

/** What is to be drawn at a time: poses between two frames, contacts of the earlier one. */
export interface Moment {
  position: Vector3;
  rotation: Quaternion;
  tips: [Vector3, Vector3];
  forces: number[][];
  table: number | null;
}

const place = ([x, y, z]: number[]) => new Vector3(x, y, z);
const turn = ([, , , w, x, y, z]: number[]) => new Quaternion(x, y, z, w).normalize();

/** Before the first frame and after the last one nothing moves. There is at least one frame. */
export function momentAt(frames: Frame[], t: number): Moment {
  let next = frames.findIndex((frame) => frame.t > t);
  if (next < 0) next = frames.length;
  const a = frames[Math.max(0, next - 1)];
  const b = frames[Math.min(frames.length - 1, next)];
  const share = b.t > a.t ? Math.min(1, Math.max(0, (t - a.t) / (b.t - a.t))) : 0;
  const tip = (k: 0 | 1) => place(a.tips[k]).lerp(place(b.tips[k]), share);
  const table = a.table ?? null;
  return {
    position: place(a.object).lerp(place(b.object), share),
    rotation: turn(a.object).slerp(turn(b.object), share),
    tips: [tip(0), tip(1)],
    forces: a.forces,
    table: table !== null && typeof b.table === "number" ? table + share * (b.table - table) : table,
  };
}

/** Two replays that tell the most side by side: one held, one lost, of the same protocol if there are such. */
export function firstPair(replays: Replay[]): number[] {
  const held = replays.findIndex((r) => isHeld(r.outcome));
  const lost = (like?: Replay) =>
    replays.findIndex((r) => !isHeld(r.outcome) && (!like || (r.protocol === like.protocol && r.side === like.side)));
  if (held < 0) return replays.length > 1 ? [0, 1] : replays.map((_, i) => i);
  const other = lost(replays[held]) >= 0 ? lost(replays[held]) : lost();
  if (other >= 0) return [held, other];
  return replays.length > 1 ? [held, held === 0 ? 1 : 0] : [held];
}
