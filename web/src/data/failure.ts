// SPDX-License-Identifier: GPL-3.0-or-later
/** A fault of the page's data or of the browser, told to the reader: what, where, and what to do. */
export class Failure extends Error {
  constructor(what: string, readonly remedy: string) {
    super(what);
    this.name = "Failure";
  }
}

export const WRITE_AGAIN = "Write the page again with `mechanism view`.";

export function require(condition: boolean, what: string): asserts condition {
  if (!condition) throw new Failure(what, WRITE_AGAIN);
}
