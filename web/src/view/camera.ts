// SPDX-License-Identifier: GPL-3.0-or-later
// The camera: it orbits a target about the vertical, in perspective or parallel; drag, wheel, fingers.
import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { length, scaled } from "../data/rotation";
import type { Vec } from "../data/rotation";

const OPENING = (28 * Math.PI) / 180;
/** Room about what is shown. */
const MARGIN = 1.2;

export type Standard = "iso" | "front" | "back" | "left" | "right" | "top" | "bottom";
const RIGHT = Math.PI / 2;
const STANDARD: Record<Standard, [number, number]> = {
  iso: [-0.9, 0.42], front: [-RIGHT, 0], back: [RIGHT, 0], left: [Math.PI, 0], right: [0, 0], top: [-RIGHT, RIGHT], bottom: [-RIGHT, -RIGHT],
};

const cross = (a: Vec, b: Vec): Vec => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: Vec): Vec => scaled(a, 1 / (length(a) || 1));

export class OrbitCamera {
  readonly perspective = new PerspectiveCamera((OPENING * 180) / Math.PI);
  readonly orthographic = new OrthographicCamera();
  parallel = false;
  /** What the camera looks at, relative to what carries it. */
  target: Vec = [0, 0, 0];
  /** Place of the body that it follows; the origin where it stands. */
  carrier: Vec = [0, 0, 0];
  distance = 1;
  azimuth = STANDARD.iso[0];
  elevation = STANDARD.iso[1];
  private readonly axes: [Vec, Vec, Vec];
  private aspect = 0;

  private readonly size: number;

  /** `half`: half the sides of the box of everything, about the origin of the picture; `shown`: what fits, relative to the carrier. */
  constructor(up: Vec, half: Vec, private readonly shown: () => { centre: Vec; half: Vec }) {
    this.size = 2 * length(half) || 1;
    const z = unit(up);
    // x of the world stays x of the picture where it can: front is seen along +y.
    const x = unit(Math.abs(z[0]) < 0.9 ? cross(cross(z, [1, 0, 0]), z) : cross(cross(z, [0, 1, 0]), z));
    this.axes = [x, cross(z, x), z];
  }

  get active(): PerspectiveCamera | OrthographicCamera {
    return this.parallel ? this.orthographic : this.perspective;
  }

  /** Shows a box about a centre, seen from the present direction. */
  fit({ centre, half } = this.shown()): void {
    const { right, above, back } = this.directions(), tangent = Math.tan(OPENING / 2);
    const along = (p: Vec, axis: Vec): number => p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2];
    this.target = centre;
    this.distance = Math.max(0.1 * length(half), 1e-3 * this.size);
    for (let i = 0; i < 8; ++i) {
      const corner = half.map((x, c) => (i & (1 << c) ? x : -x)) as Vec, toward = this.parallel ? 0 : along(corner, back);
      const reach = Math.max(Math.abs(along(corner, right)) / this.aspect, Math.abs(along(corner, above)));
      this.distance = Math.max(this.distance, toward + (MARGIN * reach) / tangent);
    }
  }
  /** A standard view, or azimuth and elevation [rad] of where the camera stands. */
  standard(view: Standard | [number, number]): void {
    [this.azimuth, this.elevation] = typeof view === "string" ? STANDARD[view] : view;
    this.fit();
  }
  orbit(azimuth: number, elevation: number): void {
    this.azimuth += azimuth;
    this.elevation = Math.max(-RIGHT, Math.min(RIGHT, this.elevation + elevation));
  }
  zoom(factor: number): void {
    this.distance = Math.max(1e-4 * this.size, Math.min(50 * this.size, this.distance * factor));
  }
  /** Moves the target by pixels of a picture of `height` pixels. */
  pan(dx: number, dy: number, height: number): void {
    const perPixel = (2 * this.distance * Math.tan(OPENING / 2)) / height;
    const { right, above } = this.directions();
    this.target = [0, 1, 2].map((i) => this.target[i]! - perPixel * (dx * right[i]! - dy * above[i]!)) as Vec;
  }

  /** Length in the world of one pixel at the target. */
  perPixel(height: number): number {
    return (2 * this.distance * Math.tan(OPENING / 2)) / height;
  }

  directions(): { right: Vec; above: Vec; back: Vec } {
    const [x, y, z] = this.axes;
    const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    const mix = (a: number, b: number, c: number): Vec => [0, 1, 2].map((i) => a * x[i]! + b * y[i]! + c * z[i]!) as Vec;
    const back = mix(ce * ca, ce * sa, se), right = mix(-sa, ca, 0);
    return { right, above: cross(back, right), back };
  }

  update(width: number, height: number): void {
    const isFirst = this.aspect === 0;
    this.aspect = width / Math.max(1, height);
    if (isFirst) this.fit();
    const { above, back } = this.directions(), target = [0, 1, 2].map((i) => this.target[i]! + this.carrier[i]!) as Vec;
    const half = this.distance * Math.tan(OPENING / 2);
    const near = Math.max(this.distance - 4 * this.size, this.distance / 200);
    this.perspective.aspect = this.aspect;
    this.orthographic.left = -half * this.aspect;
    this.orthographic.right = half * this.aspect;
    this.orthographic.top = half;
    this.orthographic.bottom = -half;
    for (const camera of [this.perspective, this.orthographic]) {
      camera.near = camera === this.perspective ? near : -10 * this.size;
      camera.far = this.distance + 10 * this.size;
      camera.up.set(...above);
      camera.position.set(...([0, 1, 2].map((i) => target[i]! + this.distance * back[i]!) as Vec));
      camera.lookAt(new Vector3(...target));
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
    }
  }

  /** Drag turns, with the right or middle button or Shift moves, the wheel and two fingers zoom. `changed` after each. */
  listen(canvas: HTMLElement, changed: () => void, clicked: (x: number, y: number) => void): void {
    const fingers = new Map<number, { x: number; y: number }>();
    let moved = 0;
    const span = (): number => {
      const [a, b] = [...fingers.values()];
      return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const dx = event.clientX - before.x, dy = event.clientY - before.y, width = span();
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved += Math.abs(dx) + Math.abs(dy);
      if (fingers.size === 2) {
        if (width > 0) this.zoom(width / Math.max(1, span()));
        this.pan(dx / 2, dy / 2, canvas.clientHeight);
      } else if (event.buttons & 6 || event.shiftKey) this.pan(dx, dy, canvas.clientHeight);
      else this.orbit(-0.008 * dx, 0.008 * dy);
      changed();
    });
    const leave = (event: PointerEvent): void => {
      const alone = fingers.delete(event.pointerId) && fingers.size === 0;
      if (alone && moved < 4 && event.type === "pointerup") clicked(event.offsetX, event.offsetY);
    };
    canvas.addEventListener("pointerup", leave);
    canvas.addEventListener("pointercancel", leave);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.0012 * event.deltaY * (event.deltaMode === 1 ? 30 : 1)));
      changed();
    }, { passive: false });
  }
}
