// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as an engineer writes them.

/** Four significant digits by default; a power of ten where that is shorter. */
export function number(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "-";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return Number(value.toPrecision(digits)).toExponential().replace("e+", "e");
  return size >= 10 ** digits ? value.toFixed(0) : String(Number(value.toPrecision(digits)));
}

/** A fixed number of decimals that fits the resolution `step`. */
export function steady(value: number, step: number): string {
  const decimals = Math.max(0, Math.min(9, Math.ceil(-Math.log10(step || 1))));
  return value.toFixed(decimals);
}

export const withUnit = (text: string, unit: string): string => (unit ? `${text} ${unit}` : text);
export const unitless = (unit: string): string => (unit === "1" || unit === "-" ? "" : unit);
