// Where the pointer wants the hand: from a point on the surface, or a ray, to a target for the probe's centre (m, body
// frame).

import type { Hit, Ray } from "./raycast.ts";
import { add, dot, isFinite3, scale, sub, type Vec3 } from "./vector.ts";

/** Height of the probe's lowest point over the surface while nothing is pressed, m. */
export const HOVER_M = 0.01;
/** Depth with which a grasp begins, m. */
export const GRASP_DEPTH_M = 0.001;
/** Range and default of the depth to press, m. */
export const DEPTHS_M = { least: 0, most: 0.02, first: 0.006, step: 0.001 } as const;

/** The probe's centre when it is pressed into the surface by a depth; a negative depth is a height above it. */
export function pressTarget(hit: Hit, probeRadiusM: number, depthM: number): Vec3 {
  return add(hit.point, scale(hit.normal, probeRadiusM - depthM));
}

/** The probe's centre above the surface. */
export function hoverTarget(hit: Hit, probeRadiusM: number): Vec3 {
  return pressTarget(hit, probeRadiusM, -HOVER_M);
}

/**
 * The target of a pull: where the ray meets the plane through `anchor` that faces the camera, `towardsCameraM` nearer to
 * it. Null when the ray does not meet the plane in front of the camera.
 */
export function pullTarget(ray: Ray, anchor: Vec3, viewDirection: Vec3, towardsCameraM: number): Vec3 | null {
  const along = dot(ray.direction, viewDirection);
  const distance = dot(sub(anchor, ray.origin), viewDirection) / along;
  if (!(distance > 0)) return null;
  const point = add(ray.origin, scale(ray.direction, distance));
  const target = sub(point, scale(viewDirection, towardsCameraM));
  return isFinite3(target) ? target : null;
}

/** A depth inside its range. */
export function allowedDepth(depthM: number): number {
  return Math.min(Math.max(depthM, DEPTHS_M.least), DEPTHS_M.most);
}
