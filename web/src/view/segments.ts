// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a width in pixels: one quad a segment.
import { BufferAttribute, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, Mesh } from "three";
import type { RawShaderMaterial } from "three";

export class Segments {
  readonly mesh: Mesh;
  private readonly geometry = new InstancedBufferGeometry();
  private readonly arrays: Record<"from" | "to" | "values" | "paint", Float32Array>;
  private count = 0;

  constructor(material: RawShaderMaterial, capacity = 64) {
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.arrays = { from: new Float32Array(), to: new Float32Array(), values: new Float32Array(), paint: new Float32Array() };
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.grow(capacity);
    this.flush();
  }

  private grow(capacity: number): void {
    this.geometry.dispose();
    for (const [name, width] of [["from", 3], ["to", 3], ["values", 2], ["paint", 4]] as const) {
      const wider = new Float32Array(width * capacity);
      wider.set(this.arrays[name]);
      this.arrays[name] = wider;
      this.geometry.setAttribute(name, new InstancedBufferAttribute(wider, width).setUsage(DynamicDrawUsage));
    }
  }

  clear(): void {
    this.count = 0;
  }

  add(a: ArrayLike<number>, b: ArrayLike<number>, rgb: readonly number[], alpha = 1): void {
    if (4 * this.count >= this.arrays.paint.length) this.grow(2 * this.count);
    this.arrays.paint.set([rgb[0]!, rgb[1]!, rgb[2]!, alpha], 4 * this.count);
    this.move(this.count++, a, 0, b, 0, 0, 0);
  }

  /** Moves segment i to between the points at `ia` of a and at `ib` of b, with their values. */
  move(i: number, a: ArrayLike<number>, ia: number, b: ArrayLike<number>, ib: number, va: number, vb: number): void {
    const { from, to, values } = this.arrays;
    for (let c = 0; c < 3; ++c) {
      from[3 * i + c] = a[ia + c]!;
      to[3 * i + c] = b[ib + c]!;
    }
    values[2 * i] = va;
    values[2 * i + 1] = vb;
  }

  flush(): void {
    for (const name of ["from", "to", "values", "paint"]) this.geometry.getAttribute(name).needsUpdate = true;
    this.geometry.instanceCount = this.count;
    this.mesh.visible = this.count > 0;
  }
}
