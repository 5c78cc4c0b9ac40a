// Colour scales: from a share of the full scale to a colour.
//
// Each is a path through OKLab (Ottosson 2020) on which lightness only rises: more is always seen as more, in print without
// colour and with any colour vision. The first one is RViz's (src/colour.rs of this node).

export type Quantity = "displacement" | "force" | "stiffness";

/** Colours of a scale; more would not be told apart. */
export const STEPS = 256;

type Lab = readonly [number, number, number];

const CORNERS: Readonly<Record<Quantity, readonly Lab[]>> = {
  // Dark red of an organ at rest to a pale yellow.
  displacement: [
    [0.37, 0.077, 0.0359],
    [0.486, 0.0932, 0.0674],
    [0.602, 0.0881, 0.1049],
    [0.718, 0.0619, 0.1366],
    [0.834, 0.0186, 0.1388],
    [0.95, -0.0148, 0.0837],
  ],
  // Dark violet through magenta to a pale rose.
  force: [
    [0.35, 0.032, -0.05],
    [0.465, 0.098, -0.088],
    [0.585, 0.152, -0.054],
    [0.7, 0.132, 0.02],
    [0.82, 0.074, 0.05],
    [0.94, 0.0195, 0.028],
  ],
  // Dark blue through teal to a pale green.
  stiffness: [
    [0.35, -0.006, -0.075],
    [0.47, -0.04, -0.072],
    [0.585, -0.082, -0.034],
    [0.7, -0.103, 0.018],
    [0.82, -0.1, 0.07],
    [0.94, -0.06, 0.095],
  ],
};

/** The scale from nothing to everything: red, green, blue, alpha (sRGB, 0 to 255) of each step. */
export function colourScale(quantity: Quantity): Uint8Array {
  const corners = CORNERS[quantity];
  const colours = new Uint8Array(4 * STEPS);
  for (let step = 0; step < STEPS; step += 1) {
    const along = (step / (STEPS - 1)) * (corners.length - 1);
    const corner = Math.min(Math.floor(along), corners.length - 2);
    const share = along - corner;
    const [lightness, a, b] = [0, 1, 2].map((i) => corners[corner][i] * (1 - share) + corners[corner + 1][i] * share);
    const [red, green, blue] = srgbFromOklab(lightness, a, b);
    colours.set([Math.round(255 * red), Math.round(255 * green), Math.round(255 * blue), 255], 4 * step);
  }
  return colours;
}

/** Whether every corner of a scale is a colour that a screen has. */
export function cornersInGamut(quantity: Quantity): boolean {
  return CORNERS[quantity].every(([lightness, a, b]) =>
    linearFromOklab(lightness, a, b).every((part) => part > 0 && part < 1),
  );
}

function srgbFromOklab(lightness: number, a: number, b: number): number[] {
  return linearFromOklab(lightness, a, b).map((part) => Math.min(Math.max(encoded(part), 0), 1));
}

function linearFromOklab(lightness: number, a: number, b: number): number[] {
  const l = (lightness + 0.39633778 * a + 0.21580376 * b) ** 3;
  const m = (lightness - 0.105561346 * a - 0.06385417 * b) ** 3;
  const s = (lightness - 0.08948418 * a - 1.2914855 * b) ** 3;
  return [
    4.0767417 * l - 3.3077116 * m + 0.23096994 * s,
    -1.268438 * l + 2.6097574 * m - 0.34131938 * s,
    -0.0041960863 * l - 0.7034186 * m + 1.7076147 * s,
  ];
}

/** The sRGB value of a linear one (IEC 61966-2-1). */
function encoded(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}
