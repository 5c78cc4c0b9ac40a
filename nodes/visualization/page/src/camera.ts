// The camera that goes around the body: orbit, pan, zoom, reset. z is up, as in the frames of ROS.

import { PerspectiveCamera, Vector3 } from "three";
import type { Ray } from "./raycast.ts";
import type { Vec3 } from "./vector.ts";

/** Where the camera looks from: angles in rad, distance and target in m, body frame. */
export interface View {
  readonly azimuthRad: number;
  readonly elevationRad: number;
  readonly distanceM: number;
  readonly target: Vec3;
}

const FIELD_OF_VIEW_DEG = 28;
/** Looking straight up or down has no left and right. */
const STEEPEST_RAD = Math.PI / 2 - 0.02;
const HOME = { azimuthRad: -1.05, elevationRad: 0.62 } as const;

export class OrbitCamera {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.001, 10);
  private view: View = { ...HOME, distanceM: 1, target: [0, 0, 0] };
  private centre: Vec3 = [0, 0, 0];
  private radiusM = 0.1;
  private widthPx = 1;
  private heightPx = 1;

  constructor(private readonly onChange: () => void) {
    this.camera.up.set(0, 0, 1);
  }

  get current(): View {
    return this.view;
  }

  /** Size of the picture in CSS pixels. */
  resize(widthPx: number, heightPx: number): void {
    this.widthPx = widthPx;
    this.heightPx = heightPx;
    this.camera.aspect = widthPx / heightPx;
    this.set(this.view);
  }

  /** The body to look at; `reset` shows all of it. */
  frame(centre: Vec3, radiusM: number): void {
    this.centre = centre;
    this.radiusM = radiusM;
    this.reset();
  }

  reset(): void {
    const half = (FIELD_OF_VIEW_DEG * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    this.set({ ...HOME, distanceM: (1.02 * this.radiusM) / Math.sin(Math.atan(Math.tan(half) * narrow)), target: this.centre });
  }

  /** Turn around the target by a movement on the screen. */
  orbit(dxPx: number, dyPx: number): void {
    const { azimuthRad, elevationRad } = this.view;
    const perPixel = Math.PI / Math.max(this.heightPx, 300);
    this.set({
      ...this.view,
      azimuthRad: azimuthRad - dxPx * perPixel,
      elevationRad: elevationRad + dyPx * perPixel,
    });
  }

  /** Move the target with the cursor. */
  pan(dxPx: number, dyPx: number): void {
    const perPixel = this.metresPerPixel();
    const [right, up] = [new Vector3(), new Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, new Vector3());
    const move = right.multiplyScalar(-dxPx * perPixel).addScaledVector(up, dyPx * perPixel);
    const { target } = this.view;
    this.set({ ...this.view, target: [target[0] + move.x, target[1] + move.y, target[2] + move.z] });
  }

  /** Come nearer by a factor below 1, go away by one above. */
  zoom(factor: number): void {
    this.set({ ...this.view, distanceM: this.view.distanceM * factor });
  }

  set(view: View): void {
    const elevationRad = Math.min(Math.max(view.elevationRad, -STEEPEST_RAD), STEEPEST_RAD);
    const distanceM = Math.min(Math.max(view.distanceM, 0.05 * this.radiusM), 40 * this.radiusM);
    this.view = { ...view, elevationRad, distanceM };
    const { azimuthRad, target } = this.view;
    const level = Math.cos(elevationRad) * distanceM;
    const { camera } = this;
    camera.position.set(
      target[0] + level * Math.cos(azimuthRad),
      target[1] + level * Math.sin(azimuthRad),
      target[2] + Math.sin(elevationRad) * distanceM,
    );
    camera.lookAt(target[0], target[1], target[2]);
    camera.near = Math.max(0.02 * distanceM, 1e-4);
    camera.far = distanceM + 60 * this.radiusM;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.onChange();
  }

  /** Length of one CSS pixel at the distance of the target. */
  metresPerPixel(): number {
    return (2 * this.view.distanceM * Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360)) / this.heightPx;
  }

  /** Unit vector in which the camera looks. */
  direction(): Vec3 {
    const direction = this.camera.getWorldDirection(new Vector3());
    return [direction.x, direction.y, direction.z];
  }

  /** The ray through a point of the picture, CSS pixels from its upper left corner. */
  ray(xPx: number, yPx: number): Ray {
    const { position } = this.camera;
    const through = new Vector3((2 * xPx) / this.widthPx - 1, 1 - (2 * yPx) / this.heightPx, 0.5).unproject(this.camera);
    const direction = through.sub(position).normalize();
    return { origin: [position.x, position.y, position.z], direction: [direction.x, direction.y, direction.z] };
  }

  /** Where a point of the body frame is in the picture, CSS pixels; null: behind the camera. */
  project(point: Vec3): { x: number; y: number } | null {
    const projected = new Vector3(...point).project(this.camera);
    if (projected.z > 1) return null;
    return { x: ((projected.x + 1) / 2) * this.widthPx, y: ((1 - projected.y) / 2) * this.heightPx };
  }

  /** The body frame's axes as the camera sees them: right and up on the screen, and towards the viewer. */
  axes(): { x: Vec3; y: Vec3; z: Vec3 } {
    const e = this.camera.matrixWorldInverse.elements;
    return { x: [e[0], e[1], e[2]], y: [e[4], e[5], e[6]], z: [e[8], e[9], e[10]] };
  }
}
