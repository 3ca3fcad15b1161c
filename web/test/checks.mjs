// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of pages ask of numbers and of every page at its end.
import assert from "node:assert/strict";

export const near = (found, expected, tolerance, what) => {
  for (const [i, value] of expected.entries()) assert.ok(Math.abs(found[i] - value) <= tolerance, `${what}: ${found} instead of ${expected} within ${tolerance}`);
};

/** Largest difference of two colours. */
export const differ = (a, b) => Math.max(...a.map((x, i) => Math.abs(x - b[i])));

/** Upper left corner of the picture in the page. */
export const corner = (page) => page.evaluate("(({left, top}) => ({left, top}))(document.querySelector('canvas.picture').getBoundingClientRect())");

/** No complaint, no request but for the page itself, a picture without faults; closes the page. */
export async function quiet(page) {
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((url) => !url.startsWith("file:") && !url.startsWith("blob:") && !url.startsWith("data:")), []);
  assert.equal(page.requests.filter((url) => url.startsWith("file:")).length, 1, "one file is read: the page");
  assert.equal(await page.evaluate("tisserand.webglErrors"), 0);
  assert.equal(await page.evaluate("tisserand.contextLost"), false);
  await page.close();
}
