// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces made ready to draw: smooth normals up to a crease angle, vertices doubled at creases, and the lines of creases.
import type { Shape } from "../data/run";

const CREASE = Math.cos((35 * Math.PI) / 180);

export interface Facets {
  /** Vertex of the shape behind each drawn vertex. */
  source: Uint32Array;
  /** Unit normals, 3 a drawn vertex. */
  normals: Float32Array;
  triangles: Uint32Array;
  /** Pairs of drawn vertices: creases and borders. */
  edges: Uint32Array;
  /** The same: sides of elements that are neither. */
  sides: Uint32Array;
}

function facetNormals(vertices: Float64Array, triangles: ArrayLike<number>): Float64Array {
  const normals = new Float64Array(triangles.length);
  for (let f = 0; f < triangles.length; f += 3) {
    const a = 3 * triangles[f]!, b = 3 * triangles[f + 1]!, c = 3 * triangles[f + 2]!;
    const ux = vertices[b]! - vertices[a]!, uy = vertices[b + 1]! - vertices[a + 1]!, uz = vertices[b + 2]! - vertices[a + 2]!;
    const vx = vertices[c]! - vertices[a]!, vy = vertices[c + 1]! - vertices[a + 1]!, vz = vertices[c + 2]! - vertices[a + 2]!;
    normals[f] = uy * vz - uz * vy;
    normals[f + 1] = uz * vx - ux * vz;
    normals[f + 2] = ux * vy - uy * vx;
  }
  return normals;
}

function cosine(n: Float64Array | number[], i: number, m: Float64Array, j: number): number {
  const x = n[i]!, y = n[i + 1]!, z = n[i + 2]!, a = m[j]!, b = m[j + 1]!, c = m[j + 2]!;
  return (x * a + y * b + z * c) / (Math.hypot(x, y, z) * Math.hypot(a, b, c) || 1);
}

/** Groups the facets at each vertex whose normals agree within the crease angle; each group is one drawn vertex. */
export function facetsOf(shape: Shape): Facets {
  const { vertices, triangles } = shape;
  const facet = facetNormals(vertices, triangles);
  const source: number[] = [], normals: number[] = [], drawn = new Uint32Array(triangles.length);
  const groups: number[][] = Array.from({ length: vertices.length / 3 }, () => []);
  for (let i = 0; i < triangles.length; ++i) {
    const v = triangles[i]!, f = i - (i % 3), own = groups[v]!;
    let group = own.find((g) => cosine(normals, 3 * g, facet, f) > CREASE);
    if (group === undefined) {
      group = source.length;
      source.push(v);
      normals.push(0, 0, 0);
      own.push(group);
    }
    for (let c = 0; c < 3; ++c) normals[3 * group + c]! += facet[f + c]!;
    drawn[i] = group;
  }
  const unit = new Float32Array(normals.length);
  for (let i = 0; i < normals.length; i += 3) {
    const n = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) || 1;
    for (let c = 0; c < 3; ++c) unit[i + c] = normals[i + c]! / n;
  }
  return { source: Uint32Array.from(source), normals: unit, triangles: drawn, ...edgesOf(shape, drawn, facet) };
}

/** Edges: sides of triangles that only one has, or where two meet at more than the crease angle. Sides: where two elements meet. */
function edgesOf({ triangles, elements }: Shape, drawn: Uint32Array, facet: Float64Array): { edges: Uint32Array; sides: Uint32Array } {
  const sides = new Map<number, { a: number; b: number; f: number; crease: boolean; meets: boolean }>();
  for (let i = 0; i < triangles.length; ++i) {
    const f = i - (i % 3), next = f + ((i + 1) % 3);
    const v = triangles[i]!, w = triangles[next]!;
    const key = Math.min(v, w) * 4194304 + Math.max(v, w);
    const known = sides.get(key);
    if (!known) sides.set(key, { a: drawn[i]!, b: drawn[next]!, f, crease: true, meets: false });
    else {
      known.crease = Math.abs(cosine(facet, known.f, facet, f)) < CREASE;
      known.meets = elements.length > 0 && elements[known.f / 3] !== elements[f / 3];
    }
  }
  const edges: number[] = [], between: number[] = [];
  for (const side of sides.values())
    if (side.crease) edges.push(side.a, side.b);
    else if (side.meets) between.push(side.a, side.b);
  return { edges: Uint32Array.from(edges), sides: Uint32Array.from(between) };
}
