import type { Num } from "./data/report";

export const NONE = "–";
const THIN = "\u202f";

/** True for a number that can be shown. */
export function known(value: Num | undefined): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

/** A number with so many digits after the point; a dash where there is none. */
export function fixed(value: Num | undefined, digits: number): string {
  return known(value) ? value.toFixed(digits).replace("-", "−") : NONE;
}

export function count(value: Num | undefined): string {
  return known(value) ? String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, THIN) : NONE;
}

export function percent(value: Num | undefined, digits = 0): string {
  return known(value) ? `${fixed(100 * value, digits)}${THIN}%` : NONE;
}

/** A name cut to fit into a chart, where text does not wrap. */
export function short(text: string, length = 18): string {
  return text.length > length ? `${text.slice(0, length - 1)}…` : text;
}

/** Graspability is a small number: shown in thousandths everywhere, the unit beside it. */
export function milli(value: Num | undefined, digits = 2): string {
  return known(value) ? fixed(1000 * value, digits) : NONE;
}

export const MILLI_UNIT = "×\u00a010⁻³";

export function plusMinus(value: Num | undefined, half: Num | undefined, digits: number): string {
  if (!known(value)) return NONE;
  return known(half) ? `${fixed(value, digits)} ± ${fixed(half, digits)}` : fixed(value, digits);
}
