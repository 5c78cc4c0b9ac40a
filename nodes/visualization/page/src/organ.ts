// The body as the renderer draws it: shaded, coloured by a value at each vertex.
//
// The shader looks colours up in a texture, so an update writes one number for each vertex; light comes from behind
// the viewer's left shoulder and wherever the camera goes, so that shading tells shape and never hides a colour.

import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  DynamicDrawUsage,
  LinearFilter,
  Mesh,
  RGBAFormat,
  ShaderMaterial,
  Sphere,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { Body, Range } from "./body.ts";
import type { Colouring } from "./colouring.ts";
import { colourScale, STEPS, type Quantity } from "./colours.ts";

const VERTEX = /* glsl */ `
attribute float share;
varying float vShare;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vShare = share;
  vNormal = normalMatrix * normal;
  vView = view.xyz;
  gl_Position = projectionMatrix * view;
}`;

const FRAGMENT = /* glsl */ `
uniform sampler2D scale;
uniform float opacity;
varying float vShare;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec3 flatNormal = normalize(cross(dFdx(vView), dFdy(vView)));
  vec3 towards = normalize(-vView);
  vec3 normal = normalize(vNormal);
  // Edges of a block are edges: where the face turns far from its vertices' normals, the face decides.
  float crease = dot(normal, flatNormal) * (gl_FrontFacing ? 1.0 : -1.0);
  if (abs(crease) < 0.82) normal = flatNormal;
  if (dot(normal, towards) < 0.0) normal = -normal;
  vec3 base = texture2D(scale, vec2(clamp(vShare, 0.0, 1.0) * ${((STEPS - 1) / STEPS).toFixed(8)} + ${(0.5 / STEPS).toFixed(8)}, 0.5)).rgb;
  // Past the end of the scale: the last colour, hatched.
  if (vShare > 1.02 && fract((gl_FragCoord.x + gl_FragCoord.y) / 12.0) < 0.25) base *= 0.55;
  vec3 key = normalize(vec3(-0.45, 0.7, 0.85));
  float diffuse = max(dot(normal, key), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  float facing = max(dot(normal, towards), 0.0);
  vec3 light = vec3(0.46 + 0.22 * sky) + vec3(0.92, 0.91, 0.89) * diffuse;
  vec3 shaded = base * light;
  float shine = pow(max(dot(normal, normalize(key + towards)), 0.0), 42.0);
  shaded += vec3(0.12) * shine + vec3(0.02, 0.023, 0.03) * pow(1.0 - facing, 3.0);
  gl_FragColor = vec4(shaded, opacity);
  #include <colorspace_fragment>
}`;

const textures = new Map<Quantity, DataTexture>();

/** The scale as a texture of one row. */
function scaleTexture(quantity: Quantity): DataTexture {
  const made = textures.get(quantity);
  if (made) return made;
  const texture = new DataTexture(colourScale(quantity), STEPS, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = LinearFilter;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  textures.set(quantity, texture);
  return texture;
}

/** Number of pieces above which one upload of everything is cheaper. */
const MOST_RANGES = 48;

export class Organ {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  /** Middle and radius of the body at rest, m. */
  readonly bounds = new Sphere();
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private share: BufferAttribute;
  private colouring: Colouring | null = null;

  constructor(readonly body: Body) {
    const dynamic = (values: Float32Array, size: number): BufferAttribute =>
      new BufferAttribute(values, size).setUsage(DynamicDrawUsage);
    this.position = dynamic(body.positions, 3);
    this.normal = dynamic(body.normals, 3);
    this.share = dynamic(new Float32Array(body.vertexCount), 1);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("normal", this.normal);
    geometry.setAttribute("share", this.share);
    geometry.setIndex(new BufferAttribute(body.corners, 1));
    this.boundRest(body.rest);
    geometry.boundingSphere = this.bounds;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      uniforms: {
        scale: { value: scaleTexture("displacement") },
        opacity: { value: 1 },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Colour by other values. */
  colourBy(colouring: Colouring): void {
    this.colouring = colouring;
    this.share = new BufferAttribute(colouring.shares, 1).setUsage(DynamicDrawUsage);
    this.mesh.geometry.setAttribute("share", this.share);
    this.mesh.material.uniforms.scale.value = scaleTexture(colouring.scale.quantity);
  }

  /** Bring normals and colours up to date and say what to upload. `recolour`: the values of the colours changed. */
  refresh(recolour: boolean, refreshColours: () => void): void {
    const pieces = this.body.refresh();
    if (pieces.length > 0) {
      for (const [attribute, size] of [[this.position, 3], [this.normal, 3]] as const) upload(attribute, size, pieces);
    }
    if ((pieces.length > 0 || recolour) && this.colouring) {
      refreshColours();
      // Which vertices have another colour is not known when only the force changed.
      if (recolour) upload(this.share, 1, [[0, this.body.vertexCount]]);
      else upload(this.share, 1, pieces);
    }
  }

  setOpacity(opacity: number): void {
    const { material } = this.mesh;
    material.uniforms.opacity.value = opacity;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  private boundRest(rest: Float32Array): void {
    const [low, high] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
    const point = new Vector3();
    for (let i = 0; i < rest.length; i += 3) {
      point.set(rest[i], rest[i + 1], rest[i + 2]);
      low.min(point);
      high.max(point);
    }
    this.bounds.center.addVectors(low, high).multiplyScalar(0.5);
    this.bounds.radius = Math.max(low.distanceTo(high) / 2, 1e-6);
  }
}

function upload(attribute: BufferAttribute, size: number, pieces: readonly Range[]): void {
  // Ranges wait until a picture is drawn; many small ones cost more than everything at once.
  if (attribute.updateRanges.length + pieces.length > MOST_RANGES) {
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, attribute.array.length);
  } else {
    for (const [first, count] of pieces) attribute.addUpdateRange(size * first, size * count);
  }
  attribute.needsUpdate = true;
}
