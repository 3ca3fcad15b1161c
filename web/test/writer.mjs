// SPDX-License-Identifier: GPL-3.0-or-later
// Writes pages of the data contract for tests: arrays -> blocks -> the two elements of the page.
import { deflateSync } from "node:zlib";

const TYPES = { i16: Int16Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, u8: Uint8Array };

/** Differences to the row before, then byte planes: what the reader undoes. */
function pack(stored, columns) {
  const width = stored.BYTES_PER_ELEMENT, n = stored.length, words = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[width];
  const bits = new words(stored.buffer.slice(0)), out = new Uint8Array(n * width);
  for (let i = n - 1; i >= columns; --i) bits[i] = bits[i] - bits[i - columns];
  const bytes = new Uint8Array(bits.buffer);
  for (let k = 0; k < width; ++k) for (let i = 0; i < n; ++i) out[k * n + i] = bytes[i * width + k];
  return out;
}

export class Blocks {
  constructor() {
    this.parts = [[]];
  }
  next() {
    this.parts.push([]);
  }
  /** An array entry of values = offset + scale * stored, in the last block. */
  array(type, shape, stored, extra = {}) {
    const typed = stored instanceof TYPES[type] ? stored : TYPES[type].from(stored);
    const columns = shape.length > 1 ? shape[shape.length - 1] : 1;
    const bytes = extra.packed ? pack(typed, columns) : new Uint8Array(typed.buffer.slice(typed.byteOffset, typed.byteOffset + typed.byteLength));
    const block = this.parts.at(-1), at = block.reduce((sum, part) => sum + part.length, 0);
    block.push(bytes);
    if (bytes.length % 4) block.push(new Uint8Array(4 - (bytes.length % 4)));
    return { block: this.parts.length - 1, at, type, shape, ...extra };
  }
  /** 16-bit integers over the range of all values, to half a step. */
  quantised(shape, values, extra = {}) {
    let low = Infinity, high = -Infinity;
    for (const v of values) low = Math.min(low, v), high = Math.max(high, v);
    const offset = (low + high) / 2, scale = (high - low) / 65534 || 1;
    return this.array("i16", shape, Int16Array.from(values, (v) => Math.round((v - offset) / scale)), { scale, offset, ...extra });
  }
  rotations(shape, values, extra = {}) {
    return this.array("i16", shape, Int16Array.from(values, (v) => Math.round(v * 32767)), { scale: 1 / 32767, ...extra });
  }
  floats(shape, values, extra = {}) {
    return this.array("f32", shape, Float32Array.from(values), extra);
  }
  /** Blocks one after another, and their extents. */
  finish() {
    const extents = [], compressed = [];
    let at = 0;
    for (const parts of this.parts) {
      const bytes = deflateSync(Buffer.concat(parts));
      extents.push([at, bytes.length]);
      compressed.push(bytes);
      at += bytes.length;
    }
    return { blocks: extents, text: Buffer.concat(compressed).toString("base64") };
  }
}

export function pageOf(viewer, header, blocks, { damage = (text) => text } = {}) {
  const { blocks: extents, text } = blocks.finish();
  const json = JSON.stringify({ ...header, blocks: extents }).replace(/[<>&\u2028\u2029]/g, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`);
  const marker = "<!-- tisserand-data -->";
  if (viewer.split(marker).length !== 2) throw new Error("the viewer has not one place for its data");
  return viewer.replace(marker, () => `<script type="application/json" id="tisserand-header">${json}</script>\n`
    + `<script type="text/plain" id="tisserand-blocks">${damage(text)}</script>`);
}

export const header = (title, runs) => ({ format: "tisserand-page", version: 1, title, program: "test pages", runs });

/** A run with nothing in it; a test fills what it needs. */
export const emptyRun = (name) => ({
  name, file: `${name}.results.h5`, kind: "dynamics", completed: true, reason: "",
  units: { length: "m", time: "s", angle: "rad", force: "N", moment: "N m", stress: "Pa", energy: "J", mass: "kg" },
  pascal: 1, up: [0, 0, 1], gravity: [0, 0, -9.81], thinned: null, box: [[-1, -1, -1], [1, 1, 1]],
  bodies: [], shapes: [], nodes: [], joints: [], springs: [], arrows: [], channels: [], channels_left_out: null, references: [], modes: null,
  report: { notes: [], doubts: [], lines: [], phases: [], energy: {}, effects: [] }, scene: null,
});
