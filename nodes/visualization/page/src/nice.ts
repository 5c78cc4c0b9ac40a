// Numbers that people like to read.

/** The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not less than `value`, which is above 0. */
export function niceAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((one) => one * power >= value * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** The largest of 1, 2, 5 times a power of ten that is not more than `value`, which is above 0. */
export function niceBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [5, 2, 1].find((one) => one * power <= value * (1 + 1e-9)) ?? 1;
  return factor * power;
}

/** A number with at most `digits` significant digits and no trailing zeros; a dash where there is none. */
export function short(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(Math.max(digits - 1, 0)).replace("-", "−");
  const rounded = Number(value.toPrecision(digits));
  return String(rounded).replace("-", "−");
}

/** A number with a fixed number of decimals, for values that must not jump while they change. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}
