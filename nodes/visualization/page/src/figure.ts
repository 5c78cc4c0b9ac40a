// The picture for a paper: what stands around the drawn body on the page, drawn onto it. The scale of the colours with its unit,
// the directions of the frame, and a length.

import type { OrbitCamera } from "./camera.ts";
import type { Scale } from "./colouring.ts";
import { colourScale, STEPS } from "./colours.ts";
import { AXES, armsOf, scaleBar } from "./frame_marks.ts";
import { labels, titleOf } from "./legend.ts";
import { colour } from "./theme.ts";

const FONT = "system-ui, sans-serif";

/** What a figure says besides the picture. */
export interface Captions {
  readonly scale: Scale;
  readonly orbit: OrbitCamera;
  /** Name of the frame that the axes are of. */
  readonly frame: string;
}

/** Draw the captions into a picture of a size in CSS pixels; `rem` is the height of the page's letters, px. */
export function caption(context: CanvasRenderingContext2D, widthPx: number, heightPx: number, rem: number, captions: Captions): void {
  const pen = new Pen(context, rem);
  drawScale(pen, captions.scale, Math.min(17 * rem, widthPx - 2 * rem));
  drawAxes(pen, captions.orbit, captions.frame, heightPx);
  drawScaleBar(pen, captions.orbit, widthPx, heightPx);
}

/** Text and lines that can be read over a body of any colour. */
class Pen {
  private readonly text = colour("text");
  private readonly halo = colour("stage");

  constructor(
    readonly context: CanvasRenderingContext2D,
    readonly rem: number,
  ) {
    context.lineJoin = "round";
    context.lineCap = "butt";
  }

  write(text: string, x: number, y: number, align: CanvasTextAlign, sizeRem = 1, style = this.text): void {
    const { context, rem } = this;
    context.font = `${sizeRem > 1 ? "600 " : ""}${sizeRem * rem}px ${FONT}`;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.lineWidth = 0.25 * rem;
    context.strokeStyle = this.halo;
    context.strokeText(text, x, y);
    context.fillStyle = style;
    context.fillText(text, x, y);
  }

  line(points: readonly (readonly [number, number])[], widthPx: number, style = this.text): void {
    const { context } = this;
    const path = (width: number, stroke: string): void => {
      context.beginPath();
      points.forEach(([x, y]) => context.lineTo(x, y));
      context.lineWidth = width;
      context.strokeStyle = stroke;
      context.stroke();
    };
    path(widthPx + 0.2 * this.rem, this.halo);
    path(widthPx, style);
  }
}

function drawScale(pen: Pen, scale: Scale, widthPx: number): void {
  const { context, rem } = pen;
  const strip = new OffscreenCanvas(STEPS, 1);
  strip.getContext("2d")?.putImageData(new ImageData(new Uint8ClampedArray(colourScale(scale.quantity)), STEPS, 1), 0, 0);
  pen.write(titleOf(scale.quantity), rem, 1.6 * rem, "left", 1.1);
  context.drawImage(strip, rem, 2.6 * rem, widthPx, 0.9 * rem);
  const [first, middle, last] = labels(scale);
  pen.write(first, rem, 4.3 * rem, "left");
  pen.write(middle, rem + widthPx / 2, 4.3 * rem, "center");
  pen.write(last, rem + widthPx, 4.3 * rem, "right");
  pen.write(scale.note, rem, 5.7 * rem, "left", 0.86);
}

function drawAxes(pen: Pen, orbit: OrbitCamera, frame: string, heightPx: number): void {
  const { rem } = pen;
  const [x, y, arm] = [3.6 * rem, heightPx - 4.7 * rem, 1.9 * rem];
  for (const { axis, right, up } of armsOf(orbit)) {
    const style = colour(`axis-${AXES[axis]}`);
    pen.line([[x, y], [x + arm * right, y - arm * up]], 0.15 * rem, style);
    pen.write(AXES[axis], x + 1.35 * arm * right, y - 1.35 * arm * up, "center", 1, style);
  }
  pen.write(`${frame} frame`, rem, heightPx - 1.2 * rem, "left");
}

function drawScaleBar(pen: Pen, orbit: OrbitCamera, widthPx: number, heightPx: number): void {
  const { rem } = pen;
  const bar = scaleBar(orbit, rem);
  const [left, right, low, high] = [widthPx - rem - bar.widthPx, widthPx - rem, heightPx - rem, heightPx - 1.45 * rem];
  pen.line([[left, high], [left, low], [right, low], [right, high]], 0.12 * rem);
  pen.write(bar.text, left, heightPx - 2.3 * rem, "left");
}
