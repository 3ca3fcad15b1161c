// SPDX-License-Identifier: GPL-3.0-or-later
// All shapes of a run (or all glyphs) as four draw calls: surfaces, creases, lines, points; moved item by item.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, LineSegments, Mesh, Points, Uint32BufferAttribute } from "three";
import type { Pose, Shape } from "../data/run";
import type { Vec } from "../data/rotation";
import { Deformer } from "./deformer";
import { facetsOf } from "./facets";
import type { Facets } from "./facets";
import type { Materials } from "./materials";
import { Segments } from "./segments";
import type { Colouring } from "./settings";

export interface Item {
  owner: number;
  shape: Shape;
  rgb: readonly number[];
  /** Whether the colour of a quantity may replace its own. */
  mapped: boolean;
  /** Ground, which the camera need not show whole. */
  ground?: boolean;
}

/** The value of what has none: it is drawn grey. */
export const NO_VALUE = -1e30;

interface Part extends Item {
  facets: Facets;
  deformer: Deformer;
  /** First drawn vertex; those of the surface come first, then one for each vertex if it has lines or points. */
  first: number;
  bare: number;
  /** First segment and the drawn vertices of its ends. */
  segment: number;
}

export class Batch {
  readonly group = new Group();
  readonly surface: Mesh;
  readonly edges: LineSegments;
  /** Sides of elements. */
  readonly sides: LineSegments;
  readonly points: Points;
  readonly lines: Segments;
  readonly vertices: number;
  private readonly parts: Part[] = [];
  private readonly position: Float32Array;
  private readonly normal: Float32Array;
  private readonly value: Float32Array;
  private start: Float32Array | null = null;
  private readonly scratch: Float32Array;

  constructor(items: Item[], materials: Materials) {
    const known = new Map<Shape, { facets: Facets; deformer: Deformer }>();
    const triangles: number[] = [], edges: number[] = [], sides: number[] = [], points: number[] = [];
    this.lines = new Segments(materials.segment, 256);
    let count = 0, segments = 0, largest = 0;
    for (const item of items) {
      let made = known.get(item.shape);
      if (!made) {
        const facets = facetsOf(item.shape);
        known.set(item.shape, (made = { facets, deformer: new Deformer(item.shape, facets) }));
      }
      const surface = made.facets.source.length, all = item.shape.vertices.length / 3;
      const bare = item.shape.points || item.shape.lines.length > 0 ? all : 0;
      for (const i of made.facets.triangles) triangles.push(count + i);
      for (const i of made.facets.edges) edges.push(count + i);
      for (const i of made.facets.sides) sides.push(count + i);
      if (item.shape.points) for (let v = 0; v < all; ++v) points.push(count + surface + v);
      for (let i = 0; i + 1 < item.shape.lines.length; i += 2) this.lines.add([0, 0, 0], [0, 0, 0], item.rgb);
      this.parts.push({ ...item, ...made, first: count, bare, segment: segments });
      count += surface + bare;
      segments += item.shape.lines.length >> 1;
      largest = Math.max(largest, all);
    }
    this.vertices = count;
    this.position = new Float32Array(3 * count);
    this.normal = new Float32Array(3 * count);
    this.value = new Float32Array(count);
    this.scratch = new Float32Array(largest);
    const attributes = this.attributes();
    const geometry = (index: number[]): BufferGeometry => {
      const made = new BufferGeometry();
      for (const [name, attribute] of Object.entries(attributes)) made.setAttribute(name, attribute);
      return made.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
    };
    this.surface = new Mesh(geometry(triangles), materials.surface);
    this.edges = new LineSegments(geometry(edges), materials.edge);
    this.sides = new LineSegments(geometry(sides), materials.edge);
    this.points = new Points(geometry(points), materials.point);
    for (const object of [this.surface, this.edges, this.sides, this.points]) object.frustumCulled = false;
    this.surface.visible = triangles.length > 0;
    this.sides.visible = false;
    this.points.visible = points.length > 0;
    this.group.add(this.surface, this.edges, this.sides, this.lines.mesh, this.points);
  }

  private attributes(): Record<string, BufferAttribute> {
    const paint = new Uint8Array(4 * this.vertices), owner = new Uint32Array(this.vertices);
    for (const part of this.parts)
      for (let i = part.first; i < part.first + part.facets.source.length + part.bare; ++i) {
        paint.set([...part.rgb.map((c) => Math.round(255 * c)), part.mapped ? 255 : 0], 4 * i);
        owner[i] = part.owner;
      }
    const moving = (array: Float32Array, width: number): BufferAttribute => new BufferAttribute(array, width).setUsage(DynamicDrawUsage);
    return {
      position: moving(this.position, 3), normal: moving(this.normal, 3), value: moving(this.value, 1),
      paint: new BufferAttribute(paint, 4, true), owner: new Uint32BufferAttribute(owner, 1),
    };
  }

  /** Places item i: `at` relative to the origin of the picture. Amplitudes from `first`, null for a rigid shape. */
  place(i: number, at: Vec, q: Pose["rotation"], scale: number, amplitudes: Float64Array | null, first: number, exaggeration: number, what: Colouring): void {
    const part = this.parts[i]!, { deformer, facets } = part;
    if (deformer.count > 0) deformer.deform(amplitudes ?? this.zeros(deformer.count), amplitudes ? first : 0, exaggeration);
    const source = facets.source, surface = source.length;
    const r = matrix(q, scale);
    for (let k = 0; k < surface + part.bare; ++k)
      turn(r, deformer.place, 3 * (k < surface ? source[k]! : k - surface), at, this.position, 3 * (part.first + k));
    for (let k = 0; k < surface; ++k) turn(r, deformer.normals, 3 * k, ZERO, this.normal, 3 * (part.first + k));
    if (part.mapped && what !== "body") this.colour(part, what, amplitudes, first, r, at);
    this.join(part);
  }

  private zeros(count: number): Float64Array {
    if (this.none.length < count) this.none = new Float64Array(count);
    return this.none;
  }
  private none = new Float64Array();

  private colour(part: Part, what: Colouring, amplitudes: Float64Array | null, first: number, r: Float64Array, at: Vec): void {
    const { deformer, facets } = part, surface = facets.source.length, p = this.scratchPoint;
    if ((what === "stress" && !part.shape.stress) || (what === "deformation" && !part.shape.modes)) {
      this.value.fill(NO_VALUE, part.first, part.first + surface + part.bare);
      return;
    }
    if (what !== "displacement") deformer.values(what, amplitudes ?? this.zeros(deformer.count), first, this.scratch);
    for (let k = 0; k < surface + part.bare; ++k) {
      const v = k < surface ? facets.source[k]! : k - surface, drawn = part.first + k;
      if (what !== "displacement") this.value[drawn] = amplitudes ? this.scratch[v]! : 0;
      else if (this.start) {
        // Without exaggeration: V + u, whatever is drawn.
        for (let c = 0; c < 3; ++c) p[c] = part.shape.vertices[3 * v + c]! + (amplitudes ? deformer.displacement[3 * v + c]! : 0);
        turn(r, p, 0, at, p, 3);
        const s = this.start;
        this.value[drawn] = Math.hypot(p[3]! - s[3 * drawn]!, p[4]! - s[3 * drawn + 1]!, p[5]! - s[3 * drawn + 2]!);
      }
    }
  }
  private readonly scratchPoint = new Float32Array(6);

  private join(part: Part): void {
    const lines = part.shape.lines, first = part.first + part.facets.source.length;
    for (let s = 0; 2 * s + 1 < lines.length; ++s) {
      const a = first + lines[2 * s]!, b = first + lines[2 * s + 1]!;
      this.lines.move(part.segment + s, this.position, 3 * a, this.position, 3 * b, this.value[a]!, this.value[b]!);
    }
  }

  /** Keeps the present places as those from which displacement is measured. */
  keepStart(): void {
    this.start = this.position.slice();
  }

  /** Widens the box from `low` to `high` by what is drawn, but for the ground. */
  extend(low: Vec, high: Vec): void {
    for (const part of this.parts)
      for (let i = 3 * part.first; !part.ground && i < 3 * (part.first + part.facets.source.length + part.bare); ++i) {
        low[i % 3] = Math.min(low[i % 3]!, this.position[i]!);
        high[i % 3] = Math.max(high[i % 3]!, this.position[i]!);
      }
  }

  flush(coloured: boolean): void {
    for (const name of coloured ? ["position", "normal", "value"] : ["position", "normal"]) this.surface.geometry.getAttribute(name).needsUpdate = true;
    this.lines.flush();
  }
}

const ZERO: Vec = [0, 0, 0], rows = new Float64Array(9);

function matrix(q: Pose["rotation"], s: number): Float64Array {
  const [w, x, y, z] = q;
  rows[0] = s * (1 - 2 * (y * y + z * z)), rows[1] = s * 2 * (x * y - w * z), rows[2] = s * 2 * (x * z + w * y);
  rows[3] = s * 2 * (x * y + w * z), rows[4] = s * (1 - 2 * (x * x + z * z)), rows[5] = s * 2 * (y * z - w * x);
  rows[6] = s * 2 * (x * z - w * y), rows[7] = s * 2 * (y * z + w * x), rows[8] = s * (1 - 2 * (x * x + y * y));
  return rows;
}

/** out[o..] = at + r v[i..] */
function turn(r: Float64Array, v: Float32Array, i: number, at: Vec, out: Float32Array, o: number): void {
  const x = v[i]!, y = v[i + 1]!, z = v[i + 2]!;
  out[o] = at[0] + r[0]! * x + r[1]! * y + r[2]! * z;
  out[o + 1] = at[1] + r[3]! * x + r[4]! * y + r[5]! * z;
  out[o + 2] = at[2] + r[6]! * x + r[7]! * y + r[8]! * z;
}
