// One run in the picture: its bodies, joints, virtual bodies, springs, arrows, nodes and traces, moved with Run.motion.
import { BufferAttribute, BufferGeometry, Group, Points, Vector4 } from "three";
import { add, rotate, scaled, subtract, turnOfZ } from "../data/rotation";
import type { Vec } from "../data/rotation";
import type { Place, Run } from "../data/run";
import { batchOf } from "./batch";
import type { Batch, Item } from "./batch";
import { BODY_COLOURS, GHOST_COLOURS, LINE_COLOURS, rgb } from "./colours";
import { arrowShape, jointShape, markerShape } from "./glyphs";
import { materialsOf, setOpacity } from "./materials";
import type { Materials, Uniforms } from "./materials";
import { Segments } from "./segments";
import type { Settings } from "./settings";
import { springLine } from "./spring_line";
import { Amplitudes, modeTable, Records } from "./textures";

const AXES: [Vec, string][] = [[[1, 0, 0], "#c23b3b"], [[0, 1, 0], "#3c8d3c"], [[0, 0, 1], "#3b62c2"]];
const JOINT = rgb("#d9a441"), MARKER = rgb("#9aa3ad"), SPRING = rgb("#7b8794");
export const FORCE = "#d1495b", MOMENT = "#8e5ea2";

export class RunView {
  readonly group = new Group();
  readonly bodies: Batch;
  readonly traced = new Set<number>();
  /** Index of the chosen body, or -1. */
  chosen = -1;
  private readonly records: Records;
  private readonly amplitudes: Amplitudes;
  private readonly factors: { at: number; modes: number; stresses: number }[] = [];
  private readonly materials: Materials;
  private readonly glyphRecords: Records;
  private readonly glyphs: { joints: Batch; markers: Batch; arrows: Batch };
  private readonly glyphMaterials: Materials;
  private readonly lines: Segments;
  private readonly traces: Segments;
  private readonly dots: Points;
  private readonly markers: number[] = [];
  private largestForce = 0;
  private largestMoment = 0;
  private arrowValues: Float64Array[][] = [];

  constructor(readonly run: Run, private readonly origin: Vec, shared: Uniforms, largestTexture: number) {
    this.records = new Records(run.bodies.length);
    this.amplitudes = new Amplitudes(run.motion.amplitudes.length);
    const modes = modeTable(run.shapes.map((s) => s.modes), 3, largestTexture);
    const stresses = modeTable(run.shapes.map((s) => s.stress?.modes ?? null), 6, largestTexture);
    const own = (records: Records): Uniforms => ({
      records: { value: records.texture }, amplitudes: { value: this.amplitudes.texture }, modes: { value: modes.texture },
      stresses: { value: stresses.texture }, exaggeration: { value: 1 }, opacity: { value: 1 }, chosen: { value: -1 },
      tint: { value: new Vector4(0, 0, 0, 0) },
    });
    const plain = (records: Records): Materials => materialsOf(shared, { ...own(records), colouring: { value: 0 } });
    this.materials = materialsOf(shared, own(this.records));
    const items: Item[] = [];
    for (const [b, body] of run.bodies.entries()) {
      const shape = body.shape === null ? null : run.shapes[body.shape]!;
      const drawn = shape !== null && shape.source !== "marker" && shape.vertices.length > 0;
      if (drawn) items.push({ record: b, shape });
      else this.markers.push(b);
      const m = drawn ? modes.scales[body.shape!]!.length : 0;
      if (body.amplitudes && drawn)
        for (let k = 0; k < Math.min(m, body.amplitudes.columns); ++k)
          this.factors.push({ at: body.first + k, modes: modes.scales[body.shape!]![k]!, stresses: stresses.scales[body.shape!]![k] ?? 0 });
      this.records.meta(b, body.first, Math.min(m, body.amplitudes?.columns ?? 0), drawn ? modes.first[body.shape!]! : 0,
        shape?.stress ? stresses.first[body.shape!]! : -1);
      this.records.colour(b, rgb(BODY_COLOURS[b % BODY_COLOURS.length]!), true);
      const pose = run.pose(b);
      this.records.start(b, subtract(pose.position, origin), pose.rotation);
    }
    this.bodies = batchOf(items, this.materials);
    const jointCount = run.joints.length, markerCount = this.markers.length;
    this.glyphRecords = new Records(jointCount + markerCount + run.arrows.length);
    this.glyphMaterials = plain(this.glyphRecords);
    const glyphs = (shapes: Item["shape"][], first: number): Batch =>
      batchOf(shapes.map((shape, i) => ({ record: first + i, shape })), this.glyphMaterials);
    this.glyphs = {
      joints: glyphs(run.joints.map((joint) => jointShape(joint.kind)), 0),
      markers: glyphs(this.markers.map(() => markerShape()), jointCount),
      arrows: glyphs(run.arrows.map((arrow) => arrowShape(arrow.kind)), jointCount + markerCount),
    };
    for (let i = 0; i < jointCount; ++i) this.glyphRecords.colour(i, JOINT, false);
    for (let i = 0; i < markerCount; ++i) this.glyphRecords.colour(jointCount + i, MARKER, false);
    for (const [i, arrow] of run.arrows.entries())
      this.glyphRecords.colour(jointCount + markerCount + i, rgb(arrow.kind === "moment" ? MOMENT : FORCE), false);
    for (const batch of Object.values(this.glyphs)) batch.edges.visible = false;
    this.lines = new Segments(this.glyphMaterials.segment);
    this.traces = new Segments(this.glyphMaterials.segment);
    this.dots = this.nodeDots(plain);
    for (const item of [this.bodies, ...Object.values(this.glyphs)]) this.group.add(item.group);
    this.group.add(this.lines.mesh, this.traces.mesh, this.dots);
  }

  private nodeDots(plain: (records: Records) => Materials): Points {
    const count = this.run.nodes.length, geometry = new BufferGeometry(), still = new Records(1);
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Int8Array(3 * count), 3, true));
    geometry.setAttribute("source", new BufferAttribute(new Uint32Array(2 * count), 2));
    still.colour(0, rgb("#e8590c"), false);
    const dots = new Points(geometry, plain(still).point);
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
    for (const materials of [this.materials, this.glyphMaterials]) {
      setOpacity(materials, rank === 0 ? 1 : 0.38);
      const tint = materials.surface.uniforms["tint"]!.value as Vector4;
      tint.set(...rgb(GHOST_COLOURS[rank % GHOST_COLOURS.length]!), rank === 0 ? 0 : 0.75);
    }
    this.group.renderOrder = rank;
  }

  /** Textures and lines of the present state of the run. */
  update(settings: Settings, pixel: number): void {
    const { run, origin } = this;
    this.group.visible = run.visible;
    if (!run.visible) return;
    run.exaggeration = settings.exaggeration;
    for (let b = 0; b < run.bodies.length; ++b) {
      const pose = run.pose(b);
      this.records.pose(b, subtract(pose.position, origin), pose.rotation, 1);
    }
    for (const { at, modes, stresses } of this.factors) {
      const a = run.motion.amplitudes[at]!;
      this.amplitudes.data[4 * at] = a * modes;
      this.amplitudes.data[4 * at + 1] = a * stresses;
    }
    this.amplitudes.texture.needsUpdate = true;
    this.materials.surface.uniforms["exaggeration"]!.value = settings.exaggeration;
    this.materials.surface.uniforms["chosen"]!.value = this.chosen;
    this.bodies.edges.visible = settings.edges;
    this.placeGlyphs(settings, pixel);
    this.placeLines(settings, pixel);
    this.placeDots(settings);
  }

  /** Keeps the amplitudes at the start, from which displacement is measured. */
  markStart(): void {
    for (const { at, modes } of this.factors) this.amplitudes.data[4 * at + 2] = this.run.motion.amplitudes[at]! * modes;
  }

  private glyph(i: number, place: Place, size: number): void {
    const pose = this.run.drawn(place);
    this.glyphRecords.pose(i, subtract(pose.position, this.origin), pose.rotation, size);
  }

  private placeGlyphs(settings: Settings, pixel: number): void {
    const size = settings.glyphScale * Math.min(0.03 * this.run.size, 11 * pixel);
    this.glyphs.joints.group.visible = settings.joints;
    this.glyphs.arrows.group.visible = settings.arrows && this.arrowValues.length > 0;
    for (const [i, joint] of this.run.joints.entries()) this.glyph(i, joint.place, size);
    for (const [i, b] of this.markers.entries()) {
      const pose = this.run.pose(b);
      this.glyphRecords.pose(this.run.joints.length + i, subtract(pose.position, this.origin), pose.rotation, size);
    }
    if (this.glyphs.arrows.group.visible) this.placeArrows(settings);
  }

  private placeArrows(settings: Settings): void {
    const { row, share } = this.run.locate(this.run.time), first = this.run.joints.length + this.markers.length;
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
      this.glyphRecords.pose(first + i, subtract(pose.position, this.origin), turnOfZ(vector), size);
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
    this.lines.flush();
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

  /** Materials of picking, ids from `first`. */
  picking(first: number): void {
    this.materials.pick.uniforms["firstId"]!.value = first;
    this.bodies.surface.material = this.materials.pick;
    for (const object of [this.bodies.edges, this.bodies.points, this.bodies.lines.mesh]) object.userData["shown"] = object.visible, object.visible = false;
    for (const other of this.group.children) if (other !== this.bodies.group) other.userData["shown"] = other.visible, other.visible = false;
  }
  picked(): void {
    this.bodies.surface.material = this.materials.surface;
    for (const object of [this.bodies.edges, this.bodies.points, this.bodies.lines.mesh]) object.visible = object.userData["shown"] as boolean;
    for (const other of this.group.children) if (other !== this.bodies.group) other.visible = other.userData["shown"] as boolean;
  }
}
