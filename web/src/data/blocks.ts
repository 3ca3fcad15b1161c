// SPDX-License-Identifier: GPL-3.0-or-later
// The compressed blocks of the page: base64 text -> bytes, inflated when first asked for and kept.
import { decode, Values } from "./arrays";
import { Failure, require, WRITE_AGAIN } from "./failure";
import type { ArrayEntry } from "./header";

function bytesOf(text: string): Uint8Array {
  const native = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array }).fromBase64;
  try {
    if (native) return native.call(Uint8Array, text);
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  } catch {
    throw new Failure("The numbers of this page are damaged: they are not base64 text.", WRITE_AGAIN);
  }
}

async function inflate(bytes: Uint8Array, index: number): Promise<Uint8Array> {
  if (typeof DecompressionStream === "undefined")
    throw new Failure("This browser cannot unpack the numbers of the page (no DecompressionStream).",
      "Open it in a browser of 2023 or later.");
  try {
    const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new Failure(`The numbers of this page are damaged: block ${index} does not unpack.`, WRITE_AGAIN);
  }
}

export class Blocks {
  private readonly bytes: Uint8Array;
  private readonly inflated = new Map<number, Promise<Uint8Array>>();
  private readonly open = new Map<number, Uint8Array>();

  constructor(text: string, private readonly extents: [number, number][]) {
    this.bytes = bytesOf(text.trim());
  }

  private block(index: number): Promise<Uint8Array> {
    const known = this.inflated.get(index);
    if (known) return known;
    const extent = this.extents[index];
    require(extent !== undefined, `The header names block ${index}, but there are ${this.extents.length} blocks.`);
    const [at, length] = extent;
    require(
      at >= 0 && length >= 0 && at + length <= this.bytes.length,
      `The page is incomplete: block ${index} ends at byte ${at + length} of ${this.bytes.length}.`,
    );
    const promise = inflate(this.bytes.subarray(at, at + length), index).then((block) => {
      this.open.set(index, block);
      return block;
    });
    this.inflated.set(index, promise);
    return promise;
  }

  async read(entry: ArrayEntry, where: string): Promise<Values> {
    require(entry !== null && typeof entry === "object", `${where}: missing`);
    return decode(entry, this.open.get(entry.block) ?? (await this.block(entry.block)), where);
  }
}
