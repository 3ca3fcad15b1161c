// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs of the side, and the bar that parts it from the picture.
import { h } from "./dom";

export interface Tab {
  key: string;
  title: string;
  content: HTMLElement;
  opened?: () => void;
}

export class Tabs {
  readonly element: HTMLElement;
  current = "";
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(private readonly tabs: Tab[]) {
    const bar = h("div", { class: "tabs", role: "tablist", "aria-label": "Curves, report and lists" });
    for (const tab of tabs) {
      const b = h("button", { type: "button", role: "tab", id: `tab-${tab.key}`, "aria-controls": `side-${tab.key}`, onclick: () => this.open(tab.key) }, tab.title);
      this.buttons.set(tab.key, b);
      bar.append(b);
    }
    bar.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      if (step === 0) return;
      const i = tabs.findIndex((tab) => tab.key === this.current), next = tabs[(i + step + tabs.length) % tabs.length]!;
      this.open(next.key);
      this.buttons.get(next.key)!.focus();
    });
    this.element = h("div", { class: "side" }, bar, ...tabs.map((tab) =>
      h("div", { class: "side-body", role: "tabpanel", id: `side-${tab.key}`, "aria-labelledby": `tab-${tab.key}`, hidden: true }, tab.content)));
  }

  open(key: string): void {
    this.current = key;
    for (const tab of this.tabs) {
      const on = tab.key === key, b = this.buttons.get(tab.key)!;
      b.setAttribute("aria-selected", String(on));
      b.tabIndex = on ? 0 : -1;
      tab.content.parentElement!.hidden = !on;
      if (on) tab.opened?.();
    }
  }
}

/** A bar to drag, or to move with the arrow keys; `set` takes the share of the width that is left of it. */
export function splitter(share: number, set: (share: number) => void): HTMLElement {
  const bar = h("div", { class: "splitter", role: "separator", tabindex: 0, "aria-orientation": "vertical", "aria-label": "Width of the picture", "aria-valuemin": 20, "aria-valuemax": 85 });
  const move = (to: number): void => {
    share = Math.max(0.2, Math.min(0.85, to));
    bar.setAttribute("aria-valuenow", String(Math.round(100 * share)));
    set(share);
  };
  bar.addEventListener("pointerdown", (event) => bar.setPointerCapture(event.pointerId));
  bar.addEventListener("pointermove", (event) => {
    if (bar.hasPointerCapture(event.pointerId)) move(event.clientX / window.innerWidth);
  });
  bar.addEventListener("keydown", (event) => {
    if (event.key === "ArrowLeft") move(share - 0.03);
    if (event.key === "ArrowRight") move(share + 0.03);
  });
  move(share);
  return bar;
}
