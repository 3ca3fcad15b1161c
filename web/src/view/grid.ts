// SPDX-License-Identifier: GPL-3.0-or-later
// The ground grid below the motion and the world axes.
import type { Vec } from "../data/rotation";
import { add, scaled, subtract } from "../data/rotation";
import { rgb } from "./colours";
import type { Segments } from "./segments";

/** 1, 2 or 5 times a power of ten, next to x. */
export function roundStep(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x)), rest = x / power;
  return power * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
}

const MOST_LINES = 300;

/** Draws the grid of the plane across `up` a little below the box, for what has `size`; returns its spacing. */
export function drawGrid(lines: Segments, box: [Vec, Vec], origin: Vec, up: Vec, ink: readonly number[], size: number): number {
  const step = roundStep(Math.max(size / 10, Math.hypot(...subtract(box[1], box[0])) / MOST_LINES));
  const axis = [0, 1, 2].reduce((best, i) => (Math.abs(up[i]!) > Math.abs(up[best]!) ? i : best), 2);
  const [u, v] = [0, 1, 2].filter((i) => i !== axis) as [number, number];
  const below = 0.03 * size, level = up[axis]! > 0 ? box[0][axis]! - below : box[1][axis]! + below;
  const bounds = [u, v].map((i) => [Math.floor((box[0][i]! - 0.2 * size) / step), Math.ceil((box[1][i]! + 0.2 * size) / step)] as const);
  const line = (along: number, across: number, k: number, reach: readonly [number, number]): void => {
    const a: Vec = [0, 0, 0], b: Vec = [0, 0, 0];
    a[axis] = b[axis] = level;
    a[across] = b[across] = k * step;
    a[along] = reach[0] * step;
    b[along] = reach[1] * step;
    lines.add(subtract(a, origin), subtract(b, origin), ink, k === 0 ? 0.55 : k % 5 === 0 ? 0.32 : 0.16);
  };
  for (let k = bounds[0]![0]; k <= bounds[0]![1]; ++k) line(v, u, k, bounds[1]!);
  for (let k = bounds[1]![0]; k <= bounds[1]![1]; ++k) line(u, v, k, bounds[0]!);
  return step;
}

export function drawWorldAxes(lines: Segments, origin: Vec, reach: number): void {
  const at = scaled(origin, -1);
  for (const [axis, colour] of [[[1, 0, 0], "#c23b3b"], [[0, 1, 0], "#3c8d3c"], [[0, 0, 1], "#3b62c2"]] as const)
    lines.add(at, add(at, scaled(axis, reach)), rgb(colour));
}
