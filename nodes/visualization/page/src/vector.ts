// Vectors of three numbers, as plain tuples: for code that must not know about the renderer.

export type Vec3 = readonly [number, number, number];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, by: number): Vec3 => [a[0] * by, a[1] * by, a[2] * by];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: Vec3, b: Vec3): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
export const isFinite3 = (a: Vec3): boolean => Number.isFinite(a[0] + a[1] + a[2]);

export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** `from + (to - from) share`. */
export const lerp = (from: Vec3, to: Vec3, share: number): Vec3 => add(from, scale(sub(to, from), share));

/** The part of `a` perpendicular to the unit vector `normal`. */
export const reject = (a: Vec3, normal: Vec3): Vec3 => sub(a, scale(normal, dot(a, normal)));

/** Unit vector along `a`; `otherwise` where `a` has no direction. */
export function normalized(a: Vec3, otherwise: Vec3): Vec3 {
  const size = length(a);
  return size > 0 && Number.isFinite(size) ? scale(a, 1 / size) : otherwise;
}
