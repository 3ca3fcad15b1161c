// SPDX-License-Identifier: GPL-3.0-or-later
// Pixels of a PNG as Chromium writes it: 8 bits, RGB or RGBA, not interlaced.
import { inflateSync } from "node:zlib";

export function decodePng(bytes) {
  const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20), depth = { 2: 3, 6: 4 }[bytes[25]];
  const parts = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at))
    if (bytes.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts)), line = width * depth, pixels = new Uint8Array(line * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (line + 1)];
    for (let i = 0; i < line; ++i) {
      const left = i >= depth ? pixels[y * line + i - depth] : 0, above = y > 0 ? pixels[(y - 1) * line + i] : 0;
      const corner = i >= depth && y > 0 ? pixels[(y - 1) * line + i - depth] : 0;
      pixels[y * line + i] = raw[y * (line + 1) + 1 + i] + [0, left, above, (left + above) >> 1, paeth(left, above, corner)][filter];
    }
  }
  return { width, height, at: (x, y) => [...pixels.subarray((Math.round(y) * width + Math.round(x)) * depth, (Math.round(y) * width + Math.round(x)) * depth + 3)] };
}

function paeth(a, b, c) {
  const p = a + b - c, [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}
