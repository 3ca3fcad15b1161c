// Lines of a width in pixels: one quad a segment, of bodies (deformed in the shader) or of the world (rewritten when they move).
import { BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, Mesh } from "three";
import type { RawShaderMaterial } from "three";

export class Segments {
  readonly mesh: Mesh;
  private readonly geometry = new InstancedBufferGeometry();
  private from = new Float32Array();
  private to = new Float32Array();
  private owners = new Int32Array();
  private paint = new Float32Array();
  private count = 0;

  constructor(material: RawShaderMaterial, capacity = 64) {
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.grow(capacity);
    this.flush();
  }

  private grow(capacity: number): void {
    const wider = <T extends Float32Array | Int32Array>(old: T, made: T): T => (made.set(old), made);
    this.from = wider(this.from, new Float32Array(3 * capacity));
    this.to = wider(this.to, new Float32Array(3 * capacity));
    this.owners = wider(this.owners, new Int32Array(3 * capacity));
    this.paint = wider(this.paint, new Float32Array(4 * capacity));
    this.geometry.dispose();
    this.geometry.setAttribute("from", new InstancedBufferAttribute(this.from, 3));
    this.geometry.setAttribute("to", new InstancedBufferAttribute(this.to, 3));
    this.geometry.setAttribute("owner3", new InstancedBufferAttribute(this.owners, 3));
    this.geometry.setAttribute("paint", new InstancedBufferAttribute(this.paint, 4));
  }

  clear(): void {
    this.count = 0;
  }

  /** A segment of the world, or of record `owner[0]` between its vertices owner[1] and owner[2]. Alpha 0: the record's colour. */
  add(a: ArrayLike<number>, b: ArrayLike<number>, rgb: readonly number[], alpha = 1, owner: readonly number[] = [-1, 0, 0]): void {
    if (3 * this.count >= this.from.length) this.grow(2 * this.count);
    for (let c = 0; c < 3; ++c) {
      this.from[3 * this.count + c] = a[c]!;
      this.to[3 * this.count + c] = b[c]!;
      this.owners[3 * this.count + c] = owner[c]!;
      this.paint[4 * this.count + c] = rgb[c]!;
    }
    this.paint[4 * this.count + 3] = alpha;
    ++this.count;
  }

  flush(): void {
    for (const name of ["from", "to", "owner3", "paint"]) this.geometry.getAttribute(name).needsUpdate = true;
    this.geometry.instanceCount = this.count;
    this.mesh.visible = this.count > 0;
  }
}
