// All shapes of a run (or all glyphs) as four draw calls: surfaces, creases, lines, points.
import { BufferAttribute, BufferGeometry, Group, Int8BufferAttribute, LineSegments, Mesh, Points, Uint32BufferAttribute } from "three";
import type { Shape } from "../data/run";
import { facetsOf } from "./facets";
import type { Facets } from "./facets";
import type { Materials } from "./materials";
import { Segments } from "./segments";

export interface Item {
  record: number;
  shape: Shape;
}

export interface Batch {
  group: Group;
  surface: Mesh;
  edges: LineSegments;
  points: Points;
  lines: Segments;
  /** Vertices drawn, doubled ones of creases counted. */
  vertices: number;
  triangles: number;
}

class Gatherer {
  readonly position: number[] = [];
  readonly normal: number[] = [];
  readonly source: number[] = [];
  readonly triangles: number[] = [];
  readonly edges: number[] = [];
  readonly points: number[] = [];
  private readonly facets = new Map<Shape, Facets>();

  private vertex(item: Item, v: number, normal: ArrayLike<number>, at: number): void {
    const p = item.shape.vertices;
    this.position.push(p[3 * v]!, p[3 * v + 1]!, p[3 * v + 2]!);
    this.normal.push(Math.round(127 * normal[at]!), Math.round(127 * normal[at + 1]!), Math.round(127 * normal[at + 2]!));
    this.source.push(item.record, v);
  }
  surface(item: Item): void {
    let facets = this.facets.get(item.shape);
    if (!facets) this.facets.set(item.shape, (facets = facetsOf(item.shape)));
    const first = this.source.length / 2;
    for (let i = 0; i < facets.source.length; ++i) this.vertex(item, facets.source[i]!, facets.normals, 3 * i);
    for (const i of facets.triangles) this.triangles.push(first + i);
    for (const i of facets.edges) this.edges.push(first + i);
  }
  dots(item: Item): void {
    for (let v = 0; v < item.shape.vertices.length / 3; ++v) {
      this.points.push(this.source.length / 2);
      this.vertex(item, v, [0, 0, 1], 0);
    }
  }
}

function geometryOf(gathered: Gatherer, index: number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(gathered.position), 3));
  geometry.setAttribute("normal", new Int8BufferAttribute(gathered.normal, 3, true));
  geometry.setAttribute("source", new Uint32BufferAttribute(gathered.source, 2));
  geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
  return geometry;
}

export function batchOf(items: Item[], materials: Materials): Batch {
  const gathered = new Gatherer();
  const lines = new Segments(materials.segment, 1024);
  for (const item of items) {
    const { vertices, lines: pairs, triangles } = item.shape;
    if (triangles.length > 0) gathered.surface(item);
    if (item.shape.points) gathered.dots(item);
    for (let i = 0; i + 1 < pairs.length; i += 2) {
      const a = pairs[i]!, b = pairs[i + 1]!;
      lines.add(vertices.subarray(3 * a, 3 * a + 3), vertices.subarray(3 * b, 3 * b + 3), [0, 0, 0], 0, [item.record, a, b]);
    }
  }
  lines.flush();
  const surface = new Mesh(geometryOf(gathered, gathered.triangles), materials.surface);
  const edges = new LineSegments(new BufferGeometry(), materials.edge);
  const points = new Points(new BufferGeometry(), materials.point);
  for (const [object, index] of [[edges, gathered.edges], [points, gathered.points]] as const) {
    for (const name of ["position", "normal", "source"]) object.geometry.setAttribute(name, surface.geometry.getAttribute(name));
    object.geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
  }
  const group = new Group();
  for (const object of [surface, edges, points]) object.frustumCulled = false;
  surface.visible = gathered.triangles.length > 0;
  points.visible = gathered.points.length > 0;
  group.add(surface, edges, lines.mesh, points);
  return { group, surface, edges, points, lines, vertices: gathered.source.length / 2, triangles: gathered.triangles.length / 3 };
}
