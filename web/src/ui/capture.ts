// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures and videos of the canvas, with title, time and the scale of colours written on them.
import { download, fileName, styled } from "./dom";
import { number } from "./numbers";
import { mapBytes } from "../view/colours";
import type { MapName } from "../view/colours";

export interface Caption {
  title: string;
  time: string;
  legend: { title: string; range: [number, number]; map: MapName; notes: string[] } | null;
}

/** Draws picture and caption into `context`, in `width` pixels from `left`. */
export function compose(context: CanvasRenderingContext2D, picture: HTMLCanvasElement, caption: Caption, left = 0, width = context.canvas.width): void {
  const { height } = context.canvas, unit = Math.max(1, height / 700), x = left + 16 * unit;
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, left, 0, width, height);
  context.fillStyle = styled("--ink");
  context.textBaseline = "top";
  context.font = `600 ${15 * unit}px system-ui, sans-serif`;
  context.fillText(caption.title, x, 14 * unit, context.canvas.width - 32 * unit);
  context.font = `${14 * unit}px system-ui, sans-serif`;
  context.fillText(caption.time, x, (caption.title ? 36 : 14) * unit, width - 32 * unit);
  if (!caption.legend) return;
  writeLegend(context, caption.legend, x, width - 32 * unit, unit);
}

/** The scale of colours in the lower left corner, with what it tells, on a ground of its own. */
function writeLegend(context: CanvasRenderingContext2D, legend: NonNullable<Caption["legend"]>, x: number, most: number, unit: number): void {
  const { height } = context.canvas, { title, range, map } = legend, bytes = mapBytes(map), line = 16 * unit;
  context.font = `${12 * unit}px system-ui, sans-serif`;
  const notes = wrapped(context, legend.notes, Math.min(most, 300 * unit));
  const low = height - 24 * unit - notes.length * line, tall = Math.min(160 * unit, 0.45 * height);
  const wide = Math.max(70 * unit, ...[title, ...notes].map((text) => context.measureText(text).width)) + 16 * unit;
  context.globalAlpha = 0.86;
  context.fillStyle = styled("--paper");
  context.fillRect(x - 8 * unit, low - tall - 28 * unit, wide, tall + 36 * unit + notes.length * line);
  context.globalAlpha = 1;
  for (let i = 0; i < 256; ++i) {
    context.fillStyle = `rgb(${bytes[4 * i]}, ${bytes[4 * i + 1]}, ${bytes[4 * i + 2]})`;
    context.fillRect(x, low - (tall * (i + 1)) / 256, 12 * unit, tall / 256 + 1);
  }
  context.fillStyle = styled("--ink");
  context.font = `${12 * unit}px system-ui, sans-serif`;
  context.fillText(title, x, low - tall - 20 * unit);
  for (const s of [0, 0.25, 0.5, 0.75, 1]) context.fillText(number(range[0] + s * (range[1] - range[0]), 3), x + 18 * unit, low - s * tall - 6 * unit);
  context.fillStyle = styled("--ink-2");
  for (const [i, note] of notes.entries()) context.fillText(note, x, low + 10 * unit + i * line);
}

/** Texts in lines of at most `most` pixels. */
function wrapped(context: CanvasRenderingContext2D, texts: string[], most: number): string[] {
  return texts.flatMap((text) => text.split(" ").reduce<string[]>((lines, word) => {
    const longer = lines.length > 0 ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines.length > 0 && context.measureText(longer).width <= most) lines[lines.length - 1] = longer;
    else lines.push(word);
    return lines;
  }, []));
}

/** A PNG of what is drawn; `draw` draws it anew just before. */
export function savePicture(picture: HTMLCanvasElement, draw: () => void, caption: Caption): Promise<Blob | null> {
  draw();
  const canvas = document.createElement("canvas");
  canvas.width = picture.width;
  canvas.height = picture.height;
  compose(canvas.getContext("2d")!, picture, caption);
  return new Promise((resolve) => canvas.toBlob((blob) => {
    if (blob) download(fileName(caption.title, "png"), blob);
    resolve(blob);
  }, "image/png"));
}

export class Recorder {
  private recorder: MediaRecorder | null = null;
  private readonly canvas = document.createElement("canvas");
  private context: CanvasRenderingContext2D | null = null;

  get recording(): boolean {
    return this.recorder !== null;
  }
  static get possible(): boolean {
    return typeof MediaRecorder !== "undefined" && "captureStream" in HTMLCanvasElement.prototype;
  }

  start(picture: HTMLCanvasElement, title: string): void {
    this.canvas.width = picture.width;
    this.canvas.height = picture.height;
    this.context = this.canvas.getContext("2d");
    const type = ["video/mp4;codecs=avc1", "video/webm;codecs=vp9", "video/webm"].find((t) => MediaRecorder.isTypeSupported(t)) ?? "";
    const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 8e6 });
    const parts: Blob[] = [];
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () => download(fileName(title, type.includes("mp4") ? "mp4" : "webm"), new Blob(parts, { type }));
    recorder.start();
    this.recorder = recorder;
  }
  stop(): void {
    this.recorder?.stop();
    this.recorder = null;
  }
  /** After each picture. */
  picture(source: HTMLCanvasElement, caption: Caption): void {
    if (this.recorder && this.context) compose(this.context, source, caption);
  }
}
