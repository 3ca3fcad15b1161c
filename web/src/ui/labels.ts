// Names of nodes beside them in the picture.
import { h } from "./dom";
import type { Viewport } from "../view/viewport";

/** Names drawn at once; more would hide one another. */
const MOST = 400;

export class Labels {
  readonly element = h("div", { class: "labels", "aria-hidden": "true" });
  private readonly pool: HTMLElement[] = [];

  /** Puts the names of what is seen where it is drawn now. */
  follow(viewport: Viewport): void {
    let used = 0;
    if (viewport.settings.names)
      for (const view of viewport.views)
        for (const node of view.run.visible ? view.run.nodes : []) {
          if (used === MOST) break;
          const at = viewport.project(view.run.drawn(node.place).position);
          if (!at.inside) continue;
          const label = this.label(used++);
          if (label.textContent !== node.name) label.textContent = node.name;
          label.style.transform = `translate(${Math.round(at.x + 6)}px, ${Math.round(at.y - 8)}px)`;
          label.hidden = false;
        }
    for (let i = used; i < this.pool.length; ++i) this.pool[i]!.hidden = true;
  }

  private label(index: number): HTMLElement {
    if (!this.pool[index]) this.element.append((this.pool[index] = h("span", {})));
    return this.pool[index]!;
  }
}
