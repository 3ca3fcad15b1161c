// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page. Every text goes through textContent: names from files never become markup.

type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

/** An element; `on...` are listeners, booleans are attributes without a value. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

export function svg(tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export function button(text: string, title: string, click: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h("button", { type: "button", title, "aria-label": title, onclick: click, ...attributes }, text);
}

export function select(label: string, options: [string, string][], value: string, change: (value: string) => void): HTMLSelectElement {
  const element = h("select", { "aria-label": label, title: label, onchange: () => change(element.value) },
    ...options.map(([key, text]) => h("option", { value: key }, text)));
  element.value = value;
  return element;
}

export function checkbox(text: string, checked: boolean, change: (checked: boolean) => void, hint = ""): HTMLLabelElement {
  const box = h("input", { type: "checkbox", onchange: () => change(box.checked) });
  box.checked = checked;
  return h("label", { class: "check", title: hint || text }, box, h("span", {}, text));
}

export function clear(element: Element): void {
  element.replaceChildren();
}

/** Offers bytes or text as a file. */
export function download(name: string, content: Blob): void {
  const url = URL.createObjectURL(content), link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** A name for a file from a text of a stranger. */
export function fileName(text: string, ending: string): string {
  return `${text.replace(/[^A-Za-z0-9._-]+/g, "_").slice(0, 60) || "run"}.${ending}`;
}

/** Reads a colour of the style sheet. */
export function styled(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
