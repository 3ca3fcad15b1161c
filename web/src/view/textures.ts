// The textures that the shaders read: records of bodies, amplitudes, modes and stresses as 16-bit integers.
import { DataTexture, FloatType, NearestFilter, RGBAFormat, RGBAIntegerFormat, ShortType } from "three";
import type { Values } from "../data/arrays";
import type { Quaternion, Vec } from "../data/rotation";
import { AMPLITUDES_PER_ROW, MODE_TEXELS_PER_ROW, RECORD_TEXELS, RECORDS_PER_ROW } from "./shaders";

function floats(width: number, height: number): { data: Float32Array; texture: DataTexture } {
  const data = new Float32Array(4 * width * height);
  const texture = new DataTexture(data, width, height, RGBAFormat, FloatType);
  texture.internalFormat = "RGBA32F";
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return { data, texture };
}

export class Records {
  readonly texture: DataTexture;
  private readonly data: Float32Array;

  constructor(readonly count: number) {
    ({ data: this.data, texture: this.texture } = floats(RECORD_TEXELS * RECORDS_PER_ROW, Math.max(1, Math.ceil(count / RECORDS_PER_ROW))));
    for (let i = 0; i < count; ++i) this.set(i, 3, [0, 0, 0, 0]), this.pose(i, [0, 0, 0], [1, 0, 0, 0], 1), this.meta(i, 0, 0, 0, -1);
  }
  private set(i: number, texel: number, values: ArrayLike<number>): void {
    this.data.set(values, 4 * (RECORD_TEXELS * i + texel));
  }
  pose(i: number, p: Vec, q: Quaternion, scale: number): void {
    const at = 4 * RECORD_TEXELS * i, d = this.data;
    d[at] = p[0], d[at + 1] = p[1], d[at + 2] = p[2], d[at + 3] = scale;
    d[at + 4] = q[1], d[at + 5] = q[2], d[at + 6] = q[3], d[at + 7] = q[0];
    this.texture.needsUpdate = true;
  }
  start(i: number, p: Vec, q: Quaternion): void {
    this.set(i, 3, [...p, 0]);
    this.set(i, 4, [q[1], q[2], q[3], q[0]]);
  }
  meta(i: number, first: number, count: number, modes: number, stresses: number): void {
    this.set(i, 2, [first, count, modes, stresses]);
  }
  /** `mapped`: whether the colour of a quantity replaces its own. */
  colour(i: number, rgb: readonly number[], mapped: boolean): void {
    this.set(i, 5, [rgb[0]!, rgb[1]!, rgb[2]!, mapped ? 1 : 0]);
    this.texture.needsUpdate = true;
  }
}

/** Amplitudes times the scales of modes (x, at the start z) and of stresses (y). */
export class Amplitudes {
  readonly texture: DataTexture;
  readonly data: Float32Array;
  constructor(count: number) {
    ({ data: this.data, texture: this.texture } = floats(AMPLITUDES_PER_ROW, Math.max(1, Math.ceil(count / AMPLITUDES_PER_ROW))));
  }
}

export interface ModeTable {
  texture: DataTexture;
  /** First texel of each block of modes, in the order given. */
  first: number[];
  /** Scale of each mode of each block: value = scale * stored. */
  scales: number[][];
}

/** Modes [m, V * components] of several shapes, vertex by vertex: texel (vertex * m + k) * texels, 16-bit integers. */
export function modeTable(blocks: (Values | null)[], components: 3 | 6, largest: number): ModeTable {
  const texels = components / 3;
  const first: number[] = [], scales: number[][] = [];
  let total = 0;
  for (const block of blocks) {
    first.push(total);
    if (block) total += (block.rows * block.columns * texels) / components;
  }
  const height = Math.max(1, Math.ceil(total / MODE_TEXELS_PER_ROW));
  if (height > largest) throw new Error("the modes are too many for a texture of this graphics driver");
  const data = new Int16Array(4 * MODE_TEXELS_PER_ROW * height);
  for (const [b, block] of blocks.entries()) scales.push(block ? fill(data, 4 * first[b]!, block, components) : []);
  const texture = new DataTexture(data, MODE_TEXELS_PER_ROW, height, RGBAIntegerFormat, ShortType);
  texture.internalFormat = "RGBA16I";
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return { texture, first, scales };
}

function fill(data: Int16Array, at: number, block: Values, components: 3 | 6): number[] {
  const scales: number[] = [], texels = components / 3, vertices = block.columns / components;
  for (let k = 0; k < block.rows; ++k) {
    let largest = 0;
    for (let c = 0; c < block.columns; ++c) largest = Math.max(largest, Math.abs(block.at(k, c)));
    const scale = largest / 32767 || 1;
    scales.push(scale);
    for (let v = 0; v < vertices; ++v)
      for (let c = 0; c < components; ++c) {
        const texel = texels * (v * block.rows + k) + (components === 6 && c > 3 ? 1 : 0);
        data[at + 4 * texel + (components === 6 && c > 3 ? c - 4 : c)] = Math.round(block.at(k, components * v + c) / scale);
      }
  }
  return scales;
}
