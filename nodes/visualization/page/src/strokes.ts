// Many straight strokes and round dots in two draw calls: rods, springs and mass points.
//
// A stroke is a flat piece that always faces the camera, shaded as the cylinder it stands for, and never thinner than a
// pixel. A dot is a sphere in the same way.

import {
  DynamicDrawUsage,
  BufferAttribute,
  GreaterDepth,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LessEqualDepth,
  Mesh,
  Object3D,
  ShaderMaterial,
  Vector2,
} from "three";
import type { Vec3 } from "./vector.ts";

export type Rgb = readonly [number, number, number];

const STROKE_VERTEX = /* glsl */ `
attribute vec3 from;
attribute vec3 to;
attribute vec4 paint;
uniform vec2 pixels;
varying vec3 vColour;
varying float vAcross;
void main() {
  vec4 a = modelViewMatrix * vec4(from, 1.0);
  vec4 b = modelViewMatrix * vec4(to, 1.0);
  vec4 at = mix(a, b, position.x);
  vec3 along = b.xyz - a.xyz;
  vec3 aside = cross(along, at.xyz);
  float size = length(aside);
  aside = size > 0.0 ? aside / size : vec3(0.0, 1.0, 0.0);
  // One pixel at this distance.
  float pixel = -at.z * 2.0 / (projectionMatrix[1][1] * pixels.y);
  at.xyz += aside * position.y * 0.5 * max(paint.w, 1.2 * pixel);
  vColour = paint.rgb;
  vAcross = position.y;
  gl_Position = projectionMatrix * at;
}`;

const DOT_VERTEX = /* glsl */ `
attribute vec4 place;
attribute vec3 paint;
uniform vec2 pixels;
varying vec3 vColour;
varying vec2 vPlace;
void main() {
  vec4 at = modelViewMatrix * vec4(place.xyz, 1.0);
  float pixel = -at.z * 2.0 / (projectionMatrix[1][1] * pixels.y);
  at.xyz += vec3(position.xy, 0.6) * 0.5 * max(place.w, 2.5 * pixel);
  vColour = paint;
  vPlace = position.xy;
  gl_Position = projectionMatrix * at;
}`;

const STROKE_FRAGMENT = /* glsl */ `
uniform float opacity;
varying vec3 vColour;
varying float vAcross;
void main() {
  float front = sqrt(max(1.0 - vAcross * vAcross, 0.0));
  gl_FragColor = vec4(vColour * (0.55 + 0.45 * front), opacity);
  #include <colorspace_fragment>
}`;

const DOT_FRAGMENT = /* glsl */ `
uniform float opacity;
varying vec3 vColour;
varying vec2 vPlace;
void main() {
  float squared = dot(vPlace, vPlace);
  if (squared > 1.0) discard;
  vec3 normal = vec3(vPlace, sqrt(1.0 - squared));
  float light = 0.5 + 0.5 * max(dot(normal, normalize(vec3(-0.4, 0.6, 0.7))), 0.0);
  gl_FragColor = vec4(vColour * light, opacity);
  #include <colorspace_fragment>
}`;

/** Opacity of what lies behind the surface. */
const BEHIND = 0.22;

/** Instances of one shape, drawn twice: what is seen, and faintly what the surface hides. */
class Instances {
  readonly object = new Object3D();
  private readonly geometry = new InstancedBufferGeometry();
  private readonly buffers: readonly { name: string; size: number }[];
  private capacity = 0;
  private count = 0;

  constructor(
    vertexShader: string,
    fragmentShader: string,
    corners: readonly number[],
    pixels: { value: Vector2 },
    buffers: readonly { name: string; size: number }[],
  ) {
    this.buffers = buffers;
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
    this.geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.geometry.instanceCount = 0;
    for (const behind of [true, false]) {
      const material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        uniforms: { pixels, opacity: { value: behind ? BEHIND : 1 } },
        transparent: behind,
        depthFunc: behind ? GreaterDepth : LessEqualDepth,
        depthWrite: !behind,
      });
      const mesh = new Mesh(this.geometry, material);
      mesh.frustumCulled = false;
      // What is hidden is drawn first, or every stroke would hide the strokes behind it.
      mesh.renderOrder = behind ? 1 : 2;
      this.object.add(mesh);
    }
  }

  begin(): void {
    this.count = 0;
  }

  end(): void {
    this.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
    for (const { name, size } of this.buffers) {
      const attribute = this.geometry.getAttribute(name) as InstancedBufferAttribute | undefined;
      if (!attribute) continue;
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, size * this.count);
      attribute.needsUpdate = true;
    }
  }

  /** Index of a new instance. */
  next(): number {
    if (this.count === this.capacity) this.grow();
    this.count += 1;
    return this.count - 1;
  }

  array(name: string): Float32Array {
    return this.geometry.getAttribute(name).array as Float32Array;
  }

  private grow(): void {
    const capacity = Math.max(1024, 2 * this.capacity);
    for (const { name, size } of this.buffers) {
      const values = new Float32Array(size * capacity);
      if (this.capacity > 0) values.set(this.array(name));
      this.geometry.setAttribute(name, new InstancedBufferAttribute(values, size).setUsage(DynamicDrawUsage));
    }
    // A buffer has one size in the graphics memory: let the renderer make new ones.
    this.geometry.dispose();
    this.capacity = capacity;
  }
}

export class Strokes {
  readonly object = new Object3D();
  private readonly pixels = { value: new Vector2(1, 1) };
  private readonly lines = new Instances(
    STROKE_VERTEX,
    STROKE_FRAGMENT,
    [0, -1, 0, 1, -1, 0, 0, 1, 0, 1, 1, 0],
    this.pixels,
    [{ name: "from", size: 3 }, { name: "to", size: 3 }, { name: "paint", size: 4 }],
  );
  private readonly dots = new Instances(
    DOT_VERTEX,
    DOT_FRAGMENT,
    [-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0],
    this.pixels,
    [{ name: "place", size: 4 }, { name: "paint", size: 3 }],
  );

  constructor() {
    this.object.add(this.lines.object, this.dots.object);
  }

  /** Size of the picture in its own pixels. */
  setPixels(width: number, height: number): void {
    this.pixels.value.set(width, height);
  }

  begin(): void {
    this.lines.begin();
    this.dots.begin();
  }

  line(from: Vec3, to: Vec3, widthM: number, colour: Rgb): void {
    const i = this.lines.next();
    this.lines.array("from").set(from, 3 * i);
    this.lines.array("to").set(to, 3 * i);
    const paint = this.lines.array("paint");
    paint.set(colour, 4 * i);
    paint[4 * i + 3] = widthM;
  }

  dot(at: Vec3, diameterM: number, colour: Rgb): void {
    const i = this.dots.next();
    const place = this.dots.array("place");
    place.set(at, 4 * i);
    place[4 * i + 3] = diameterM;
    this.dots.array("paint").set(colour, 3 * i);
  }

  end(): void {
    this.lines.end();
    this.dots.end();
  }
}
