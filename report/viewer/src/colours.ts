// Ramps as lists of sRGB stops. Kept here and not taken from a library, because 3D and charts must agree.

type Rgb = [number, number, number];

const GREEN_RED: Rgb[] = [
  [214, 39, 40],
  [233, 120, 35],
  [236, 190, 50],
  [140, 190, 60],
  [26, 152, 80],
]; // worst to best, Fig. 1
const VIRIDIS: Rgb[] = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

function ramp(stops: Rgb[], t: number): Rgb {
  const x = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(x));
  const f = x - i;
  return [0, 1, 2].map((k) => Math.round(stops[i][k] + f * (stops[i + 1][k] - stops[i][k]))) as Rgb;
}

const DISTANCE: Rgb[] = [
  [36, 84, 130],
  [108, 157, 200],
  [196, 219, 237],
  [250, 249, 246],
  [250, 216, 172],
  [233, 152, 76],
  [178, 82, 14],
]; // outside, surface, inside

const css = ([r, g, b]: Rgb) => `rgb(${r}, ${g}, ${b})`;

/** Quality relative to the best of the page: 1 green, 0 red. */
export function qualityColour(relative: number): string {
  return css(ramp(GREEN_RED, relative));
}

/** Displacement relative to the largest. */
export function heatRgb(relative: number): Rgb {
  return ramp(VIRIDIS, relative);
}

/** Signed distance relative to the largest shown: -1 outside, 0 on the surface, 1 inside. */
export function distanceColour(relative: number): string {
  return css(ramp(DISTANCE, (relative + 1) / 2));
}

export const DISTANCE_GRADIENT = `linear-gradient(to right, ${DISTANCE.map(css).join(", ")})`;
export const HEAT_GRADIENT = `linear-gradient(to right, ${VIRIDIS.map(css).join(", ")})`;
export const QUALITY_GRADIENT = `linear-gradient(to right, ${GREEN_RED.map(css).join(", ")})`;
