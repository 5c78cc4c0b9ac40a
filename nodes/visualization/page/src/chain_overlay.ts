// The rhombi of all chains at every contact: rods, springs and mass points, in the colours of RViz.

import { Color } from "three";
import type { ContactLaw } from "./chain.ts";
import type { DeviceState } from "./frames.ts";
import { chainOfRow, displacedContact, Fan, isUnit, row, rowCount, spring, type Rhombus } from "./rhombi.ts";
import { Strokes, type Rgb } from "./strokes.ts";
import { cross, type Vec3 } from "./vector.ts";

const linear = (red: number, green: number, blue: number): Rgb => {
  const colour = new Color().setRGB(red, green, blue, "srgb");
  return [colour.r, colour.g, colour.b];
};

/** Rods of the parallel chains, one after the other. */
const RODS: readonly Rgb[] = [
  linear(0.3, 0.33, 0.39),
  linear(0.16, 0.42, 0.62),
  linear(0.47, 0.33, 0.64),
  linear(0.18, 0.5, 0.41),
];
const MASS_POINT = linear(0.96, 0.96, 0.93);
const NORMAL_SPRING = linear(0.2, 0.62, 0.95);
const TANGENTIAL_SPRING = linear(0.35, 0.8, 0.4);

/** Widths as shares of the unit's rod. */
const ROD_WIDTH = 0.07;
const SPRING_WIDTH = 0.035;
const MASS_POINT_DIAMETER = 0.2;
/** Zigzags of a spring by how often its rod is halved from the longest: those of small units would be a smear. */
const SPRING_TURNS = [3, 3, 1, 0];

export class ChainOverlay {
  readonly strokes = new Strokes();
  /** Units that are drawn now. */
  unitCount = 0;
  private readonly fans: Fan[] = [];

  /** Draw the chains of every device that touches; none without a law. */
  update(devices: readonly DeviceState[], law: ContactLaw | null, displacementScale: number): void {
    this.strokes.begin();
    this.unitCount = 0;
    devices.forEach((device, index) => {
      this.fans[index] ??= new Fan();
      const touches = device.contactHeard && device.mode !== "none" && isUnit(device.normal);
      if (law && touches) this.add(device, law, this.fans[index], displacementScale);
    });
    this.strokes.end();
  }

  private add(device: DeviceState, law: ContactLaw, fan: Fan, displacementScale: number): void {
    const shapes = law.shapesAt(device.depthM);
    const longestM = Math.max(...shapes.map((shape) => shape.rodLengthM));
    const contact = displacedContact(device, displacementScale);
    const { normal } = device;
    this.strokes.dot(contact, MASS_POINT_DIAMETER * longestM, MASS_POINT);
    const directions = fan.directions(normal, rowCount(shapes.length));
    directions.forEach((direction, i) => {
      const chain = chainOfRow(i, directions.length, shapes.length);
      const aside = cross(normal, direction);
      for (const rhombus of row(shapes[chain], { contact, normal, direction })) {
        this.unit(rhombus, RODS[chain % RODS.length], aside, turns(rhombus.rodM / longestM));
      }
    });
  }

  private unit({ tips, sides, rodM }: Rhombus, colour: Rgb, aside: Vec3, springTurns: number): void {
    for (const tip of tips) {
      for (const side of sides) this.strokes.line(tip, side, ROD_WIDTH * rodM, colour);
    }
    this.spring(sides[0], sides[1], aside, springTurns, SPRING_WIDTH * rodM, NORMAL_SPRING);
    this.spring(tips[0], tips[1], aside, springTurns, SPRING_WIDTH * rodM, TANGENTIAL_SPRING);
    for (const point of [tips[1], ...sides]) this.strokes.dot(point, MASS_POINT_DIAMETER * rodM, MASS_POINT);
    this.unitCount += 1;
  }

  private spring(from: Vec3, to: Vec3, aside: Vec3, springTurns: number, widthM: number, colour: Rgb): void {
    const corners = spring(from, to, aside, springTurns);
    for (let i = 1; i < corners.length; i += 1) this.strokes.line(corners[i - 1], corners[i], widthM, colour);
  }
}

function turns(shareOfLongest: number): number {
  const halvings = Math.ceil(-Math.log2(shareOfLongest) - 1e-9) - 1;
  return SPRING_TURNS[Math.min(Math.max(halvings, 0), SPRING_TURNS.length - 1)];
}
