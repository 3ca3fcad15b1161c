// SPDX-License-Identifier: GPL-3.0-or-later
// The picture: renderer, camera, the views of all runs; drawn when something changed, never in vain.
import { Color, Scene, Vector2, Vector3, Vector4, WebGLRenderer, WebGLRenderTarget } from "three";
import type { Vec } from "../data/rotation";
import { subtract } from "../data/rotation";
import type { Run } from "../data/run";
import { OrbitCamera } from "./camera";
import { rgb } from "./colours";
import { drawGrid, drawWorldAxes } from "./grid";
import { materialsOf, setMap, sharedUniforms } from "./materials";
import type { Uniforms } from "./materials";
import { RunView } from "./run_view";
import { Segments } from "./segments";
import { COLOURINGS } from "./settings";
import type { Settings } from "./settings";

const PICK_DISTANCE = 10;
/** Pixels drawn that are nothing to see. */
const SPECK = 25;

export interface Picked {
  run: Run;
  body: number;
  node: number | null;
}

export class Viewport {
  readonly camera: OrbitCamera;
  readonly views: RunView[];
  readonly origin: Vec;
  gridStep = 0;
  pictures = 0;
  contextLost = false;
  /** First fault of the shaders or the driver, for the reader. */
  fault = "";
  readonly software: boolean;
  /** Size of the picture in pixels of the screen, where it is not that of its element. */
  fixed: { width: number; height: number } | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly shared: Uniforms = sharedUniforms();
  private readonly ground: Segments;
  /** Of what moves, over all instants. */
  private readonly box: [Vec, Vec];
  private dirty = true;
  private touched = 0;
  private ratio = 1;

  constructor(readonly canvas: HTMLCanvasElement, readonly runs: Run[], readonly settings: Settings) {
    this.box = unionOf(runs, (run) => run.box);
    this.origin = [0, 1, 2].map((i) => (this.box[0][i]! + this.box[1][i]!) / 2) as Vec;
    const all = unionOf(runs, (run) => run.entry.box);
    this.software = isSoftware();
    // Opaque, so that the browser need not blend the picture with the page.
    const context = canvas.getContext("webgl2", { alpha: false, antialias: !this.software, powerPreference: "high-performance" });
    if (!context) throw new Error("the browser provides no context");
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.debug.onShaderError = (gl, program, vertex, fragment) => {
      this.fault = [gl.getProgramInfoLog(program), gl.getShaderInfoLog(vertex), gl.getShaderInfoLog(fragment)].filter(Boolean).join(" ");
    };
    const reach = [0, 1, 2].map((i) => Math.max(all[1][i]! - this.origin[i]!, this.origin[i]! - all[0][i]!)) as Vec;
    this.camera = new OrbitCamera(runs[0]!.entry.up, reach, () => this.shown());
    this.views = runs.map((run) => new RunView(run, this.origin, this.shared));
    const ground = materialsOf(this.shared, false).segment;
    ground.transparent = true;
    ground.depthWrite = false;
    ground.uniforms["width"]!.value = 1.2;
    this.ground = new Segments(ground, 512);
    this.ground.mesh.renderOrder = -1;
    this.scene.add(this.ground.mesh);
    for (const view of this.views) this.scene.add(view.group);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.contextLost = true;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.contextLost = false;
      this.touch();
    });
    this.rank();
  }

  touch(): void {
    this.dirty = true;
    this.touched = performance.now();
  }
  /** Milliseconds since something changed. */
  get still(): number {
    return performance.now() - this.touched;
  }
  get error(): number {
    return this.renderer.getContext().getError();
  }
  get vertices(): number {
    return this.views.reduce((sum, view) => sum + view.vertices, 0);
  }
  get pixel(): number {
    return this.camera.perPixel(Math.max(1, this.extent.height));
  }
  get extent(): { width: number; height: number } {
    return this.fixed ?? { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }
  /** Widens a box by all that is drawn of bodies now, relative to what carries the camera. */
  extend(low: Vec, high: Vec): void {
    const at = this.carried(), from: Vec = [Infinity, Infinity, Infinity], to: Vec = [-Infinity, -Infinity, -Infinity];
    for (const view of this.views) if (view.run.visible) view.extend(from, to, this.settings.follow === "");
    for (let i = 0; i < 3; ++i) {
      low[i] = Math.min(low[i]!, from[i]! - at[i]!);
      high[i] = Math.max(high[i]!, to[i]! - at[i]!);
    }
  }

  /** What a fit shows: all of the motion, or the bodies about the one that the camera follows. */
  private shown(): { centre: Vec; half: Vec } {
    const low: Vec = [Infinity, Infinity, Infinity], high: Vec = [-Infinity, -Infinity, -Infinity];
    if (this.settings.follow !== "") {
      for (const view of this.views) view.update(this.settings, this.pixel);
      this.extend(low, high);
    }
    if (low.every(Number.isFinite)) return halves(low, high);
    return halves(subtract(this.box[0], this.origin), subtract(this.box[1], this.origin));
  }

  /** Place of the body that is followed, relative to the origin of the picture. */
  private carried(): Vec {
    const run = this.runs.find((r) => r.visible && r.bodies.some((body) => body.name === this.settings.follow));
    if (!run || this.settings.follow === "") return [0, 0, 0];
    return subtract(run.pose(run.bodies.findIndex((body) => body.name === this.settings.follow)).position, this.origin);
  }

  /** Follows a body from now on, or stands ("": where it is). */
  follow(name: string): void {
    const { camera } = this, seen = [0, 1, 2].map((i) => camera.target[i]! + camera.carrier[i]!) as Vec;
    this.settings.follow = name;
    camera.carrier = this.carried();
    camera.target = subtract(seen, camera.carrier);
    this.touch();
  }

  /** Whether bodies, joints, springs or arrows are seen in what was drawn last: more pixels than a speck differ from the ground. */
  get isEmpty(): boolean {
    const ground = this.ground.mesh.visible, { width, height } = this.canvas, copy = document.createElement("canvas");
    this.ground.mesh.visible = false;
    this.renderer.render(this.scene, this.camera.active);
    copy.width = width;
    copy.height = height;
    const context = copy.getContext("2d")!;
    context.drawImage(this.canvas, 0, 0);
    this.ground.mesh.visible = ground;
    this.renderer.render(this.scene, this.camera.active);
    const { data } = context.getImageData(0, 0, width, height);
    let drawn = 0;
    for (let i = 4; i < data.length; i += 4)
      if (Math.abs(data[i]! - data[0]!) + Math.abs(data[i + 1]! - data[1]!) + Math.abs(data[i + 2]! - data[2]!) > 12) ++drawn;
    // The first pixel may be of a body that fills the picture: then nothing differs, but it is not the ground.
    const clear = this.renderer.getClearColor(new Color()).getHex(), first = (data[0]! << 16) | (data[1]! << 8) | data[2]!;
    const away = [16, 8, 0].some((shift) => Math.abs(((clear >> shift) & 255) - ((first >> shift) & 255)) > 4);
    return drawn < SPECK && !away;
  }

  /** The first run shown is solid, the others are ghosts. */
  rank(): void {
    let rank = 0;
    for (const view of this.views) if (view.run.visible) view.ghost(rank++);
    this.touch();
  }

  theme(ground: string, ink: string): void {
    this.renderer.setClearColor(new Color(ground));
    (this.shared["ink"]!.value as Vector4).set(0.05, 0.06, 0.08, 0.62);
    this.ink = rgb(ink);
    this.regrid();
  }
  private ink: readonly number[] = [0, 0, 0];

  regrid(): void {
    this.ground.clear();
    if (this.settings.grid) this.gridStep = drawGrid(this.ground, this.box, this.origin, this.runs[0]!.entry.up, this.ink, Math.max(...this.runs.map((run) => run.size)));
    if (this.settings.worldAxes) drawWorldAxes(this.ground, this.origin, 0.2 * this.runs[0]!.size);
    this.ground.flush();
    this.touch();
  }

  colour(range: [number, number]): void {
    this.shared["colouring"]!.value = COLOURINGS.indexOf(this.settings.colouring);
    (this.shared["range"]!.value as Vector2).set(...range);
    setMap(this.shared, this.settings.map);
    this.touch();
  }

  /** Pixels drawn for each pixel of the screen, along each side: fewer while a slow machine plays, more in a still. */
  set quality(ratio: number) {
    if (ratio !== this.ratio) this.ratio = ratio, (this.dirty = true);
  }
  get quality(): number {
    return this.ratio;
  }

  /** Draws if something changed, or in any case. */
  draw(always = false): boolean {
    const { width, height } = this.extent;
    const size = this.renderer.getSize(new Vector2()), ratio = Math.min(window.devicePixelRatio || 1, 2) * this.ratio;
    const resized = size.x !== width || size.y !== height || this.renderer.getPixelRatio() !== ratio;
    if (width === 0 || height === 0 || this.contextLost || !(this.dirty || always || resized)) return false;
    if (resized) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
    }
    this.dirty = false;
    this.camera.parallel = this.settings.parallel;
    this.camera.carrier = this.carried();
    this.camera.update(width, height);
    this.shared["parallel"]!.value = this.settings.parallel;
    (this.shared["viewport"]!.value as Vector2).set(width, height);
    this.shared["pointSize"]!.value = 6 * ratio;
    for (const view of this.views) view.update(this.settings, this.pixel);
    this.renderer.render(this.scene, this.camera.active);
    ++this.pictures;
    return true;
  }

  /** Pixel of the canvas where a point of the world is drawn, and whether it is in the picture. */
  project(point: Vec): { x: number; y: number; inside: boolean } {
    const p = new Vector3(...subtract(point, this.origin)).project(this.camera.active);
    const { width, height } = this.extent;
    return { x: ((p.x + 1) / 2) * width, y: ((1 - p.y) / 2) * height, inside: Math.abs(p.x) <= 1 && Math.abs(p.y) <= 1 && Math.abs(p.z) <= 1 };
  }

  /** The node drawn within ten pixels of (x, y) that is nearest, else the body there. */
  pick(x: number, y: number): Picked | null {
    const body = this.pickBody(x, y);
    let best: Picked | null = null, nearest = PICK_DISTANCE;
    for (const view of this.views)
      if (view.run.visible)
        for (const [n, node] of view.run.nodes.entries()) {
          if (body && (body.run !== view.run || body.body !== node.body)) continue;
          const p = this.project(view.run.drawn(node.place).position), d = Math.hypot(p.x - x, p.y - y);
          if (p.inside && d < nearest) nearest = d, best = { run: view.run, body: node.body, node: n };
        }
    return best ?? body;
  }

  private pickBody(x: number, y: number): Picked | null {
    const camera = this.camera.active, { clientWidth: width, clientHeight: height } = this.canvas;
    const target = new WebGLRenderTarget(1, 1), pixel = new Uint8Array(4), clear = this.renderer.getClearColor(new Color());
    let first = 1;
    const firsts = this.views.map((view) => {
      const own = first;
      view.picking(own);
      first += view.run.bodies.length;
      return own;
    });
    const ground = this.ground.mesh.visible;
    this.ground.mesh.visible = false;
    camera.setViewOffset(width, height, x, y, 1, 1);
    this.renderer.setClearColor(0, 0);
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene, camera);
    this.renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(clear, 1);
    camera.clearViewOffset();
    for (const view of this.views) view.picked();
    this.ground.mesh.visible = ground;
    target.dispose();
    const id = pixel[0]! + 256 * pixel[1]! + 65536 * pixel[2]!;
    if (id === 0) return null;
    const index = firsts.findLastIndex((own) => own <= id), run = this.runs[index];
    return run && id - firsts[index]! < run.bodies.length ? { run, body: id - firsts[index]!, node: null } : null;
  }
}

/** Whether the browser draws without a graphics card: smoothing then costs more than it is worth in motion. */
function isSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2"), info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

function halves(low: Vec, high: Vec): { centre: Vec; half: Vec } {
  return { centre: low.map((x, i) => (x + high[i]!) / 2) as Vec, half: low.map((x, i) => (high[i]! - x) / 2) as Vec };
}

function unionOf(runs: Run[], boxOf: (run: Run) => readonly [readonly number[], readonly number[]]): [Vec, Vec] {
  const low: Vec = [Infinity, Infinity, Infinity], high: Vec = [-Infinity, -Infinity, -Infinity];
  for (const run of runs)
    for (let i = 0; i < 3; ++i) {
      low[i] = Math.min(low[i]!, boxOf(run)[0][i]!);
      high[i] = Math.max(high[i]!, boxOf(run)[1][i]!);
    }
  return [low, high];
}
