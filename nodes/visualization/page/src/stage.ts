// The 3D picture: draws when something changed, once for each frame of the screen at most.
//
// Without a graphics card a picture costs what its pixels cost. It is then drawn without smoothing, with a bounded number
// of pixels, and once more in full when nothing moved for a moment.

import { AmbientLight, Color, DirectionalLight, Scene, WebGLRenderer } from "three";
import { Body } from "./body.ts";
import { OrbitCamera } from "./camera.ts";
import { ContactLaw } from "./chain.ts";
import { ChainOverlay } from "./chain_overlay.ts";
import { Colouring, type Scale } from "./colouring.ts";
import type { Quantity } from "./colours.ts";
import { DeviceObjects } from "./device_objects.ts";
import type { DeviceState } from "./frames.ts";
import { Organ } from "./organ.ts";
import { Strokes, type Rgb } from "./strokes.ts";

/** What of the picture can be chosen. */
export interface Look {
  quantity: Quantity;
  chains: boolean;
  axes: boolean;
  opacity: number;
  fullScaleM: number;
  forceScaleMPerN: number;
  displacementScale: number;
  probeRadiusM: number;
}

/** Most pixels of a picture that is drawn while something moves without a graphics card. */
const SOFTWARE_PIXELS = 1.0e6;
/** Most pixels of any picture. */
const MOST_PIXELS = 3840 * 2160;
/** Colours of x, y and z. */
const AXES = [0xd8404c, 0x3fa34d, 0x3d7de0] as const;
/** Without a graphics card: pause after a picture, as a share of the time it took, and at most, ms. */
const PAUSE_SHARE = 0.5;
const LONGEST_PAUSE_MS = 150;
/** Nothing moved for this long: draw once in full, ms. */
const STILL_MS = 220;

export class Stage {
  readonly orbit: OrbitCamera;
  readonly rendererName: string;
  /** Pictures drawn so far. */
  pictures = 0;
  onPicture: (() => void) | null = null;
  onScale: ((scale: Scale) => void) | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly overlay = new ChainOverlay();
  private readonly software: boolean;
  private organ: Organ | null = null;
  private colouring: Colouring | null = null;
  private readonly axes = new Strokes();
  private readonly deviceObjects: DeviceObjects[] = [];
  private devices: readonly DeviceState[] = [];
  private law: ContactLaw | null = null;
  private devicesChanged = false;
  private requested = 0;
  private earliestMs = 0;
  private pauseTimer: ReturnType<typeof setTimeout> | undefined;
  private stillTimer: ReturnType<typeof setTimeout> | undefined;
  private widthPx = 1;
  private heightPx = 1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private look: Look,
  ) {
    this.rendererName = nameOfRenderer();
    this.software = /swiftshader|llvmpipe|software|basic render/i.test(this.rendererName);
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, powerPreference: "high-performance" });
    this.orbit = new OrbitCamera(() => this.invalidate());
    const key = new DirectionalLight(0xffffff, 2.2);
    key.position.set(-0.45, 0.7, 0.85);
    this.orbit.camera.add(key);
    this.scene.add(this.orbit.camera, new AmbientLight(0xffffff, 1.1), this.overlay.strokes.object, this.axes.object);
    canvas.addEventListener("webglcontextrestored", () => this.invalidate());
  }

  /** Size in CSS pixels. */
  resize(widthPx: number, heightPx: number): void {
    [this.widthPx, this.heightPx] = [Math.max(widthPx, 1), Math.max(heightPx, 1)];
    this.orbit.resize(this.widthPx, this.heightPx);
    this.setPixelRatio(this.movingRatio());
    // A canvas that was resized is empty until it is drawn.
    this.drawNow();
  }

  setBackground(colour: string): void {
    this.scene.background = new Color().setStyle(colour);
    this.invalidate();
  }

  setBody(body: Body): void {
    const keepView = this.organ !== null && this.organ.body.vertexCount === body.vertexCount;
    if (this.organ) {
      this.scene.remove(this.organ.mesh);
      this.organ.dispose();
    }
    this.organ = new Organ(body);
    this.scene.add(this.organ.mesh);
    const { center, radius } = this.organ.bounds;
    if (!keepView) this.orbit.frame([center.x, center.y, center.z], radius);
    this.drawAxes(radius);
    this.recolour();
    this.applyLook();
  }

  setLaw(law: ContactLaw | null): void {
    this.law = law;
    this.devicesChanged = true;
    this.recolour();
  }

  setLook(change: Partial<Look>): void {
    const recolour = change.quantity !== undefined || change.fullScaleM !== undefined;
    this.look = { ...this.look, ...change };
    if (recolour) this.recolour();
    this.applyLook();
  }

  setDevices(devices: readonly DeviceState[]): void {
    const unchanged = devices.length === this.devices.length && devices.every((one, i) => looksLike(one, this.devices[i]));
    if (unchanged) return;
    this.devices = devices;
    this.devicesChanged = true;
    this.invalidate();
  }

  /** Something changed: draw at the next frame of the screen. Without a body there is nothing to draw, and no time to lose. */
  invalidate(): void {
    if (!this.organ) return;
    clearTimeout(this.stillTimer);
    if (this.requested !== 0 || this.pauseTimer !== undefined) return;
    const request = (): void => {
      this.pauseTimer = undefined;
      this.requested = requestAnimationFrame(() => this.draw(false));
    };
    const pauseMs = this.earliestMs - performance.now();
    if (pauseMs > 1) this.pauseTimer = setTimeout(request, pauseMs);
    else request();
  }

  /**
   * The picture in full, as PNG; `scale` times as many pixels each way as on the screen. `draw` adds to it, in CSS pixels: it
   * is given the size of the picture.
   */
  async png(scale: number, draw: (context: CanvasRenderingContext2D, widthPx: number, heightPx: number) => void): Promise<Blob> {
    const { widthPx, heightPx, canvas } = this;
    const most = Math.sqrt(MOST_PIXELS / (widthPx * heightPx));
    this.setPixelRatio(Math.min(window.devicePixelRatio * scale, Math.max(most, 1)));
    this.drawNow();
    const picture = document.createElement("canvas");
    [picture.width, picture.height] = [canvas.width, canvas.height];
    const context = picture.getContext("2d");
    if (context) {
      context.drawImage(canvas, 0, 0);
      context.scale(canvas.width / widthPx, canvas.height / heightPx);
      draw(context, widthPx, heightPx);
    }
    const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, "image/png"));
    this.invalidate();
    if (!blob || !context) throw new Error("this browser makes no PNG of the picture");
    return blob;
  }

  /** What the colours stand for; null: there is no body. */
  get scale(): Scale | null {
    return this.colouring?.scale ?? null;
  }

  get unitCount(): number {
    return this.overlay.unitCount;
  }

  drawNow(): void {
    cancelAnimationFrame(this.requested);
    if (this.organ) this.render();
    this.requested = 0;
  }

  private draw(still: boolean): void {
    this.requested = 0;
    const begunMs = performance.now();
    this.setPixelRatio(still ? this.stillRatio() : this.movingRatio());
    this.render();
    if (!this.software) return;
    // What draws without a graphics card takes the processor from whoever else is at work: leave it some.
    setTimeout(() => {
      const nowMs = performance.now();
      this.earliestMs = nowMs + Math.min(PAUSE_SHARE * (nowMs - begunMs), LONGEST_PAUSE_MS);
    });
    if (still) return;
    clearTimeout(this.stillTimer);
    this.stillTimer = setTimeout(() => {
      this.requested = requestAnimationFrame(() => this.draw(true));
    }, STILL_MS);
  }

  private render(): void {
    const { look } = this;
    const recolour = this.devicesChanged && look.quantity === "force";
    if (this.devicesChanged) this.placeDevices();
    this.devicesChanged = false;
    this.organ?.refresh(recolour, () => {
      if (this.colouring?.refresh(this.devices)) this.onScale?.(this.colouring.scale);
    });
    this.renderer.render(this.scene, this.orbit.camera);
    this.pictures += 1;
    this.onPicture?.();
  }

  private placeDevices(): void {
    const { look } = this;
    while (this.deviceObjects.length < this.devices.length) {
      const objects = new DeviceObjects();
      this.deviceObjects.push(objects);
      this.scene.add(objects.group);
    }
    this.deviceObjects.forEach((objects, i) => {
      objects.update(this.devices[i] ?? null, look.probeRadiusM, look.forceScaleMPerN, look.displacementScale);
    });
    this.overlay.update(this.devices, look.chains ? this.law : null, look.displacementScale);
  }

  private recolour(): void {
    if (!this.organ) return;
    this.colouring = new Colouring(this.organ.body, this.look.quantity, this.law, this.look.fullScaleM);
    this.organ.colourBy(this.colouring);
    this.colouring.refresh(this.devices);
    this.onScale?.(this.colouring.scale);
    this.invalidate();
  }

  private applyLook(): void {
    const { look } = this;
    this.organ?.setOpacity(look.opacity);
    this.organ?.body.setDisplacementScale(look.displacementScale);
    this.axes.object.visible = look.axes;
    this.devicesChanged = true;
    this.invalidate();
  }

  /** The body's frame, at its origin. */
  private drawAxes(radiusM: number): void {
    const [size, width] = [0.35 * radiusM, 0.008 * radiusM];
    this.axes.begin();
    AXES.forEach((hex, axis) => {
      const { r, g, b } = new Color(hex);
      const colour: Rgb = [r, g, b];
      this.axes.line([0, 0, 0], [axis === 0 ? size : 0, axis === 1 ? size : 0, axis === 2 ? size : 0], width, colour);
    });
    this.axes.end();
  }

  private movingRatio(): number {
    const wanted = Math.min(window.devicePixelRatio, 2);
    return this.bounded(wanted, this.software ? SOFTWARE_PIXELS : MOST_PIXELS);
  }

  private stillRatio(): number {
    return this.bounded(2 * Math.min(window.devicePixelRatio, 2), MOST_PIXELS);
  }

  private bounded(ratio: number, pixels: number): number {
    return Math.min(ratio, Math.sqrt(pixels / (this.widthPx * this.heightPx)));
  }

  private setPixelRatio(ratio: number): void {
    const [width, height] = [Math.floor(this.widthPx * ratio), Math.floor(this.heightPx * ratio)];
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.widthPx, this.heightPx, false);
    this.overlay.strokes.setPixels(width, height);
    this.axes.setPixels(width, height);
  }
}

/** Whether two states of a device give the same picture. */
function looksLike(one: DeviceState, other: DeviceState): boolean {
  const flags = (state: DeviceState): string =>
    [state.mode, state.contactHeard, state.forceHeard, state.poseHeard, state.saturated, state.clutched].join();
  const numbers = (state: DeviceState): readonly number[] =>
    [...state.probe, ...state.proxy, ...state.normal, ...state.force, ...state.handle, state.depthM];
  const others = numbers(other);
  return flags(one) === flags(other) && numbers(one).every((value, i) => Object.is(value, others[i]));
}

/** What draws: asked of a context that is made for the question alone. */
function nameOfRenderer(): string {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return "none";
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER) as string;
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return name;
}
