// SPDX-License-Identifier: GPL-3.0-or-later
// One run in memory: its arrays, decoded, and where its bodies and places are at a time or a phase of a mode.
import type { Values } from "./arrays";
import type { Blocks } from "./blocks";
import { require } from "./failure";
import type { ArrayEntry, BodyEntry, NodeEntry, PlaceEntry, RunEntry, ShapeEntry, StressEntry, Vector3 } from "./header";
import { add, conjugate, exponential, normalise, product, rotate, slerp, subtract } from "./rotation";
import type { Quaternion, Vec } from "./rotation";

export interface Body extends Omit<BodyEntry, "position" | "rotation" | "amplitudes"> {
  position: Values;
  rotation: Values;
  amplitudes: Values | null;
  /** Where its amplitudes begin in `Motion.amplitudes`. */
  first: number;
}

export interface Shape extends Omit<ShapeEntry, "vertices" | "triangles" | "lines" | "elements" | "modes" | "stress"> {
  vertices: Float64Array;
  triangles: ArrayLike<number>;
  lines: ArrayLike<number>;
  /** Element of each triangle; empty: not known. */
  elements: ArrayLike<number>;
  modes: Values | null;
  stress: (Omit<StressEntry, "modes"> & { modes: Values }) | null;
}

export interface Place {
  entry: PlaceEntry;
  position: Values | null;
  rotation: Values | null;
  /** Body that turns it where it has a history of its own. */
  body: number | null;
  /** Nearest vertex of its body, once it was asked for. */
  vertex?: number;
}

export interface Pose {
  position: Vec;
  rotation: Quaternion;
}

export interface PlacedNode extends Omit<NodeEntry, "place"> {
  place: Place;
}

/** Poses of all bodies at one instant: 7 numbers each (position, quaternion), and all amplitudes. */
export interface Motion {
  poses: Float64Array;
  amplitudes: Float64Array;
}

const IDENTITY: Quaternion = [1, 0, 0, 0];

export class Run {
  times: Float64Array = new Float64Array();
  bodies: Body[] = [];
  shapes: Shape[] = [];
  nodes: PlacedNode[] = [];
  joints: { name: string; kind: string; bodies: (number | null)[]; coordinates: number[]; place: Place }[] = [];
  springs: { name: string; kind: string; ends: [Place, Place]; channels: number[] }[] = [];
  arrows: { name: string; kind: string; place: Place; channels: number[]; axes: string }[] = [];
  motion: Motion = { poses: new Float64Array(), amplitudes: new Float64Array() };
  /** Factor on deformations; the rigid motion is never touched. */
  exaggeration = 1;
  visible = true;
  time = 0;
  private mode: { index: number; amplitude: number; phase: number } | null = null;
  private readonly read = new Map<ArrayEntry, Float64Array>();

  constructor(readonly entry: RunEntry, readonly index: number, readonly blocks: Blocks) {}

  get name(): string {
    return this.entry.name;
  }
  unit(quantity: string): string {
    return this.entry.units[quantity] ?? "";
  }
  /** Box of what moves, over all instants. */
  get box(): [Vector3, Vector3] {
    return this.entry.moving?.box ?? this.entry.box;
  }
  /** Size of what moves at one instant: by it joints and arrows are drawn. */
  get size(): number {
    const [low, high] = this.box;
    return this.entry.moving?.size || Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) || 1;
  }

  /** Reads what a picture needs; channels stay packed until they are shown. */
  async load(): Promise<void> {
    const where = `run ${this.index + 1} ('${this.entry.name}')`;
    this.times = (await this.blocks.read(this.entry.times, `${where}, times`)).all();
    require(this.times.length > 0, `${where} has no instants.`);
    for (let i = 1; i < this.times.length; ++i)
      require(this.times[i]! >= this.times[i - 1]!, `${where}: time decreases at row ${i}.`);
    for (const [i, shape] of this.entry.shapes.entries()) this.shapes.push(await this.readShape(shape, `${where}, shape ${i}`));
    let first = 0;
    for (const body of this.entry.bodies) {
      const read = await this.readBody(body, `${where}, body '${body.name}'`, first);
      first += read.amplitudes?.columns ?? 0;
      this.bodies.push(read);
    }
    this.motion = { poses: new Float64Array(7 * this.bodies.length), amplitudes: new Float64Array(first) };
    for (const node of this.entry.nodes) this.nodes.push({ ...node, place: await this.readPlace(node.place, node.body, node.name) });
    for (const joint of this.entry.joints)
      this.joints.push({
        ...joint,
        coordinates: joint.coordinates ?? [],
        place: await this.readPlace(joint.place, joint.bodies[0] ?? null, joint.name),
      });
    for (const spring of this.entry.springs) {
      const ends = [await this.readPlace(spring.ends[0], null, spring.name), await this.readPlace(spring.ends[1], null, spring.name)];
      this.springs.push({ ...spring, ends: ends as [Place, Place], channels: spring.channels ?? [] });
    }
    for (const arrow of this.entry.arrows)
      this.arrows.push({ ...arrow, axes: arrow.axes ?? "world", place: await this.readPlace(arrow.place, null, arrow.name) });
    this.seek(this.times[0]!);
  }

  private async readShape(entry: ShapeEntry, where: string): Promise<Shape> {
    const vertices = (await this.blocks.read(entry.vertices, `${where}, vertices`)).all();
    const count = vertices.length / 3;
    const indices = async (list: ArrayEntry | null, what: string): Promise<ArrayLike<number>> => {
      if (!list) return new Uint32Array();
      const stored = (await this.blocks.read(list, `${where}, ${what}`)).stored;
      for (let i = 0; i < stored.length; ++i) require(stored[i]! < count, `${where}: ${what} name vertex ${stored[i]} of ${count}.`);
      return stored;
    };
    const modes = entry.modes ? await this.blocks.read(entry.modes, `${where}, modes`) : null;
    require(!modes || modes.columns === vertices.length, `${where}: its modes do not fit its ${count} vertices.`);
    const stress = entry.stress
      ? { ...entry.stress, modes: await this.blocks.read(entry.stress.modes, `${where}, stress`) }
      : null;
    require(!stress || stress.modes.columns === 2 * vertices.length, `${where}: its stresses do not fit its ${count} vertices.`);
    const triangles = await indices(entry.triangles, "triangles");
    const elements = entry.elements ? (await this.blocks.read(entry.elements, `${where}, elements`)).stored : new Uint32Array();
    require(elements.length === 0 || 3 * elements.length === triangles.length, `${where}: its elements do not fit its triangles.`);
    return {
      ...entry,
      vertices,
      triangles,
      lines: await indices(entry.lines, "lines"),
      elements,
      modes,
      stress,
    };
  }

  private async readBody(entry: BodyEntry, where: string, first: number): Promise<Body> {
    const fits = (values: Values, columns: number, what: string): Values => {
      require(columns < 0 || values.columns === columns, `${where}: ${what} has ${values.columns} columns instead of ${columns}.`);
      require(values.rows === this.times.length || values.rows === 1, `${where}: ${what} has ${values.rows} rows, the run ${this.times.length}.`);
      return values;
    };
    require(entry.shape === null || this.shapes[entry.shape] !== undefined, `${where}: there is no shape ${entry.shape}.`);
    const amplitudes = entry.amplitudes ? fits(await this.blocks.read(entry.amplitudes, `${where}, amplitudes`), -1, "amplitudes") : null;
    const modes = entry.shape === null ? null : this.shapes[entry.shape]!.modes;
    require(!amplitudes || !modes || amplitudes.columns === modes.rows, `${where}: ${amplitudes?.columns} amplitudes for ${modes?.rows} modes.`);
    return {
      ...entry,
      position: fits(await this.blocks.read(entry.position, `${where}, position`), 3, "position"),
      rotation: fits(await this.blocks.read(entry.rotation, `${where}, rotation`), 4, "rotation"),
      amplitudes,
      first,
    };
  }

  private async readPlace(entry: PlaceEntry, body: number | null, name: string): Promise<Place> {
    const where = `run ${this.index + 1}, place of '${name}'`;
    const owner = entry.body ?? body;
    require(owner === null || this.bodies[owner] !== undefined, `${where}: there is no body ${owner}.`);
    const turned = entry.rotation && !Array.isArray(entry.rotation) ? entry.rotation : null;
    return {
      entry,
      body: owner,
      position: entry.position ? await this.blocks.read(entry.position, where) : null,
      rotation: turned ? await this.blocks.read(turned, where) : null,
    };
  }

  /** Values of a channel over time, read and kept at its first use. */
  async channel(index: number): Promise<Float64Array> {
    const entry = this.entry.channels[index];
    require(entry !== undefined, `run ${this.index + 1}: there is no channel ${index}.`);
    return this.array(entry.values, `channel '${entry.path}'`);
  }
  /** Its values if they were read before. */
  channelNow(index: number): Float64Array | null {
    const entry = this.entry.channels[index];
    return (entry && this.read.get(entry.values)) ?? null;
  }
  async array(entry: ArrayEntry, where: string): Promise<Float64Array> {
    const known = this.read.get(entry);
    if (known) return known;
    const values = (await this.blocks.read(entry, where)).all();
    this.read.set(entry, values);
    return values;
  }

  /** Row before t and the share of the next one. */
  locate(t: number): { row: number; share: number } {
    const times = this.times;
    let low = 0, high = times.length - 1;
    if (!(t > times[0]!)) return { row: 0, share: 0 };
    if (t >= times[high]!) return { row: high, share: 0 };
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle]! <= t) low = middle;
      else high = middle;
    }
    const step = times[high]! - times[low]!;
    return { row: low, share: step > 0 ? (t - times[low]!) / step : 0 };
  }

  /** Positions and amplitudes linearly, rotations along the great arc between the stored rows. */
  at(t: number, motion: Motion): void {
    const { row, share } = this.locate(t);
    const next = Math.min(row + 1, this.times.length - 1);
    for (const [i, body] of this.bodies.entries()) {
      interpolate(body.position, row, next, share, motion.poses, 7 * i);
      interpolateRotation(body.rotation, row, next, share, motion.poses, 7 * i + 3);
      if (body.amplitudes) interpolate(body.amplitudes, row, next, share, motion.amplitudes, body.first);
    }
  }

  seek(t: number): void {
    this.time = t;
    this.mode = null;
    this.at(t, this.motion);
  }

  /** x0 + a Re(phi e^(i phase)) about row 0. */
  seekMode(index: number, amplitude: number, phase: number): void {
    const shape = this.entry.modes?.[index];
    if (!shape) return;
    this.at(this.times[0]!, this.motion);
    this.mode = { index, amplitude, phase };
    const re = amplitude * Math.cos(phase), im = -amplitude * Math.sin(phase);
    const part = (pair: number[][], i: number): number => re * (pair[0]?.[i] ?? 0) + im * (pair[1]?.[i] ?? 0);
    const { poses, amplitudes } = this.motion;
    for (const moved of shape.bodies) {
      const at = 7 * moved.body, body = this.bodies[moved.body];
      if (!body) continue;
      for (let i = 0; i < 3; ++i) poses[at + i]! += part(moved.translation, i);
      const turn = exponential([0, 1, 2].map((i) => part(moved.rotation, i)));
      poses.set(product(turn, poses.subarray(at + 3, at + 7)), at + 3);
      const count = body.amplitudes?.columns ?? 0;
      for (let k = 0; moved.amplitudes && k < count; ++k) amplitudes[body.first + k]! += part(moved.amplitudes, k);
    }
  }

  /** What the mode adds to the deformation at a place: that of the vertex of its body which is nearest to it. */
  private modeDeformation(place: Place, rest: Vector3): Vec {
    const body = this.bodies[place.body!]!, shape = body.shape === null ? null : this.shapes[body.shape]!;
    if (!shape?.modes || !body.amplitudes) return [0, 0, 0];
    const v = (place.vertex ??= nearest(shape.vertices, rest)), sum: Vec = [0, 0, 0];
    for (let k = 0; k < shape.modes.rows; ++k) {
      const a = this.exaggeration * (this.motion.amplitudes[body.first + k]! - body.amplitudes.at(0, k));
      for (let c = 0; c < 3; ++c) sum[c]! += a * shape.modes.at(k, 3 * v + c);
    }
    return sum;
  }

  pose(body: number, motion = this.motion): Pose {
    const p = motion.poses, i = 7 * body;
    return { position: [p[i]!, p[i + 1]!, p[i + 2]!], rotation: [p[i + 3]!, p[i + 4]!, p[i + 5]!, p[i + 6]!] };
  }

  /** Where a place is in the results at time t (no exaggeration, no mode). */
  placeAt(place: Place, t: number): Pose {
    const fixed = Array.isArray(place.entry.rotation) ? (place.entry.rotation as Quaternion) : IDENTITY;
    const { row, share } = this.locate(t);
    const next = Math.min(row + 1, this.times.length - 1);
    if (place.position) {
      const out = new Float64Array(7);
      out[3] = 1;
      interpolate(place.position, row, next, share, out, 0);
      if (place.rotation) interpolateRotation(place.rotation, row, next, share, out, 3);
      else if (place.body !== null) interpolateRotation(this.bodies[place.body]!.rotation, row, next, share, out, 3);
      return { position: [out[0]!, out[1]!, out[2]!], rotation: [out[3]!, out[4]!, out[5]!, out[6]!] };
    }
    const point = place.entry.point ?? [0, 0, 0];
    if (place.entry.body === undefined) return { position: [...point] as Vec, rotation: fixed };
    const body = this.bodies[place.entry.body]!;
    const out = new Float64Array(7);
    interpolate(body.position, row, next, share, out, 0);
    interpolateRotation(body.rotation, row, next, share, out, 3);
    const q = out.subarray(3);
    return { position: add(out, rotate(q, point)), rotation: product(q, fixed) };
  }

  /** Where a place is drawn: as in the results, its deformation exaggerated as that of its body, its body's mode added. */
  drawn(place: Place): Pose {
    if (!place.position) {
      if (place.entry.body === undefined) return this.placeAt(place, this.time);
      const { position, rotation } = this.pose(place.entry.body);
      const fixed = Array.isArray(place.entry.rotation) ? (place.entry.rotation as Quaternion) : IDENTITY;
      return { position: add(position, rotate(rotation, place.entry.point ?? [0, 0, 0])), rotation: product(rotation, fixed) };
    }
    const t = this.mode ? this.times[0]! : this.time;
    const true_ = this.placeAt(place, t);
    const rest: Vector3 | null | undefined = place.entry.rest;
    if (place.body === null || (!this.mode && (this.exaggeration === 1 || !rest))) return true_;
    const before = this.placeAt({ entry: { body: place.body }, position: null, rotation: null, body: place.body }, t);
    const back = conjugate(before.rotation), arm = rotate(product(back, true_.rotation), place.entry.arm ?? [0, 0, 0]);
    let local = subtract(rotate(back, subtract(true_.position, before.position)), arm);
    if (rest) local = local.map((value, i) => rest[i]! + this.exaggeration * (value - rest[i]!)) as Vec;
    if (this.mode && rest) local = add(local, this.modeDeformation(place, rest));
    local = add(local, arm);
    const now = this.pose(place.body);
    return {
      position: add(now.position, rotate(now.rotation, local)),
      rotation: product(product(now.rotation, conjugate(before.rotation)), true_.rotation),
    };
  }
}

function nearest(vertices: Float64Array, point: Vector3): number {
  let best = 0, least = Infinity;
  for (let i = 0; i < vertices.length; i += 3) {
    const d = (vertices[i]! - point[0]) ** 2 + (vertices[i + 1]! - point[1]) ** 2 + (vertices[i + 2]! - point[2]) ** 2;
    if (d < least) least = d, best = i / 3;
  }
  return best;
}

function interpolate(values: Values, row: number, next: number, share: number, out: Float64Array, at: number): void {
  const a = Math.min(row, values.rows - 1), b = Math.min(next, values.rows - 1);
  for (let c = 0; c < values.columns; ++c) {
    const from = values.at(a, c);
    out[at + c] = share === 0 ? from : from + share * (values.at(b, c) - from);
  }
}

const from = new Float64Array(4), to = new Float64Array(4), between = new Float64Array(4);
function interpolateRotation(values: Values, row: number, next: number, share: number, out: Float64Array, at: number): void {
  values.row(row, from);
  normalise(from);
  if (share === 0) {
    out.set(from, at);
    return;
  }
  values.row(next, to);
  normalise(to);
  slerp(from, to, share, between);
  out.set(between, at);
}
