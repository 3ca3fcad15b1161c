// SPDX-License-Identifier: GPL-3.0-or-later
// Colours told apart by the colour-blind: cividis and viridis for numbers (perceptually uniform), Okabe and Ito for lines,
// Tol's light set for bodies.

/** Each an 11-point table of matplotlib's maps; between the points the maps are linear to within 2 of 255. */
export const MAPS = {
  viridis: "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725",
  cividis: "00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 f2dc47 fee838",
} as const;
export type MapName = keyof typeof MAPS;

export const LINE_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c8c8c"];
/** Colour i of lines on paper: blue is lighter on a dark one, where it would have a contrast of 3.5. */
export function lineColour(i: number): string {
  const colour = LINE_COLOURS[i]!;
  return colour === "#0072b2" && matchMedia("(prefers-color-scheme: dark)").matches ? "#4ea3e6" : colour;
}
export const BODY_COLOURS = ["#77aadd", "#ee8866", "#44bb99", "#eedd88", "#99ddff", "#ffaabb", "#bbcc33", "#c8c8c8"];
export const GHOST_COLOURS = ["#4477aa", "#d55e00", "#009e73", "#cc79a7"];

export function rgb(hex: string): [number, number, number] {
  const value = parseInt(hex.replace("#", ""), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

/** 256 RGBA bytes of a map. */
export function mapBytes(name: MapName): Uint8Array {
  const points = MAPS[name].split(" ").map(rgb);
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (points.length - 1), k = Math.min(Math.floor(x), points.length - 2);
    for (let c = 0; c < 3; ++c) bytes[4 * i + c] = Math.round(255 * (points[k]![c]! + (x - k) * (points[k + 1]![c]! - points[k]![c]!)));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

/** The same map as a gradient of CSS, from bottom to top. */
export function mapGradient(name: MapName): string {
  return `linear-gradient(to top, ${MAPS[name].split(" ").map((c) => `#${c}`).join(", ")})`;
}
