// SPDX-License-Identifier: GPL-3.0-or-later
// Unit quaternions [w x y z] and vectors, on flat arrays.
export type Quaternion = [number, number, number, number];
export type Vec = [number, number, number];

/** out[0..3] = slerp of a and b at s, along the shorter way; the inputs need be unit to rounding only. */
export function slerp(a: Float64Array, b: Float64Array, s: number, out: Float64Array): void {
  let dot = a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]! + a[3]! * b[3]!;
  const sign = dot < 0 ? -1 : 1;
  dot = Math.min(1, Math.abs(dot));
  const angle = Math.acos(dot);
  const small = angle < 1e-5; // the sines are their arguments to 1e-10
  const u = small ? 1 - s : Math.sin((1 - s) * angle) / Math.sin(angle);
  const v = sign * (small ? s : Math.sin(s * angle) / Math.sin(angle));
  for (let i = 0; i < 4; ++i) out[i] = u * a[i]! + v * b[i]!;
  normalise(out);
}

export function normalise(q: Float64Array): void {
  const n = Math.hypot(q[0]!, q[1]!, q[2]!, q[3]!) || 1;
  for (let i = 0; i < 4; ++i) q[i] = q[i]! / n;
}

export function product(a: ArrayLike<number>, b: ArrayLike<number>): Quaternion {
  const [aw, ax, ay, az] = [a[0]!, a[1]!, a[2]!, a[3]!];
  const [bw, bx, by, bz] = [b[0]!, b[1]!, b[2]!, b[3]!];
  return [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];
}

/** q v q*: v from the turned axes to those that q is given in. */
export function rotate(q: ArrayLike<number>, v: ArrayLike<number>): Vec {
  const [w, x, y, z] = [q[0]!, q[1]!, q[2]!, q[3]!];
  const [vx, vy, vz] = [v[0]!, v[1]!, v[2]!];
  const tx = 2 * (y * vz - z * vy), ty = 2 * (z * vx - x * vz), tz = 2 * (x * vy - y * vx);
  return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

export function conjugate(q: ArrayLike<number>): Quaternion {
  return [q[0]!, -q[1]!, -q[2]!, -q[3]!];
}

/** The turn by the rotation vector r. */
export function exponential(r: ArrayLike<number>): Quaternion {
  const angle = Math.hypot(r[0]!, r[1]!, r[2]!);
  const s = angle > 1e-12 ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), s * r[0]!, s * r[1]!, s * r[2]!];
}

/** The shortest turn of the z axis onto the direction v. */
export function turnOfZ(v: ArrayLike<number>): Quaternion {
  const n = Math.hypot(v[0]!, v[1]!, v[2]!);
  if (!(n > 0)) return [1, 0, 0, 0];
  const c = v[2]! / n;
  if (c < -0.999999) return [0, 1, 0, 0];
  const w = Math.sqrt((1 + c) / 2);
  return [w, -v[1]! / n / (2 * w), v[0]! / n / (2 * w), 0];
}

export const add = (a: ArrayLike<number>, b: ArrayLike<number>): Vec => [a[0]! + b[0]!, a[1]! + b[1]!, a[2]! + b[2]!];
export const subtract = (a: ArrayLike<number>, b: ArrayLike<number>): Vec => [a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!];
export const scaled = (a: ArrayLike<number>, s: number): Vec => [a[0]! * s, a[1]! * s, a[2]! * s];
export const length = (a: ArrayLike<number>): number => Math.hypot(a[0]!, a[1]!, a[2]!);
