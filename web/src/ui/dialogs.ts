// SPDX-License-Identifier: GPL-3.0-or-later
// The help and the licences, as dialogs of the browser (they hold the focus, Escape closes them).
import { written } from "./commands";
import type { Command } from "./commands";
import { button, h } from "./dom";

function dialog(title: string, ...content: (Node | string)[]): HTMLDialogElement {
  const element: HTMLDialogElement = h("dialog", { "aria-label": title },
    h("div", { class: "dialog-head" }, h("h2", {}, title), button("Close", `Close: ${title}`, () => element.close())), ...content);
  document.body.append(element);
  return element;
}

export function helpDialog(commands: Command[], program: string): HTMLDialogElement {
  const groups = (["Time", "View", "Show", "Page"] as const).map((group) =>
    h("section", {}, h("h3", {}, group), h("dl", { class: "keys" },
      ...commands.filter((command) => command.group === group).flatMap((command) => [
        h("dt", {}, h("kbd", {}, written(command.keys[0]!))), h("dd", {}, command.name)]))));
  const licences = dialog("Licences", h("pre", { class: "licences", tabindex: 0 }, document.getElementById("tisserand-licences")?.textContent ?? ""));
  return dialog("Keys and mouse", h("div", { class: "key-groups" }, ...groups),
    h("p", {}, "Drag to rotate the picture. Drag with Shift or the right button to move it. Use the wheel or two fingers to zoom. Click a body or a node to see its name."),
    h("p", { class: "remark" }, `Written by ${program}. Between stored instants, positions and amplitudes are interpolated linearly, rotations along the great arc. `,
      button("Licences", "Licences of this page and of what it contains", () => licences.showModal())));
}
