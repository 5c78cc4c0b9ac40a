// Probe, proxy and force arrow of each device.

import {
  Color,
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";
import type { DeviceState } from "./frames.ts";
import { displacedContact, isUnit } from "./rhombi.ts";

const PROBE = new Color(0x9fb0c6);
const PROXY = new Color(0x1fc4d6);
const FORCE = new Color(0x2f7ff0);
/** A chain is past its guard. */
const SATURATED = new Color(0xe0245e);

/** An arrow shorter than this would be a dot. */
const SHORTEST_ARROW_M = 1e-4;

const SPHERE = new SphereGeometry(1, 32, 20);
const DOT = new SphereGeometry(1, 16, 10);
const SHAFT = new CylinderGeometry(1, 1, 1, 16, 1).translate(0, 0.5, 0);
const HEAD = new ConeGeometry(1, 1, 20, 1).translate(0, 0.5, 0);
const UP = new Vector3(0, 1, 0);

/** What one device is drawn with. */
export class DeviceObjects {
  readonly group = new Group();
  private readonly probe = mesh(SPHERE, new MeshLambertMaterial({ color: PROBE, transparent: true, opacity: 0.82 }));
  private readonly handle = mesh(SPHERE, new MeshLambertMaterial({ color: PROBE, transparent: true, opacity: 0.25 }));
  private readonly proxy = mesh(DOT, new MeshBasicMaterial({ color: PROXY, depthTest: false, transparent: true }));
  private readonly shaft: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly head: Mesh<BufferGeometry, MeshLambertMaterial>;

  constructor() {
    const force = new MeshLambertMaterial({ color: FORCE, emissive: FORCE, emissiveIntensity: 0.25 });
    this.shaft = new Mesh(SHAFT, force);
    this.head = new Mesh(HEAD, force);
    this.proxy.renderOrder = 4;
    this.probe.renderOrder = 3;
    this.group.add(this.probe, this.handle, this.proxy, this.shaft, this.head);
    this.update(null, 1, 1, 1);
  }

  /** `null`: nothing is known of the device. */
  update(state: DeviceState | null, radiusM: number, metrePerNewton: number, displacementScale: number): void {
    const at = state?.contactHeard ? state.probe : state?.poseHeard ? state.handle : null;
    this.probe.visible = at !== null;
    this.handle.visible = false;
    this.proxy.visible = false;
    this.shaft.visible = this.head.visible = false;
    if (!state || !at) return;
    this.probe.position.set(...at);
    this.probe.scale.setScalar(radiusM);
    this.probe.material.opacity = state.clutched ? 0.4 : 0.82;
    // Held by the clutch the handle is elsewhere than the probe.
    if (state.clutched && state.poseHeard) {
      this.handle.visible = true;
      this.handle.position.set(...state.handle);
      this.handle.scale.setScalar(radiusM);
    }
    if (state.contactHeard && state.mode !== "none" && isUnit(state.normal)) {
      this.proxy.visible = true;
      this.proxy.position.set(...displacedContact(state, displacementScale));
      this.proxy.scale.setScalar(0.22 * radiusM);
    }
    if (state.forceHeard) this.arrow(state, at, radiusM, metrePerNewton);
  }

  private arrow(state: DeviceState, at: readonly number[], radiusM: number, metrePerNewton: number): void {
    const force = new Vector3(...state.force).multiplyScalar(metrePerNewton);
    const lengthM = force.length();
    if (!(lengthM >= SHORTEST_ARROW_M)) return;
    const colour = state.saturated ? SATURATED : FORCE;
    this.shaft.material.color.copy(colour);
    this.shaft.material.emissive.copy(colour);
    const headM = Math.min(1.6 * radiusM, 0.5 * lengthM);
    const direction = force.divideScalar(lengthM);
    this.shaft.visible = this.head.visible = true;
    this.shaft.position.set(at[0], at[1], at[2]);
    this.shaft.quaternion.setFromUnitVectors(UP, direction);
    this.shaft.scale.set(0.2 * radiusM, lengthM - headM, 0.2 * radiusM);
    this.head.position.copy(this.shaft.position).addScaledVector(direction, lengthM - headM);
    this.head.quaternion.copy(this.shaft.quaternion);
    this.head.scale.set(0.52 * radiusM, headM, 0.52 * radiusM);
  }
}

function mesh<M extends MeshBasicMaterial | MeshLambertMaterial>(geometry: BufferGeometry, material: M): Mesh<BufferGeometry, M> {
  return new Mesh(geometry, material);
}
