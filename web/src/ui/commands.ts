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
    || (target instanceof HTMLInputElement && !["checkbox", "button"].includes(target.type));
}

export function listenToKeys(commands: Command[]): void {
  const table = new Map(commands.flatMap((command) => command.keys.map((key) => [key, command] as const)));
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (takesText(event.target) && event.key !== "Escape") return;
    const pressesControl = event.target instanceof HTMLElement && event.target.matches("button, summary, input, a, [role=tab], [role=separator]");
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
