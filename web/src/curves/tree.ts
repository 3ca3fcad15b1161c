// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of channels: folders by the path of a channel, opened on demand; the search lists what matches every word.
import type { Run } from "../data/run";
import { h } from "../ui/dom";

export interface Leaf {
  path: string;
  unit: string;
}

const MOST_MATCHES = 200;

interface Folder {
  folders: Map<string, Folder>;
  leaves: Leaf[];
}

export class ChannelTree {
  readonly element: HTMLElement;
  readonly leaves: Leaf[];
  private readonly list = h("div", { class: "tree-list" });
  private readonly search: HTMLInputElement;
  private readonly note = h("p", { class: "remark", role: "status" });

  constructor(runs: Run[], private readonly isShown: (path: string) => boolean, private readonly toggle: (leaf: Leaf) => void) {
    const units = new Map<string, string>();
    for (const run of runs) for (const channel of run.entry.channels) if (!units.has(channel.path)) units.set(channel.path, channel.unit);
    this.leaves = [...units].map(([path, unit]) => ({ path, unit }));
    this.search = h("input", { type: "search", placeholder: `Search ${this.leaves.length} channels`, "aria-label": "Search channels", oninput: () => this.draw() });
    this.element = h("div", { class: "tree" }, this.search, this.list, this.note);
    const left = runs.map((run) => run.entry.channels_left_out).filter((out) => out && out.count > 0);
    if (left.length > 0) this.element.append(h("p", { class: "remark" }, left.map((out) => `${out!.count} channels are not in this page: ${out!.why}`).join(" ")));
    this.draw();
  }

  focus(): void {
    this.search.focus();
  }

  /** Shows the marks anew. */
  refresh(): void {
    for (const box of this.list.querySelectorAll("input")) box.checked = this.isShown(box.dataset["path"] ?? "");
  }

  private leaf(leaf: Leaf, text: string): HTMLElement {
    const box = h("input", { type: "checkbox", onchange: () => this.toggle(leaf) });
    box.checked = this.isShown(leaf.path);
    box.dataset["path"] = leaf.path;
    return h("label", { class: "leaf", title: leaf.path }, box, h("span", { class: "name" }, text), h("span", { class: "unit" }, leaf.unit));
  }

  private draw(): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) {
      this.list.replaceChildren(...this.contents(folderOf(this.leaves), 0));
      this.note.textContent = "";
      return;
    }
    const found = this.leaves.filter((leaf) => words.every((word) => leaf.path.toLowerCase().includes(word)));
    this.list.replaceChildren(...found.slice(0, MOST_MATCHES).map((leaf) => this.leaf(leaf, leaf.path)));
    this.note.textContent = found.length > MOST_MATCHES ? `${found.length} matches; the first ${MOST_MATCHES} are listed` : `${found.length} ${found.length === 1 ? "match" : "matches"}`;
  }

  private contents(folder: Folder, depth: number): HTMLElement[] {
    const folders = [...folder.folders].map(([name, inner]) => {
      const body = h("div", { class: "branch" });
      let filled = false;
      const fill = (): void => {
        if (!filled) body.append(...this.contents(inner, depth + 1));
        filled = true;
      };
      const details = h("details", { ontoggle: () => details.open && fill() }, h("summary", {}, name), body);
      return details;
    });
    return [...folders, ...folder.leaves.map((leaf) => this.leaf(leaf, leaf.path.split("/").slice(depth).join("/") || leaf.path))];
  }
}

function folderOf(leaves: Leaf[]): Folder {
  const root: Folder = { folders: new Map(), leaves: [] };
  for (const leaf of leaves) {
    let folder = root;
    for (const name of leaf.path.split("/").slice(0, -1)) {
      let inner = folder.folders.get(name);
      if (!inner) folder.folders.set(name, (inner = { folders: new Map(), leaves: [] }));
      folder = inner;
    }
    folder.leaves.push(leaf);
  }
  return root;
}
