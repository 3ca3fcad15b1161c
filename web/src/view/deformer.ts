// SPDX-License-Identifier: GPL-3.0-or-later
// The vertices of one shape at given amplitudes: displacement, stress, smooth normals; scratch for one body at a time.
import type { Shape } from "../data/run";
import type { Facets } from "./facets";
import type { Colouring } from "./settings";

function dense(modes: { all(): Float64Array } | null): Float32Array | null {
  return modes ? Float32Array.from(modes.all()) : null;
}

export class Deformer {
  /** Displacement and deformed place of the vertices in body axes, 3 each. */
  readonly displacement: Float32Array;
  readonly place: Float32Array;
  /** Normals of the drawn vertices in body axes. */
  readonly normals: Float32Array;
  readonly count: number;
  private readonly modes: Float32Array | null;
  private readonly stress: Float32Array | null;
  private readonly stresses: Float32Array;

  constructor(private readonly shape: Shape, private readonly facets: Facets) {
    this.place = Float32Array.from(shape.vertices);
    this.count = shape.modes?.rows ?? 0;
    this.modes = dense(shape.modes);
    this.stress = dense(shape.stress?.modes ?? null);
    this.displacement = new Float32Array(shape.vertices.length);
    this.stresses = new Float32Array(this.stress ? 2 * shape.vertices.length : 0);
    this.normals = facets.normals.slice();
  }

  /** u = sum a_k mode_k, place = V + exaggeration u, normals of the deformed surface. */
  deform(amplitudes: Float64Array, first: number, exaggeration: number): void {
    if (!this.modes) return;
    const { displacement, place, shape } = this;
    combine(this.modes, amplitudes, first, this.count, displacement);
    for (let i = 0; i < place.length; ++i) place[i] = shape.vertices[i]! + exaggeration * displacement[i]!;
    this.smooth();
  }

  /** Sums the facet normals (twice their area) at the drawn vertices. */
  private smooth(): void {
    const { place: p, normals } = this, corners = this.shape.triangles, drawn = this.facets.triangles;
    normals.fill(0);
    for (let f = 0; f < drawn.length; f += 3) {
      const a = 3 * corners[f]!, b = 3 * corners[f + 1]!, c = 3 * corners[f + 2]!;
      const ux = p[b]! - p[a]!, uy = p[b + 1]! - p[a + 1]!, uz = p[b + 2]! - p[a + 2]!;
      const vx = p[c]! - p[a]!, vy = p[c + 1]! - p[a + 1]!, vz = p[c + 2]! - p[a + 2]!;
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (let k = 0; k < 3; ++k) {
        const g = 3 * drawn[f + k]!;
        normals[g]! += nx;
        normals[g + 1]! += ny;
        normals[g + 2]! += nz;
      }
    }
  }

  /** The coloured quantity of each vertex but displacement, which needs the place in the world. */
  values(what: Colouring, amplitudes: Float64Array, first: number, out: Float32Array): void {
    const n = this.place.length / 3;
    if (what === "deformation") {
      const u = this.displacement;
      for (let v = 0; v < n; ++v) out[v] = Math.hypot(u[3 * v]!, u[3 * v + 1]!, u[3 * v + 2]!);
    } else if (what === "stress" && this.stress) {
      combine(this.stress, amplitudes, first, this.count, this.stresses);
      for (let v = 0; v < n; ++v) out[v] = mises(this.stresses, 6 * v);
    } else out.fill(0, 0, n);
  }
}

function combine(modes: Float32Array, amplitudes: Float64Array, first: number, count: number, out: Float32Array): void {
  out.fill(0);
  for (let k = 0, at = 0; k < count; ++k, at += out.length) {
    const a = amplitudes[first + k]!;
    if (a !== 0) for (let i = 0; i < out.length; ++i) out[i]! += a * modes[at + i]!;
  }
}

/** Equivalent stress of (xx yy zz xy yz zx) at `at`. */
export function mises(s: ArrayLike<number>, at = 0): number {
  const x = s[at]!, y = s[at + 1]!, z = s[at + 2]!, xy = s[at + 3]!, yz = s[at + 4]!, zx = s[at + 5]!;
  return Math.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3 * (xy * xy + yz * yz + zx * zx));
}
