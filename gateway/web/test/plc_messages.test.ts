// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { translated } from "../src/plc/messages";

const source = `# What the logic tells the operator.
12:
  text: the door is open, close it
  german: die Tür ist offen, bitte schließen
  chinese: "门已打开，请关闭"
  inhibits: [start]
13: {text: oil is low, german: 'zu wenig Öl', reaction: show}
14:
  text: no translation
`;

test("texts of messages are found in the operator's language, by their numbers", () => {
  expect([...translated(source, "chinese")]).toEqual([[12, "门已打开，请关闭"]]);
  expect(translated(source, "german").get(13)).toBe("zu wenig Öl");
  expect(translated(source, "german").has(14)).toBe(false);
});
