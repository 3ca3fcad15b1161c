// SPDX-License-Identifier: GPL-3.0-or-later
// One run in the picture: its bodies, joints, virtual bodies, springs, arrows, nodes and traces, moved with Run.motion.
import { BufferAttribute, BufferGeometry, Group, Points } from "three";
import type { Object3D, Vector4 } from "three";
import { add, rotate, scaled, subtract, turnOfZ } from "../data/rotation";
import type { Vec } from "../data/rotation";
import type { Place, Pose, Run } from "../data/run";
import { Batch } from "./batch";
import type { Item } from "./batch";
import { BODY_COLOURS, GHOST_COLOURS, LINE_COLOURS, rgb } from "./colours";
import { arrowShape, jointShape, markerShape } from "./glyphs";
import { materialsOf, setOpacity } from "./materials";
import type { Materials, Uniforms } from "./materials";
import { Segments } from "./segments";
import type { Colouring, Settings } from "./settings";
import { springLine } from "./spring_line";

const AXES: [Vec, string][] = [[[1, 0, 0], "#c23b3b"], [[0, 1, 0], "#3c8d3c"], [[0, 0, 1], "#3b62c2"]];
const JOINT = rgb("#d9a441"), MARKER = rgb("#9aa3ad"), SPRING = rgb("#7b8794");
export const FORCE = "#d1495b", MOMENT = "#8e5ea2";

interface Link {
  body: number;
  places: Place[];
}

function linksOf(run: Run): Link[] {
  const links = new Map<number, Place[]>();
  for (const joint of run.joints)
    for (const b of joint.bodies) {
      const body = b === null ? undefined : run.bodies[b], shape = body && body.shape !== null ? run.shapes[body.shape] : undefined;
      if (b !== null && body?.kind === "rigid" && ["nodes", "inertia"].includes(shape?.source ?? "")) links.set(b, [...(links.get(b) ?? []), joint.place]);
    }
  return [...links].map(([body, places]) => ({ body, places }));
}

/** Size of the shapes of joints: by what moves, and not larger than the space between two joints. */
function spacingOf(run: Run): number {
  const places = run.joints.map((joint) => run.drawn(joint.place).position), most = 0.03 * run.size;
  const nearest = places.slice(0, 500).flatMap((a) => {
    const apart = places.map((b) => Math.hypot(...subtract(a, b))).filter((d) => d > 1e-6 * run.size);
    return apart.length > 0 ? [Math.min(...apart)] : [];
  }).sort((a, b) => a - b);
  return nearest.length === 0 ? most : Math.max(0.25 * most, Math.min(most, 0.35 * nearest[nearest.length >> 1]!));
}

export class RunView {
  readonly group = new Group();
  readonly bodies: Batch;
  readonly traced = new Set<number>();
  /** Index of the chosen body, or -1. */
  chosen = -1;
  private readonly materials: Materials;
  private readonly plain: Materials;
  private readonly glyphs: { joints: Batch; markers: Batch; arrows: Batch };
  private readonly lines: Segments;
  private readonly traces: Segments;
  private readonly dots: Points;
  private readonly links: Link[];
  /** Bodies that are drawn, and those that have no size of their own. */
  private readonly drawn: number[] = [];
  private readonly markers: number[] = [];
  private readonly balls: number[] = [];
  /** Balls of inertia: seen through, for they are no shape of the body. */
  private readonly inertia: Batch;
  private readonly glass: Materials;
  private largestForce = 0;
  private largestMoment = 0;
  private arrowValues: Float64Array[][] = [];
  private readonly spacing: number;

  constructor(readonly run: Run, private readonly origin: Vec, shared: Uniforms) {
    this.materials = materialsOf(shared, true);
    this.plain = materialsOf(shared, false);
    this.glass = materialsOf(shared, true);
    const items: Item[] = [], balls: Item[] = [];
    for (const [b, body] of run.bodies.entries()) {
      const shape = body.shape === null ? null : run.shapes[body.shape]!;
      const isDrawn = shape !== null && shape.source !== "marker" && shape.vertices.length > 0;
      const isBall = isDrawn && shape.source === "inertia";
      (isBall ? this.balls : isDrawn ? this.drawn : this.markers).push(b);
      if (isDrawn) (isBall ? balls : items).push({ owner: b, shape, rgb: rgb(body.colour ?? BODY_COLOURS[b % BODY_COLOURS.length]!), mapped: body.kind !== "road", ground: body.kind === "road" });
    }
    this.bodies = new Batch(items, this.materials);
    this.inertia = new Batch(balls, this.glass);
    this.inertia.edges.visible = false;
    this.spacing = spacingOf(run);
    const glyphs = (made: [Item["shape"], readonly number[]][]): Batch =>
      new Batch(made.map(([shape, colour]) => ({ owner: 0, shape, rgb: colour, mapped: false })), this.plain);
    this.glyphs = {
      joints: glyphs(run.joints.map((joint) => [jointShape(joint.kind), JOINT])),
      markers: glyphs(this.markers.map(() => [markerShape(), MARKER])),
      arrows: glyphs(run.arrows.map((arrow) => [arrowShape(arrow.kind), rgb(arrow.kind === "moment" ? MOMENT : FORCE)])),
    };
    for (const batch of Object.values(this.glyphs)) batch.edges.visible = false;
    this.lines = new Segments(this.plain.segment);
    this.traces = new Segments(this.plain.segment);
    this.dots = this.nodeDots();
    for (const batch of [this.bodies, this.inertia, ...Object.values(this.glyphs)]) this.group.add(batch.group);
    this.group.add(this.lines.mesh, this.traces.mesh, this.dots);
    this.links = linksOf(run);
    this.placeBodies("body", 1);
    for (const batch of [this.bodies, this.inertia]) batch.keepStart();
  }

  /** Vertices of bodies that are drawn. */
  get vertices(): number {
    return this.bodies.vertices + this.inertia.vertices;
  }

  private nodeDots(): Points {
    const count = this.run.nodes.length, geometry = new BufferGeometry();
    const paint = new Uint8Array(4 * count);
    for (let i = 0; i < count; ++i) paint.set([232, 89, 12, 0], 4 * i);
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("paint", new BufferAttribute(paint, 4, true));
    geometry.setAttribute("value", new BufferAttribute(new Float32Array(count), 1));
    geometry.setAttribute("owner", new BufferAttribute(new Uint32Array(count), 1));
    const dots = new Points(geometry, this.plain.point);
    dots.frustumCulled = false;
    return dots;
  }

  /** Components of arrows, read when they are first shown. */
  async readArrows(): Promise<void> {
    if (this.arrowValues.length > 0) return;
    this.arrowValues = await Promise.all(this.run.arrows.map((arrow) => Promise.all(arrow.channels.map((c) => this.run.channel(c)))));
    for (const [i, parts] of this.arrowValues.entries()) {
      const isMoment = this.run.arrows[i]!.kind === "moment";
      for (let r = 0; r < (parts[0]?.length ?? 0); ++r) {
        const size = Math.hypot(...parts.map((part) => part[r] || 0));
        if (isMoment) this.largestMoment = Math.max(this.largestMoment, size);
        else this.largestForce = Math.max(this.largestForce, size);
      }
    }
  }

  ghost(rank: number): void {
    for (const materials of [this.materials, this.plain, this.glass]) {
      setOpacity(materials, rank === 0 ? 1 : 0.38);
      const tint = materials.surface.uniforms["tint"]!.value as Vector4;
      tint.set(...rgb(GHOST_COLOURS[rank % GHOST_COLOURS.length]!), rank === 0 ? 0 : 0.75);
    }
    this.group.renderOrder = rank;
    this.glass.surface.uniforms["opacity"]!.value = rank === 0 ? 0.3 : 0.15;
    this.glass.surface.transparent = true;
    this.glass.surface.depthWrite = false;
  }

  /** Moves everything to the present state of the run; `pixel` is the length of a pixel. */
  update(settings: Settings, pixel: number): void {
    this.group.visible = this.run.visible;
    if (!this.run.visible) return;
    this.run.exaggeration = settings.exaggeration;
    for (const materials of [this.materials, this.glass]) materials.surface.uniforms["chosen"]!.value = this.chosen;
    this.bodies.edges.visible = settings.edges;
    this.bodies.sides.visible = settings.elements;
    this.placeBodies(settings.colouring, settings.exaggeration);
    this.placeGlyphs(settings, pixel);
    this.placeLines(settings, pixel);
    this.placeDots(settings);
  }

  /** Widens a box by the bodies as they are drawn, joints, springs, bodies without a size, and if asked by the paths of traced nodes. */
  extend(low: Vec, high: Vec, paths: boolean): void {
    for (const batch of [this.bodies, this.inertia]) batch.extend(low, high);
    const points = [...this.markers.map((b) => this.run.pose(b)), ...this.run.joints.map((joint) => this.run.drawn(joint.place)),
      ...this.run.springs.flatMap((spring) => spring.ends.map((end) => this.run.drawn(end)))];
    for (const n of paths ? this.traced : []) for (const t of this.run.times) points.push(this.run.placeAt(this.run.nodes[n]!.place, t));
    for (const { position } of points)
      for (const [i, x] of subtract(position, this.origin).entries()) {
        low[i] = Math.min(low[i]!, x);
        high[i] = Math.max(high[i]!, x);
      }
  }

  private placeBodies(what: Colouring, exaggeration: number): void {
    for (const [batch, bodies] of [[this.bodies, this.drawn], [this.inertia, this.balls]] as const) this.placeBatch(batch, bodies, what, exaggeration);
  }

  private placeBatch(batch: Batch, bodies: number[], what: Colouring, exaggeration: number): void {
    const { run, origin } = this;
    for (const [i, b] of bodies.entries()) {
      const pose = run.pose(b), body = run.bodies[b]!;
      const isFlexible = body.amplitudes !== null && run.shapes[body.shape!]!.modes !== null;
      batch.place(i, subtract(pose.position, origin), pose.rotation, 1, isFlexible ? run.motion.amplitudes : null, body.first, exaggeration, what);
    }
    batch.flush(what !== "body");
  }

  private glyph(batch: Batch, i: number, pose: Pose, size: number): void {
    batch.place(i, subtract(pose.position, this.origin), pose.rotation, size, null, 0, 1, "body");
  }

  private placeGlyphs(settings: Settings, pixel: number): void {
    const size = settings.glyphScale * Math.min(this.spacing, 11 * pixel), { joints, markers, arrows } = this.glyphs;
    joints.group.visible = settings.joints;
    arrows.group.visible = settings.arrows && this.arrowValues.length > 0;
    if (settings.joints) for (const [i, joint] of this.run.joints.entries()) this.glyph(joints, i, this.run.drawn(joint.place), size);
    for (const [i, b] of this.markers.entries()) this.glyph(markers, i, this.run.pose(b), size);
    if (arrows.group.visible) this.placeArrows(settings);
    for (const batch of Object.values(this.glyphs)) batch.flush(false);
  }

  private placeArrows(settings: Settings): void {
    const { row, share } = this.run.locate(this.run.time);
    for (const [i, arrow] of this.run.arrows.entries()) {
      const pose = this.run.drawn(arrow.place);
      let vector = [0, 1, 2].map((c) => {
        const part = this.arrowValues[i]![c];
        if (!part) return 0;
        const a = part[row] ?? 0, b = part[Math.min(row + 1, part.length - 1)] ?? a;
        return Number.isFinite(a + b) ? a + share * (b - a) : 0;
      }) as Vec;
      if (arrow.axes === "place") vector = rotate(pose.rotation, vector);
      const largest = arrow.kind === "moment" ? this.largestMoment : this.largestForce;
      const size = largest > 0 ? (0.25 * this.run.size * settings.arrowScale * Math.hypot(...vector)) / largest : 0;
      this.glyph(this.glyphs.arrows, i, { position: pose.position, rotation: turnOfZ(vector) }, size);
    }
  }

  private placeLines(settings: Settings, pixel: number): void {
    this.lines.clear();
    if (settings.springs)
      for (const spring of this.run.springs) {
        const [a, b] = spring.ends.map((end) => subtract(this.run.drawn(end).position, this.origin));
        const points = spring.kind === "line" ? springLine(a!, b!, 0.014 * this.run.size) : [a!, b!];
        for (let i = 0; i + 1 < points.length; ++i) this.lines.add(points[i]!, points[i + 1]!, SPRING);
      }
    if (settings.bodyAxes)
      for (let b = 0; b < this.run.bodies.length; ++b) {
        const pose = this.run.pose(b), at = subtract(pose.position, this.origin);
        for (const [axis, colour] of AXES)
          this.lines.add(at, add(at, rotate(pose.rotation, scaled(axis, Math.min(0.06 * this.run.size, 42 * pixel)))), rgb(colour));
      }
    if (settings.joints) for (const link of this.links) this.placeLink(link);
    this.lines.flush();
  }

  /** A rigid body without a surface is seen by what holds it: its joints, joined to their middle, or one to its frame. */
  private placeLink({ body, places }: Link): void {
    const points = places.map((place) => subtract(this.run.drawn(place).position, this.origin)), colour = rgb(BODY_COLOURS[body % BODY_COLOURS.length]!);
    if (points.length === 1) points.push(subtract(this.run.pose(body).position, this.origin));
    const middle = scaled(points.reduce((sum, p) => add(sum, p), [0, 0, 0] as Vec), 1 / points.length);
    for (const point of points) this.lines.add(middle, point, colour);
  }

  /** The paths of the traced nodes over all instants, as in the results. */
  retrace(): void {
    this.traces.clear();
    for (const [rank, n] of [...this.traced].entries()) {
      const place = this.run.nodes[n]!.place, colour = rgb(LINE_COLOURS[rank % LINE_COLOURS.length]!);
      let before: Vec | null = null;
      for (const t of this.run.times) {
        const here = subtract(this.run.placeAt(place, t).position, this.origin);
        if (before) this.traces.add(before, here, colour, 0.9);
        before = here;
      }
    }
    this.traces.flush();
  }

  private placeDots(settings: Settings): void {
    this.dots.visible = settings.nodes || this.traced.size > 0;
    if (!this.dots.visible) return;
    const position = this.dots.geometry.getAttribute("position") as BufferAttribute;
    for (const [i, node] of this.run.nodes.entries()) {
      const shown = settings.nodes || this.traced.has(i);
      const p = shown ? subtract(this.run.drawn(node.place).position, this.origin) : [NaN, NaN, NaN];
      position.setXYZ(i, p[0]!, p[1]!, p[2]!);
    }
    position.needsUpdate = true;
  }

  /** What carries ids while a pixel is picked: surfaces of bodies only. */
  picking(first: number): void {
    this.materials.pick.uniforms["firstId"]!.value = first;
    const surfaces = [this.bodies.surface, this.inertia.surface] as Object3D[];
    this.hidden.length = 0;
    this.group.traverse((object) => {
      const isSurface = surfaces.includes(object), isGroup = object.children.length > 0;
      if (!isSurface && !isGroup && object.visible) this.hidden.push(object);
    });
    for (const object of this.hidden) object.visible = false;
    this.bodies.surface.material = this.inertia.surface.material = this.materials.pick;
  }
  picked(): void {
    this.bodies.surface.material = this.materials.surface;
    this.inertia.surface.material = this.glass.surface;
    for (const object of this.hidden) object.visible = true;
  }
  private readonly hidden: Object3D[] = [];
}
