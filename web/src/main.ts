// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the page: reads its data, draws, or tells in the page why it cannot.
import { App } from "./app";
import { Failure } from "./data/failure";
import { readPage } from "./data/page";
import { selfTestOf } from "./self_test";
import type { SelfTest } from "./self_test";
import { h } from "./ui/dom";

declare global {
  interface Window {
    tisserand: SelfTest;
  }
}

function tell(root: HTMLElement, error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  const remedy = error instanceof Failure ? error.remedy : "This is an error in the viewer. Please report it and attach the page.";
  root.replaceChildren(h("main", { class: "failure", role: "alert" }, h("h1", {}, "This page cannot be shown"), h("p", {}, message), h("p", {}, remedy)));
  window.tisserand = { ready: false, failure: message };
}

async function open(): Promise<void> {
  const root = document.getElementById("viewer")!;
  try {
    const app = new App(await readPage(), root);
    app.render(true);
    window.tisserand = selfTestOf(app, performance.now());
    window.addEventListener("unhandledrejection", (event) => app.tell((event.reason as Error)?.message ?? String(event.reason)));
  } catch (error) {
    tell(root, error);
  }
}

void open();
