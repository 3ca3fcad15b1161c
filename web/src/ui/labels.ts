// SPDX-License-Identifier: GPL-3.0-or-later
// Names of nodes beside them in the picture.
import { Vector3 } from "three";
import { add, rotate, scaled, subtract } from "../data/rotation";
import type { Vec } from "../data/rotation";
import type { Run } from "../data/run";
import type { Viewport } from "../view/viewport";
import { h } from "./dom";

/** Names drawn at once; more would hide one another. */
const MOST = 400;
/** Triangles times names that are looked through in one picture. */
const MOST_TESTS = 3e6;

export class Labels {
  readonly element = h("div", { class: "labels", "aria-hidden": "true" });
  private readonly pool: HTMLElement[] = [];

  /** Puts the names of what is seen where it is drawn now; of parts at rest those behind a surface are left out. */
  follow(viewport: Viewport): void {
    let used = 0;
    if (viewport.settings.names)
      for (const { run } of viewport.views) {
        if (!run.visible) continue;
        const triangles = run.entry.kind === "part" ? trianglesOf(run) : new Float64Array();
        let tests = 0;
        for (const node of run.nodes) {
          if (used === MOST) break;
          const place = run.drawn(node.place).position, at = viewport.project(place);
          if (!at.inside) continue;
          if ((tests += triangles.length / 9) < MOST_TESTS && isHidden(place, eyeOf(viewport, place), triangles)) continue;
          const label = this.label(used++);
          if (label.textContent !== node.name) label.textContent = node.name;
          label.style.transform = `translate(${Math.round(at.x + 6)}px, ${Math.round(at.y - 8)}px)`;
          label.hidden = false;
        }
      }
    for (let i = used; i < this.pool.length; ++i) this.pool[i]!.hidden = true;
  }

  private label(index: number): HTMLElement {
    if (!this.pool[index]) this.element.append((this.pool[index] = h("span", {})));
    return this.pool[index]!;
  }
}

/** Where a place is looked at from; in parallel pictures from far away. */
function eyeOf(viewport: Viewport, place: Vec): Vec {
  const { active } = viewport.camera, p = active.position;
  if (!viewport.settings.parallel) return add([p.x, p.y, p.z], viewport.origin);
  const d = active.getWorldDirection(new Vector3()), far = 2 * Math.hypot(...subtract(add([p.x, p.y, p.z], viewport.origin), place));
  return subtract(place, scaled([d.x, d.y, d.z], far));
}

/** Corners of all triangles in the world, undeformed. */
function trianglesOf(run: Run): Float64Array {
  const corners: number[] = [];
  for (const [b, body] of run.bodies.entries()) {
    const shape = body.shape === null ? null : run.shapes[body.shape]!;
    if (!shape) continue;
    const { position, rotation } = run.drawn({ entry: { body: b }, position: null, rotation: null, body: b });
    for (let i = 0; i < shape.triangles.length; ++i) {
      const v = 3 * shape.triangles[i]!;
      corners.push(...add(position, rotate(rotation, [shape.vertices[v]!, shape.vertices[v + 1]!, shape.vertices[v + 2]!])));
    }
  }
  return Float64Array.from(corners);
}

/** Whether a triangle is between them, by the test of Moeller and Trumbore (Journal of Graphics Tools 2, 1997). */
function isHidden(place: Vec, eye: Vec, t: Float64Array): boolean {
  const [dx, dy, dz] = subtract(place, eye);
  for (let i = 0; i < t.length; i += 9) {
    const ax = t[i]!, ay = t[i + 1]!, az = t[i + 2]!;
    const ux = t[i + 3]! - ax, uy = t[i + 4]! - ay, uz = t[i + 5]! - az, vx = t[i + 6]! - ax, vy = t[i + 7]! - ay, vz = t[i + 8]! - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx, det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const sx = eye[0] - ax, sy = eye[1] - ay, sz = eye[2] - az, a = (sx * px + sy * py + sz * pz) / det;
    if (a < 0 || a > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux, b = (dx * qx + dy * qy + dz * qz) / det;
    if (b < 0 || a + b > 1) continue;
    const s = (vx * qx + vy * qy + vz * qz) / det;
    if (s > 0 && s < 0.999) return true;
  }
  return false;
}
