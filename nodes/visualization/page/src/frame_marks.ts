// The directions of the body's frame and a length on the screen: a small picture of the axes, and a scale bar in mm.

import type { OrbitCamera } from "./camera.ts";
import { h, write } from "./dom.ts";
import { niceBelow, short } from "./nice.ts";
import type { Vec3 } from "./vector.ts";

const SVG = "http://www.w3.org/2000/svg";
/** Names of the axes. */
export const AXES = ["x", "y", "z"] as const;
const ARM_PX = 26;
/** The bar is at most this long, in heights of the page's letters. */
const LONGEST_BAR_REM = 9;

export class FrameMarks {
  private readonly arms: { line: SVGElement; text: SVGElement }[];
  private readonly drawing: SVGElement;
  private readonly bar = h("div", { class: "bar-line" });
  private readonly barText = h("span");
  private readonly name = h("span", { class: "frame-name" });

  constructor(root: HTMLElement) {
    this.drawing = svg("svg", { viewBox: "-40 -40 80 80", class: "axes", role: "img", "aria-label": "Axes of the body's frame" });
    this.arms = AXES.map((axis) => {
      const line = svg("line", { class: `axis-${axis}`, x1: "0", y1: "0" });
      const text = svg("text", { class: `axis-${axis}` });
      text.textContent = axis;
      this.drawing.append(line, text);
      return { line, text };
    });
    const scaleBar = h("div", { class: "scale-bar" }, this.barText, this.bar);
    root.append(h("div", { class: "axes-block" }, this.drawing, this.name), scaleBar);
  }

  setFrame(name: string): void {
    write(this.name, `${name} frame`);
    this.name.title = `Everything is shown in the frame ${name}`;
  }

  update(orbit: OrbitCamera): void {
    for (const { axis, right, up } of armsOf(orbit)) {
      const { line, text } = this.arms[axis];
      line.setAttribute("x2", (ARM_PX * right).toFixed(1));
      line.setAttribute("y2", (-ARM_PX * up).toFixed(1));
      text.setAttribute("x", ((ARM_PX + 8) * right).toFixed(1));
      text.setAttribute("y", (-(ARM_PX + 8) * up).toFixed(1));
      this.drawing.append(line, text);
    }
    const bar = scaleBar(orbit, parseFloat(getComputedStyle(document.documentElement).fontSize));
    this.bar.style.width = `${bar.widthPx.toFixed(1)}px`;
    write(this.barText, bar.text);
  }
}

/** Where each axis points on the screen, in the order to draw them: what points away comes first. */
export function armsOf(orbit: OrbitCamera): { axis: number; right: number; up: number }[] {
  const { x, y, z } = orbit.axes();
  const axes: Vec3[] = [x, y, z];
  const order = [0, 1, 2].sort((one, other) => axes[one][2] - axes[other][2]);
  return order.map((axis) => ({ axis, right: axes[axis][0], up: axes[axis][1] }));
}

/** A length that people like, and its width on the screen, CSS px, at the distance of what is looked at. */
export function scaleBar(orbit: OrbitCamera, rem: number): { widthPx: number; text: string } {
  const perPixel = orbit.metresPerPixel();
  const lengthM = niceBelow(LONGEST_BAR_REM * rem * perPixel);
  return { widthPx: lengthM / perPixel, text: `${short(1000 * lengthM)} mm` };
}

function svg(tag: string, attributes: Readonly<Record<string, string>>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
