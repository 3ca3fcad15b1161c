// SPDX-License-Identifier: GPL-3.0-or-later
// Stored arrays of the page: bytes of a block -> typed values, and their reading row by row without a copy.
import { require } from "./failure";
import type { ArrayEntry } from "./header";

export type Stored = Int16Array | Uint16Array | Uint32Array | Float32Array | Uint8Array;

const WIDTH = { i16: 2, u16: 2, u32: 4, f32: 4, u8: 1 } as const;

/** An array in memory: value = offset + scale * stored. */
export class Values {
  readonly rows: number;
  readonly columns: number;
  constructor(readonly stored: Stored, readonly shape: number[], private readonly entry: ArrayEntry) {
    this.rows = shape[0] ?? 1;
    this.columns = this.rows > 0 ? stored.length / this.rows : 0;
  }

  /** Scale and offset of column c of row r. */
  private of(list: number | number[] | undefined, otherwise: number, row: number, column: number): number {
    if (list === undefined) return otherwise;
    if (typeof list === "number") return list;
    const last = this.shape[this.shape.length - 1]!;
    return list[this.entry.scaled === "first" ? row : column % last] ?? otherwise;
  }

  scale(row: number, column = 0): number {
    return this.of(this.entry.scale, 1, row, column);
  }

  at(row: number, column = 0): number {
    const stored = this.stored[row * this.columns + column]!;
    return this.of(this.entry.offset, 0, row, column) + this.scale(row, column) * stored;
  }

  /** Row r into out; a row beyond the last is the last (arrays of one row are constant). */
  row(row: number, out: Float64Array): void {
    const r = Math.min(row, this.rows - 1);
    for (let c = 0; c < this.columns; ++c) out[c] = this.at(r, c);
  }

  all(): Float64Array {
    const out = new Float64Array(this.stored.length);
    for (let r = 0, i = 0; r < this.rows; ++r) for (let c = 0; c < this.columns; ++c) out[i++] = this.at(r, c);
    return out;
  }
}

/** Undoes the byte planes: byte k of element i was stored at [k * n + i]. */
function joinPlanes(bytes: Uint8Array, n: number, width: number): Uint8Array {
  const out = new Uint8Array(n * width);
  for (let k = 0; k < width; ++k) for (let i = 0; i < n; ++i) out[i * width + k] = bytes[k * n + i]!;
  return out;
}

/** Undoes the differences to the element one row before; integers wrap at their width. */
function sumDifferences(values: Uint8Array | Uint16Array | Uint32Array, columns: number): void {
  for (let i = columns; i < values.length; ++i) values[i] = values[i]! + values[i - columns]!;
}

function unpack(bytes: Uint8Array, n: number, width: number, columns: number): ArrayBuffer {
  const joined = width === 1 ? bytes.slice() : joinPlanes(bytes, n, width);
  const buffer = joined.buffer as ArrayBuffer;
  sumDifferences(
    width === 1 ? joined : width === 2 ? new Uint16Array(buffer) : new Uint32Array(buffer),
    columns,
  );
  return buffer;
}

/** The array of `entry` in its block; `where` names it in messages. Bytes are little endian, as every machine with a browser. */
export function decode(entry: ArrayEntry, block: Uint8Array, where: string): Values {
  const width = WIDTH[entry.type];
  require(width !== undefined, `${where}: unknown type '${entry.type}'`);
  require(
    Array.isArray(entry.shape) && entry.shape.every((extent) => Number.isInteger(extent) && extent >= 0),
    `${where}: a shape is a list of counts`,
  );
  const n = entry.shape.reduce((product, extent) => product * extent, 1);
  const at = entry.at ?? 0;
  require(at + n * width <= block.length, `${where}: ${n * width} bytes at ${at}, but its block holds ${block.length}`);
  const bytes = block.subarray(at, at + n * width);
  const columns = entry.shape.length > 1 ? entry.shape[entry.shape.length - 1]! : 1;
  const buffer = entry.packed === true ? unpack(bytes, n, width, columns) : (bytes.slice().buffer as ArrayBuffer);
  const view = {
    i16: Int16Array,
    u16: Uint16Array,
    u32: Uint32Array,
    f32: Float32Array,
    u8: Uint8Array,
  }[entry.type];
  return new Values(new view(buffer), entry.shape, entry);
}
