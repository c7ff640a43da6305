import type { Num, Stage } from "./report";
import { known } from "../format";

export interface Estimate {
  value: number;
  /** Half of the 95 % interval, null: unknown. */
  half: Num;
}

export function meanOf(stage: Stage | undefined): Estimate | null {
  const mean = stage?.graspability?.mean;
  return known(mean) ? { value: mean, half: stage!.graspability!.half_width ?? null } : null;
}

/** a / b of independent means, its interval by the delta method. */
export function ratio(a: Estimate | null, b: Estimate | null): Estimate | null {
  if (!a || !b || b.value === 0) return null;
  const value = a.value / b.value;
  const half =
    known(a.half) && known(b.half) ? Math.abs(value) * Math.hypot(a.half / a.value || 0, b.half / b.value) : null;
  return Number.isFinite(value) ? { value, half } : null;
}

/** Reduction of the mean by a change that every object underwent, relative to the mean before: paired, delta method. */
export function pairedReduction(before: number[], after: number[]): Estimate | null {
  const n = before.length;
  if (n === 0) return null;
  const mean = (x: number[]) => x.reduce((a, b) => a + b, 0) / n;
  const a = mean(after),
    b = mean(before);
  if (!(b > 0)) return null;
  const r = a / b;
  // The ratio's error is that of the mean of (after - r before) / b: what both have in common cancels.
  const residual = before.map((x, i) => (after[i] - r * x) / b);
  const variance = residual.reduce((sum, e) => sum + e * e, 0) / Math.max(1, n - 1);
  return { value: 1 - r, half: n > 1 ? 1.96 * Math.sqrt(variance / n) : null };
}

export interface Bin {
  x1: number;
  x2: number;
  share: number;
}

/** Edges of equal bins over [0, high], a round width, about `wanted` of them. */
export function binEdges(high: number, wanted: number): number[] {
  const raw = (high > 0 ? high : 1) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const width = power * ([1, 2, 2.5, 5, 10].find((m) => m * power >= raw) ?? 10);
  return Array.from({ length: Math.ceil((high > 0 ? high : 1) / width - 1e-9) + 1 }, (_, i) => i * width);
}

/** Shares of the values per bin; what lies beyond the last edge counts in the last bin. */
export function histogram(values: number[], edges: number[]): Bin[] {
  const bins = edges.slice(1).map((x2, i) => ({ x1: edges[i], x2, share: 0 }));
  const width = edges[1] - edges[0];
  for (const value of values) {
    const bin = Math.min(bins.length - 1, Math.max(0, Math.floor(value / width + 1e-12)));
    bins[bin].share += 1 / values.length;
  }
  return bins;
}

/** Stages by their part in the loop. */
export function stagesOf(stages: Stage[]) {
  const episodes = stages.filter((s) => !s.control && s.episode >= 0).sort((a, b) => a.episode - b.episode);
  return {
    prior: stages.find((s) => !s.control && s.episode < 0),
    episodes,
    first: episodes.find((s) => s.episode === 0),
    control: stages.filter((s) => s.control).sort((a, b) => a.episode - b.episode),
  };
}
