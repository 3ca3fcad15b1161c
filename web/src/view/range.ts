// SPDX-License-Identifier: GPL-3.0-or-later
// The largest value of a coloured quantity, with its place and instant, for the legend; a factor that makes deformation visible.
import type { Values } from "../data/arrays";
import { add, rotate, subtract } from "../data/rotation";
import type { Vec } from "../data/rotation";
import type { Run, Shape } from "../data/run";
import { mises } from "./deformer";
import { roundStep } from "./grid";
import type { Colouring } from "./settings";

const INSTANTS = 60, EVALUATIONS = 1.5e6;
/** Shares of the size of what moves: motion below is invisible; deformation is then drawn so large. */
const INVISIBLE = 0.01, DRAWN = 0.05;

/** What the legend tells of the largest value. */
export interface Largest {
  value: number;
  body: string;
  /** In the world; of stress in axes of the part. */
  place: Vec;
  /** Null: of a mode. */
  time: number | null;
}

/** Sum of amplitude * mode at vertex v: displacement in body axes, or the six stresses. */
export function combined(modes: Values | null, components: number, v: number, amplitudes: Float64Array, first: number): Float64Array {
  const sum = new Float64Array(components);
  if (modes)
    for (let k = 0; k < modes.rows; ++k)
      for (let c = 0; c < components; ++c) sum[c]! += amplitudes[first + k]! * modes.at(k, components * v + c);
  return sum;
}

/** Place of vertex v of body b in the world, without exaggeration. */
export function vertexPlace(run: Run, b: number, v: number, motion = run.motion): Vec {
  const shape = run.shapes[run.bodies[b]!.shape!]!, pose = run.pose(b, motion);
  const u = combined(shape.modes, 3, v, motion.amplitudes, run.bodies[b]!.first);
  return add(pose.position, rotate(pose.rotation, add(shape.vertices.subarray(3 * v, 3 * v + 3), u)));
}

function valueAt(run: Run, b: number, v: number, shape: Shape, what: Colouring, start: Vec | null): number {
  const first = run.bodies[b]!.first, a = run.motion.amplitudes;
  if (what === "deformation") return Math.hypot(...combined(shape.modes, 3, v, a, first));
  if (what === "stress") return shape.stress ? mises(combined(shape.stress.modes, 6, v, a, first)) : 0;
  return start ? Math.hypot(...subtract(vertexPlace(run, b, v), start)) : 0;
}

/** Whether a body has the quantity. */
function has(run: Run, b: number, what: Colouring): boolean {
  const body = run.bodies[b]!, shape = body.shape === null ? null : run.shapes[body.shape]!;
  if (!shape || body.kind === "road") return false;
  return what === "displacement" || (what === "stress" ? shape.stress !== null : shape.modes !== null);
}

/** Largest value over `states`, each of which moves the run; the run is left in one of them. `timed`: they are instants. */
export function largestValue(run: Run, what: Colouring, states: (() => void)[], timed: boolean): Largest {
  const drawn = run.bodies.flatMap((_, b) => (has(run, b, what) ? [b] : []));
  const each = Math.max(8, Math.floor(EVALUATIONS / Math.max(1, states.length * drawn.length * 8)));
  const found = { value: 0, b: -1, v: 0, state: 0 };
  run.at(run.times[0]!, run.motion);
  const listOf = (b: number, stride: number): { v: number; at: Vec }[] => {
    const list: { v: number; at: Vec }[] = [], count = run.shapes[run.bodies[b]!.shape!]!.vertices.length / 3;
    for (let v = 0; v < count; v += stride) list.push({ v, at: vertexPlace(run, b, v) });
    return list;
  };
  const sample = drawn.map((b) => ({ b, list: listOf(b, Math.max(1, Math.ceil(run.shapes[run.bodies[b]!.shape!]!.vertices.length / 3 / each))) }));
  const search = (state: number, { b, list }: { b: number; list: { v: number; at: Vec }[] }): void => {
    const shape = run.shapes[run.bodies[b]!.shape!]!;
    for (const { v, at } of list) {
      const value = valueAt(run, b, v, shape, what, at);
      if (value > found.value) Object.assign(found, { value, b, v, state });
    }
  };
  states.forEach((move, state) => {
    move();
    for (const part of sample) search(state, part);
  });
  if (found.b < 0) return { value: 0, body: "", place: [0, 0, 0], time: null };
  // All vertices of that body at that instant: the sample may have missed a neighbour.
  run.at(run.times[0]!, run.motion);
  const whole = { b: found.b, list: listOf(found.b, 1) };
  states[found.state]!();
  search(found.state, whole);
  return { value: found.value, body: run.bodies[found.b]!.name, place: vertexPlace(run, found.b, found.v), time: timed ? run.time : null };
}

/** The largest stress of any vertex at any instant as the page's data hold it; null: they do not. */
export function storedStress(run: Run): Largest | null {
  let largest: Largest | null = null;
  for (const body of run.bodies) {
    const stored = body.shape === null ? null : run.shapes[body.shape]!.stress?.largest;
    if (stored && (!largest || stored.value > largest.value)) largest = { value: stored.value, body: body.name, place: stored.place, time: stored.time };
  }
  return largest;
}

export function instantsOf(run: Run): (() => void)[] {
  const stride = Math.max(1, Math.ceil(run.times.length / INSTANTS)), last = run.times.length - 1;
  const states: (() => void)[] = [];
  for (let i = 0; i <= last; i += stride) states.push(() => run.seek(run.times[i]!));
  if (last % stride !== 0) states.push(() => run.seek(run.times[last]!));
  return states;
}

/** 1, or a round factor on deformations where neither they nor the motion could be seen. */
export function visibleFactor(runs: Run[]): number {
  let factor = Infinity;
  for (const run of runs) {
    if (run.entry.modes !== null || run.entry.kind === "part") return 1;
    const deformed = Math.max(0, ...run.bodies.map((body) => (body.amplitudes && body.shape !== null ? run.shapes[body.shape]!.largest ?? 0 : 0)));
    if (deformed > INVISIBLE * run.size) return 1;
    const moved = run.times.length > 1 ? largestValue(run, "displacement", instantsOf(run), true).value : 0;
    run.seek(run.times[0]!);
    if (moved > INVISIBLE * run.size) return 1;
    if (deformed > 0) factor = Math.min(factor, roundStep((DRAWN * run.size) / deformed));
  }
  return Number.isFinite(factor) ? Number(factor.toPrecision(3)) : 1;
}
