// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the page, once: what it does, for the keyboard and for the help.

export interface Command {
  keys: string[];
  name: string;
  group: "Time" | "View" | "Show" | "Page";
  run: () => void;
}

/** The key of an event as it is written in the table: "Shift+ArrowLeft", "a", "?". */
function keyOf(event: KeyboardEvent): string {
  const shifted = event.shiftKey && (event.key.length > 1 || /[A-Z]/.test(event.key));
  return `${shifted ? "Shift+" : ""}${event.key.length === 1 ? event.key.toLowerCase() : event.key}`;
}

function takesText(target: EventTarget | null): boolean {
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement
    || (target instanceof HTMLInputElement && !["checkbox", "button", "range"].includes(target.type));
}

/** Whether a slider that has the focus takes the key for itself. */
function movesSlider(target: EventTarget | null, key: string): boolean {
  return target instanceof HTMLInputElement && target.type === "range" && /^(Arrow|Page|Home|End)/.test(key);
}

export function listenToKeys(commands: Command[]): void {
  const table = new Map(commands.flatMap((command) => command.keys.map((key) => [key, command] as const)));
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if ((takesText(event.target) && event.key !== "Escape") || movesSlider(event.target, event.key)) return;
    const pressesControl = event.target instanceof HTMLElement && event.target.matches("button, summary, input:not([type=range]), a, [role=tab], [role=separator]");
    if (pressesControl && [" ", "Enter"].includes(event.key)) return;
    if (event.target instanceof HTMLElement && event.target.matches("[role=tab], [role=separator]") && event.key.startsWith("Arrow")) return;
    if (document.querySelector("dialog[open]")) return;
    const command = table.get(keyOf(event));
    if (!command) return;
    event.preventDefault();
    command.run();
  });
}

const WRITTEN: Record<string, string> = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };
export function written(key: string): string {
  return key.split(/(?<=Shift)\+/).map((part) => WRITTEN[part] ?? (part.length === 1 ? part.toUpperCase() : part)).join(" ");
}
