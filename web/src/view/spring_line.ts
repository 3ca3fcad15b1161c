// SPDX-License-Identifier: GPL-3.0-or-later
import { add, length, scaled, subtract } from "../data/rotation";
import type { Vec } from "../data/rotation";

const TURNS = 14, PER_TURN = 14;

/** Points of a coil of radius r between a and b, straight at both ends. */
export function springLine(a: Vec, b: Vec, r: number): Vec[] {
  const along = subtract(b, a), l = length(along);
  if (!(l > 0)) return [a, b];
  const z = scaled(along, 1 / l), helper: Vec = Math.abs(z[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const cross = (u: Vec, v: Vec): Vec => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const x = cross(helper, z), xn = scaled(x, 1 / length(x)), y = cross(z, xn);
  const points: Vec[] = [a];
  const count = TURNS * PER_TURN;
  for (let i = 0; i <= count; ++i) {
    const s = 0.12 + (0.76 * i) / count, angle = (2 * Math.PI * i) / PER_TURN;
    const out = i === 0 || i === count ? 0 : Math.min(r, l / 4);
    points.push(add(add(a, scaled(along, s)), add(scaled(xn, out * Math.cos(angle)), scaled(y, out * Math.sin(angle)))));
  }
  points.push(b);
  return points;
}
