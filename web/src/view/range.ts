// The largest value of a coloured quantity over instants and vertices (a sample of both), for the legend.
import type { Values } from "../data/arrays";
import { add, rotate, subtract } from "../data/rotation";
import type { Vec } from "../data/rotation";
import type { Run, Shape } from "../data/run";
import { mises } from "./deformer";
import type { Colouring } from "./settings";

const INSTANTS = 60, EVALUATIONS = 1.5e6;

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

/** Largest value over `states`, each of which moves the run; the run is left in the last. */
export function largestValue(run: Run, what: Colouring, states: (() => void)[]): number {
  const drawn = run.bodies.flatMap((body, b) => (body.shape === null ? [] : [b]))
    .filter((b) => what === "displacement" || run.shapes[run.bodies[b]!.shape!]!.modes || run.shapes[run.bodies[b]!.shape!]!.stress);
  const each = Math.max(8, Math.floor(EVALUATIONS / Math.max(1, states.length * drawn.length * 8)));
  let largest = 0;
  run.at(run.times[0]!, run.motion);
  const starts = drawn.map((b) => {
    const shape = run.shapes[run.bodies[b]!.shape!]!, count = shape.vertices.length / 3, stride = Math.max(1, Math.ceil(count / each));
    const list: { v: number; at: Vec }[] = [];
    for (let v = 0; v < count; v += stride) list.push({ v, at: vertexPlace(run, b, v) });
    return { b, shape, list };
  });
  for (const move of states) {
    move();
    for (const { b, shape, list } of starts)
      for (const { v, at } of list) largest = Math.max(largest, valueAt(run, b, v, shape, what, at));
  }
  return largest;
}

export function instantsOf(run: Run): (() => void)[] {
  const stride = Math.max(1, Math.ceil(run.times.length / INSTANTS));
  const states: (() => void)[] = [];
  for (let i = 0; i < run.times.length; i += stride) states.push(() => run.seek(run.times[i]!));
  return states;
}
