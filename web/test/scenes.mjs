// SPDX-License-Identifier: GPL-3.0-or-later
// Synthetic runs with known motion: what the page shows of them is tested against these formulas.
import { Blocks, emptyRun, header } from "./writer.mjs";

const instants = (count, end) => Float64Array.from({ length: count }, (_, i) => (end * i) / Math.max(1, count - 1));
const aboutY = (angle) => [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0];

/** A tube along x: rings of vertices, triangles round them. */
export function tube(length, radius, rings, around) {
  const vertices = [], triangles = [];
  for (let i = 0; i <= rings; ++i)
    for (let j = 0; j < around; ++j) {
      const angle = (2 * Math.PI * j) / around;
      vertices.push((length * i) / rings, radius * Math.cos(angle), radius * Math.sin(angle));
    }
  for (let i = 0; i < rings; ++i)
    for (let j = 0; j < around; ++j) {
      const a = i * around + j, b = i * around + ((j + 1) % around), c = a + around, d = b + around;
      triangles.push(a, c, b, b, c, d);
    }
  return { vertices, triangles };
}

/** The swing of the beam: its angle, its first two bending amplitudes [m]. */
export const SWING = {
  length: 2,
  angle: (t, amplitude) => amplitude * Math.cos(2.5 * t),
  bending: (t) => [0.06 * Math.sin(9 * t), 0.02 * Math.sin(23 * t)],
  shape: (k, s) => (k === 0 ? s * s : s * s * (1 - 1.25 * s) * 4),
  tip(t, amplitude) {
    const phi = this.angle(t, amplitude), w = this.bending(t)[0] * this.shape(0, 1) + this.bending(t)[1] * this.shape(1, 1);
    return [this.length * Math.sin(phi) + w * Math.cos(phi), 0, -this.length * Math.cos(phi) + w * Math.sin(phi)];
  },
};

/** Hinged at the origin, hanging along -z: body x is the beam, body z = (cos phi, 0, sin phi) of the world. */
export function swingingBeam(blocks, name, { rows = 201, end = 5, amplitude = 0.8, rings = 40, around = 16, packed = true } = {}) {
  const run = emptyRun(name), times = instants(rows, end), { length } = SWING;
  const mesh = tube(length, 0.05, rings, around), count = mesh.vertices.length / 3;
  const modes = [0, 1].flatMap((k) => Array.from({ length: count }, (_, v) => [0, 0, SWING.shape(k, mesh.vertices[3 * v] / length)]).flat());
  const stress = [0, 1].flatMap((k) => Array.from({ length: count }, (_, v) => {
    const s = mesh.vertices[3 * v] / length;
    return [2.1e11 * mesh.vertices[3 * v + 2] * (k === 0 ? 1 - s : Math.sin(3 * s)) * 0.1, 0, 0, 0, 0, 0];
  }).flat());
  const rotation = [...times].map((t) => aboutY(Math.PI / 2 - SWING.angle(t, amplitude)));
  const positions = (f) => blocks.quantised([rows, 3], [...times].flatMap(f), { packed });
  run.times = blocks.floats([rows], times);
  run.shapes = [{
    vertices: blocks.quantised([count, 3], mesh.vertices), triangles: blocks.array("u16", [mesh.triangles.length / 3, 3], mesh.triangles),
    lines: null, points: false, source: "recovery", error: 1e-5, largest: 0.08, thinned: null,
    modes: scaledFirst(blocks, [2, count, 3], modes), stress: { quantity: "von Mises", modes: scaledFirst(blocks, [2, count, 6], stress) },
  }, {
    vertices: blocks.quantised([2, 3], [0, -0.3, 0, 0, 0.3, 0]), triangles: null, lines: blocks.array("u16", [1, 2], [0, 1]), points: true,
    modes: null, stress: null, source: "nodes", error: 0, largest: 0, thinned: null,
  }];
  const still = { position: blocks.floats([1, 3], [0, 0, 0]), rotation: blocks.rotations([1, 4], [1, 0, 0, 0]), amplitudes: null };
  run.bodies = [
    { name: "beam", kind: "superelement", shape: 0, mass: 12.5, position: blocks.floats([1, 3], [0, 0, 0]),
      rotation: blocks.rotations([rows, 4], rotation.flat(), { packed }), amplitudes: blocks.floats([rows, 2], [...times].flatMap((t) => SWING.bending(t)), { packed }) },
    { name: "frame", kind: "rigid", shape: 1, mass: null, ...still },
    { name: "anchor", kind: "virtual", shape: null, mass: null, ...still, position: blocks.floats([1, 3], [-1, 0, -0.5]) },
  ];
  run.nodes = [
    { name: "beam/tip", body: 0, place: { body: 0, position: positions((t) => SWING.tip(t, amplitude)), rest: [length, 0, 0] }, also: ["beam/end"] },
    { name: "beam/root", body: 0, place: { position: blocks.floats([1, 3], [0, 0, 0]), rest: [0, 0, 0] } },
    { name: "frame/left", body: 1, place: { body: 1, point: [0, -0.3, 0] } },
  ];
  run.joints = [{ name: "hinge", kind: "revolute", bodies: [1, 0], coordinates: [4], place: { body: 1, point: [0, 0, 0], rotation: [Math.SQRT1_2, -Math.SQRT1_2, 0, 0] } }];
  run.springs = [{ name: "stay", kind: "line", ends: [{ point: [-1, 0, -0.5] }, run.nodes[0].place], channels: [] }];
  blocks.next();
  const channel = (path, unit, f) => run.channels.push({ path, unit, group: path.split("/")[0], values: blocks.floats([rows], [...times].map(f)) });
  for (const [i, axis] of ["x", "y", "z"].entries()) channel(`nodes/position/beam/tip/${axis}`, "m", (t) => SWING.tip(t, amplitude)[i]);
  channel("nodes/velocity/beam/tip/x", "m/s", (t) => (SWING.tip(t + 1e-5, amplitude)[0] - SWING.tip(t - 1e-5, amplitude)[0]) / 2e-5);
  channel("joints/coordinate/hinge/angle", "rad", (t) => SWING.angle(t, amplitude));
  for (const [i, axis] of ["x", "y", "z"].entries()) channel(`joints/force/hinge/${axis}`, "N", (t) => [60 * Math.sin(2.5 * t), 0, 120 + 40 * Math.cos(5 * t)][i]);
  for (const [i, axis] of ["x", "y", "z"].entries()) channel(`joints/moment/hinge/${axis}`, "N m", (t) => [20 * Math.sin(3 * t), 0, 15][i]);
  channel("energy/kinetic", "J", (t) => 40 * Math.sin(2.5 * t) ** 2);
  channel("energy/potential", "J", (t) => -40 * Math.sin(2.5 * t) ** 2 + 40);
  channel("run/step", "s", (t) => 1e-3 * (1.2 + Math.sin(7 * t)));
  run.arrows = [
    { name: "hinge", kind: "force", place: { point: [0, 0, 0] }, channels: [5, 6, 7], axes: "world" },
    { name: "hinge", kind: "moment", place: { point: [0, 0, 0] }, channels: [8, 9, 10], axes: "world" },
  ];
  const points = Array.from({ length: 12 }, (_, i) => (end * i) / 11);
  run.references = [{ name: "measured", channel: "nodes/position/beam/tip/x", x: blocks.floats([12], points), y: blocks.floats([12], points.map((t) => SWING.tip(t, amplitude)[0])) }];
  run.box = [[-2.1, -0.3, -2.1], [2.1, 0.3, 0.2]];
  run.report = {
    doubts: ["The mesh of part 'beam' was not refined: no error of its frequencies is known."],
    notes: ["Started from rest; the first step was 1e-5 s."],
    lines: [["analysis", "dynamics, index 3, generalised alpha"], ["bodies", "3"], ["unknowns", "26"], ["duration", `${end} s`]],
    phases: [["reading", 0.02], ["assembly", 0.11], ["steps", 1.43], ["writing", 0.08]],
    energy: { kinetic: 11, potential: 12 }, steps: 13, effects: [["gravity", "on"], ["damping", "off"], ["contact", "off"]],
  };
  run.scene = "bodies:\n  beam: {superelement: beam.se.h5}\n";
  return run;
}

function scaledFirst(blocks, shape, values) {
  const per = values.length / shape[0], scale = [], stored = new Int16Array(values.length);
  for (let k = 0; k < shape[0]; ++k) {
    let largest = 0;
    for (let i = 0; i < per; ++i) largest = Math.max(largest, Math.abs(values[k * per + i]));
    scale.push(largest / 32767 || 1);
    for (let i = 0; i < per; ++i) stored[k * per + i] = Math.round(values[k * per + i] / scale[k]);
  }
  return blocks.array("i16", shape, stored, { scale, scaled: "first" });
}

/** n bodies on a lattice that turn and bob; `shapeOf` makes their common shape. */
export function crowd(blocks, name, { bodies = 1000, rows = 2000, end = 20, rings = 2, around = 6, modes = 0 } = {}) {
  const run = emptyRun(name), side = Math.ceil(Math.sqrt(bodies)), mesh = tube(0.7, 0.22, rings, around), count = mesh.vertices.length / 3;
  run.times = blocks.floats([rows], instants(rows, end));
  const shape = (k) => Array.from({ length: count }, (_, v) => [0, 0.1 * Math.sin((k + 1) * mesh.vertices[3 * v] * 4), 0]).flat();
  run.shapes = [{
    vertices: blocks.quantised([count, 3], mesh.vertices), triangles: blocks.array("u32", [mesh.triangles.length / 3, 3], mesh.triangles), lines: null,
    modes: modes > 0 ? scaledFirst(blocks, [modes, count, 3], Array.from({ length: modes }, (_, k) => shape(k)).flat()) : null,
    points: false, stress: null, source: "scene",
  }];
  for (let b = 0; b < bodies; ++b) {
    const x = b % side, y = Math.floor(b / side), position = new Float64Array(3 * rows), rotation = new Float64Array(4 * rows);
    for (let i = 0; i < rows; ++i) {
      const t = (end * i) / (rows - 1), q = aboutY(0.6 * t + 0.1 * b);
      position.set([x, y, 0.4 * Math.sin(t + 0.05 * b)], 3 * i);
      rotation.set(q, 4 * i);
    }
    run.bodies.push({
      name: `body${b}`, kind: "rigid", shape: 0, mass: 1, position: blocks.quantised([rows, 3], position, { packed: true }),
      rotation: blocks.rotations([rows, 4], rotation, { packed: true }),
      amplitudes: modes > 0 ? blocks.floats([rows, modes], Array.from({ length: rows * modes }, (_, i) => Math.sin(0.05 * i)), { packed: true }) : null,
    });
    run.nodes.push({ name: `body${b}/centre`, body: b, place: { body: b, point: [0, 0, 0] } });
  }
  run.box = [[-0.7, -0.3, -1], [side, side, 1]];
  blocks.next();
  for (let b = 0; b < Math.min(bodies, 200); ++b)
    run.channels.push({ path: `nodes/position/body${b}/centre/z`, unit: "m", group: "nodes",
      values: blocks.floats([rows], Array.from({ length: rows }, (_, i) => 0.4 * Math.sin((end * i) / (rows - 1) + 0.05 * b)), { packed: true }) });
  run.report.lines = [["bodies", String(bodies)], ["instants", String(rows)]];
  return run;
}

/** The beam at rest with two modes, the second complex and damped. */
export function modesOfBeam(blocks, name) {
  const run = swingingBeam(blocks, name, { rows: 1, end: 0 });
  run.kind = "modes";
  run.modes = [
    { frequency: 3.2, damping: null, bodies: [{ body: 0, translation: [[0, 0, 0], [0, 0, 0]], rotation: [[0, 0, 0], [0, 0, 0]], amplitudes: [[1, 0], [0, 0]] }] },
    { frequency: 19.7, damping: 0.013, bodies: [
      { body: 0, translation: [[0, 0, 0], [0, 0, 0]], rotation: [[0, 0.2, 0], [0, 0.1, 0]], amplitudes: [[0, 1], [0.3, 0]] },
      { body: 1, translation: [[0, 0.2, 0], [0, 0, 0]], rotation: [[0, 0, 0], [0, 0, 0]], amplitudes: null }] },
  ];
  return run;
}

/** The swing on a frame that goes along x at 200 m/s. */
function travel(blocks, name) {
  const run = swingingBeam(blocks, name), rows = 201, end = 5, times = instants(rows, end);
  const along = (rest) => blocks.floats([rows, 3], [...times].flatMap((t) => [rest[0] + 200 * t, rest[1], rest[2]]));
  for (const body of run.bodies) body.position = along(body.name === "anchor" ? [-1, 0, -0.5] : [0, 0, 0]);
  run.nodes[0].place.position = blocks.floats([rows, 3], [...times].flatMap((t) => SWING.tip(t, 0.8).map((x, c) => x + (c === 0 ? 200 * t : 0))));
  run.nodes[1].place.position = along([0, 0, 0]);
  run.springs = [];
  run.box = [[-2.1, -0.3, -2.1], [1002.1, 0.3, 0.2]];
  run.moving = { box: run.box, size: 4.6, follow: 1 };
  return run;
}

/** The beam at rest, bent by micrometres. */
function tiny(blocks, name) {
  const run = swingingBeam(blocks, name, { amplitude: 0 }), rows = 201, times = instants(rows, 5);
  run.bodies[0].amplitudes = blocks.floats([rows, 2], [...times].flatMap((t) => [2e-6 * Math.sin(9 * t), 0]));
  run.nodes[0].place.position = blocks.floats([rows, 3], [...times].flatMap((t) => [2e-6 * Math.sin(9 * t), 0, -2]));
  run.shapes[0].largest = 2e-6;
  run.references = [];
  return run;
}

const MARKUP = "<img src=x onerror=\"document.title='broken in'\"></script><script>document.title='broken in'</script>&amp;\u2028'\"";

export const SCENES = {
  beam: (blocks) => header("Swinging beam", [swingingBeam(blocks, "swing")]),
  two: (blocks) => header("Two swings", [swingingBeam(blocks, "wide"), swingingBeam(blocks, "narrow", { amplitude: 0.6, rows: 151 })]),
  travel: (blocks) => header("A swing on the way", [travel(blocks, "travel")]),
  tiny: (blocks) => header("A beam that bends a little", [tiny(blocks, "tiny")]),
  modes: (blocks) => header("Modes of a beam", [modesOfBeam(blocks, "about rest")]),
  crowd: (blocks) => header("A thousand bodies", [crowd(blocks, "crowd")]),
  fine: (blocks) => header("Twenty thousand vertices", [crowd(blocks, "fine", { bodies: 40, rows: 500, rings: 24, around: 20, modes: 8 })]),
  markup: (blocks) => {
    const run = swingingBeam(blocks, MARKUP, { rows: 11 });
    for (const list of [run.bodies, run.nodes, run.joints]) for (const item of list) item.name += MARKUP;
    for (const channel of run.channels) channel.path += MARKUP;
    for (const key of ["notes", "doubts"]) run.report[key] = [MARKUP];
    run.report.lines = [[MARKUP, MARKUP]];
    run.scene = MARKUP;
    return header(MARKUP, [run]);
  },
};

export function sceneBlocks(name) {
  const blocks = new Blocks();
  return { header: SCENES[name](blocks), blocks };
}
