// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { OperatingRight } from "../src/contract";
import { operatingOf } from "../src/state/operating";
import { lackingRole } from "../src/state/rights";
import { languages } from "../src/text/texts";

const here: OperatingRight = { one: true, number: 7, may_take_over: true, mine: false, holder: null, asking: null };
const ann = { number: 7, name: "ann" };
const bob = { number: 8, name: "bob" };

test("without the setting every station operates", () => {
  expect(operatingOf({}, here)).toMatchObject({ one: false, mine: false, holder: null, asks: false });
});

test("the holder of the stream is compared with the number of this station", () => {
  expect(operatingOf({ operating: {} }, here)).toMatchObject({ one: true, mine: false, holder: null });
  expect(operatingOf({ operating: { holder: ann, asking: bob } }, here)).toMatchObject({ mine: true, asks: false, asking: bob });
  expect(operatingOf({ operating: { holder: bob, asking: ann } }, here)).toMatchObject({ mine: false, asks: true });
  expect(operatingOf({ operating: { holder: bob } }, null)).toMatchObject({ mine: false, mayTakeOver: false });
});

test("a role lacks what a higher one may, and says which", () => {
  const session = { auth: true, name: "ann", role: "operator" } as const;
  expect(lackingRole(session, "operator", languages.en)).toBe("");
  expect(lackingRole(session, "setter", languages.en)).toBe("This needs the role setter; ann is operator.");
  expect(lackingRole({ ...session, role: "administrator" }, "builder", languages.en)).toBe("");
  expect(lackingRole({ auth: false, name: "", role: "" }, "builder", languages.en)).toBe("");
  expect(lackingRole(null, "builder", languages.en)).toBe("");
});
