// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of joints by kind, of virtual bodies and of arrows, of unit size: z is the axis of the joint.
import type { Shape } from "../data/run";
import { rotate } from "../data/rotation";
import type { Quaternion } from "../data/rotation";

const ROUND = 20;

class Builder {
  readonly vertices: number[] = [];
  readonly triangles: number[] = [];
  readonly lines: number[] = [];

  private point(p: number[]): number {
    this.vertices.push(p[0]!, p[1]!, p[2]!);
    return this.vertices.length / 3 - 1;
  }
  /** Rings of radius r at height z, joined; radii of 0 close it. */
  turned(profile: [number, number][], q: Quaternion = [1, 0, 0, 0]): this {
    const rings = profile.map(([r, z]) =>
      Array.from({ length: ROUND }, (_, i) => {
        const angle = (2 * Math.PI * i) / ROUND;
        return this.point(rotate(q, [r * Math.cos(angle), r * Math.sin(angle), z]));
      }));
    for (let k = 0; k + 1 < rings.length; ++k)
      for (let i = 0; i < ROUND; ++i) {
        const j = (i + 1) % ROUND, [a, b] = [rings[k]!, rings[k + 1]!];
        this.triangles.push(a[i]!, a[j]!, b[j]!, a[i]!, b[j]!, b[i]!);
      }
    return this;
  }
  cylinder(radius: number, low: number, high: number, q?: Quaternion): this {
    return this.turned([[0, low], [radius, low], [radius, high], [0, high]], q);
  }
  box(x: number, y: number, z: number): this {
    const p = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => this.point([(i & 1 ? 1 : -1) * x, (i & 2 ? 1 : -1) * y, (i & 4 ? 1 : -1) * z]));
    for (const [a, b, c, d] of [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
      this.triangles.push(p[a!]!, p[b!]!, p[c!]!, p[a!]!, p[c!]!, p[d!]!);
    return this;
  }
  ball(radius: number, centre = 0): this {
    return this.turned(Array.from({ length: 11 }, (_, i): [number, number] => {
      const angle = Math.PI * (i / 10 - 0.5);
      return [radius * Math.cos(angle), centre + radius * Math.sin(angle)];
    }));
  }
  shape(): Shape {
    return {
      vertices: Float64Array.from(this.vertices), triangles: Uint32Array.from(this.triangles), elements: new Uint32Array(),
      lines: Uint32Array.from(this.lines), modes: null, stress: null, points: false,
    };
  }
}

const ALONG_X: Quaternion = [Math.SQRT1_2, 0, Math.SQRT1_2, 0];
const ALONG_Y: Quaternion = [Math.SQRT1_2, -Math.SQRT1_2, 0, 0];

const JOINTS: Record<string, () => Builder> = {
  fixed: () => new Builder().box(0.45, 0.45, 0.45),
  revolute: () => new Builder().cylinder(0.45, -0.7, 0.7).cylinder(0.18, -1.1, 1.1),
  spherical: () => new Builder().ball(0.62),
  universal: () => new Builder().cylinder(0.2, -1, 1, ALONG_X).cylinder(0.2, -1, 1, ALONG_Y).ball(0.32),
  constant_velocity: () => new Builder().ball(0.55).cylinder(0.25, -1.1, 1.1),
  cylindrical: () => new Builder().cylinder(0.4, -0.8, 0.8).cylinder(0.18, -1.8, 1.8),
  screw: () => new Builder().cylinder(0.4, -0.5, 0.5).turned(
    Array.from({ length: 19 }, (_, i): [number, number] => [i % 18 === 0 ? 0 : i % 2 ? 0.26 : 0.14, -1.8 + 0.2 * i])),
  prismatic: () => new Builder().box(0.45, 0.45, 0.7).box(0.16, 0.16, 1.6),
  planar: () => new Builder().box(1, 1, 0.07).cylinder(0.22, -0.4, 0.4),
  point_on_line: () => new Builder().ball(0.4).cylinder(0.1, -1.8, 1.8),
  point_on_plane: () => new Builder().box(1, 1, 0.07).ball(0.35),
  distance: () => new Builder().ball(0.4),
  constant_orientation: () => new Builder().box(0.6, 0.6, 0.1).box(0.1, 0.6, 0.6).box(0.6, 0.1, 0.6),
  parallel_axes: () => new Builder().cylinder(0.12, -1.2, 1.2).box(0.5, 0.5, 0.1),
};

const built = new Map<string, Shape>();
function once(key: string, make: () => Builder): Shape {
  let shape = built.get(key);
  if (!shape) built.set(key, (shape = make().shape()));
  return shape;
}

export function jointShape(kind: string): Shape {
  return once(`joint ${JOINTS[kind] ? kind : "other"}`, JOINTS[kind] ?? (() => new Builder().turned([[0, -0.6], [0.6, 0], [0, 0.6]])));
}
export function markerShape(): Shape {
  return once("marker", () => new Builder().turned([[0, -0.4], [0.4, 0], [0, 0.4]]));
}
/** An arrow of length 1 along z; a moment has two heads. */
export function arrowShape(kind: string): Shape {
  const shaft: [number, number][] = [[0, 0], [0.018, 0]];
  const head = (at: number): [number, number][] => [[0.018, at], [0.06, at], [0, at + 0.17]];
  return once(`arrow ${kind}`, () =>
    kind === "moment"
      ? new Builder().turned([...shaft, ...head(0.67).slice(0, 2), [0.018, 0.8], ...head(0.83)])
      : new Builder().turned([...shaft, ...head(0.83)]));
}
