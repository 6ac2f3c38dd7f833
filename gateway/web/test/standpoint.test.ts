// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { standpointOf } from "../src/scene/standpoint";

test("a standpoint is read as it was kept, and anything else is none", () => {
  const kept = { position: [800, -1000, 750.5], target: [0, 0, -20], zoom: 1.25 };
  expect(standpointOf(JSON.stringify(kept))).toEqual(kept);
  for (const other of [null, "", "{}", "null", "[1]", JSON.stringify({ ...kept, zoom: 0 }), JSON.stringify({ ...kept, target: [1, null, 2] }), JSON.stringify({ ...kept, target: [1] })])
    expect(standpointOf(other), String(other)).toBeUndefined();
});
