// SPDX-License-Identifier: Apache-2.0
// Colours for Structured Text and instruction lists (IEC 61131-3). The compiler of the PLC decides what is right.
import { StreamLanguage, type StringStream, syntaxHighlighting } from "@codemirror/language";
import type { Extension } from "@codemirror/state";
import { tagHighlighter, tags } from "@lezer/highlight";
import { isText } from "./source";

const words = (text: string) => new Set(text.split(/\s+/));

const keywords = words(`PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK TEST END_TEST TYPE END_TYPE
  CONFIGURATION END_CONFIGURATION RESOURCE END_RESOURCE TASK WITH STRUCT END_STRUCT VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL END_VAR RETAIN CONSTANT R_EDGE F_EDGE AT
  IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT CONTINUE RETURN
  AND OR XOR NOT MOD ARRAY TRUE FALSE
  METHOD END_METHOD CLASS END_CLASS INTERFACE END_INTERFACE EXTENDS IMPLEMENTS OVERRIDE FINAL ABSTRACT PUBLIC PROTECTED PRIVATE INTERNAL
  NAMESPACE END_NAMESPACE USING
  THIS SUPER REF_TO POINTER NULL`);
/** Instructions of a list, where a line begins with one. */
const instructions = words(`LD LDN ST STN S R AND ANDN OR ORN XOR XORN NOT ADD SUB MUL DIV GT GE EQ NE LE LT TON TOF CTU CTR
  R_TRIG F_TRIG MOVE JMP JMPC JMPCN RET RETC RETCN CAL CALC CALCN`);
const types = words(`BOOL SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL BYTE WORD DWORD LWORD TIME LTIME DATE TIME_OF_DAY TOD
  DATE_AND_TIME DT STRING WSTRING`);
const blocks = words("SR RS R_TRIG F_TRIG FALLING_EDGE CTU CTD CTUD TP TON TOF RTC PID PID_CONTROL SFC_STEP");

export interface State {
  /** What ends the comments that are open, the same for all of them as comments of one kind nest; empty outside. */
  comment: string;
}

/** The kind of the next piece of a line; null for what has no colour. */
export function token(stream: Pick<StringStream, "match" | "skipToEnd" | "next" | "eatSpace" | "string" | "pos">, state: State, list: boolean): string | null {
  if (state.comment) {
    const end = state.comment.slice(0, 2);
    const mark = (end === "*)" ? /\(\*|\*\)/ : /\/\*|\*\//).exec(stream.string.slice(stream.pos));
    if (mark) {
      stream.pos += mark.index + 2;
      state.comment = mark[0] === end ? state.comment.slice(2) : state.comment + end;
    } else {
      stream.skipToEnd();
    }
    return "comment";
  }
  if (stream.eatSpace()) return null;
  const first = list && stream.string.slice(0, stream.pos).trim() === "";
  if (stream.match("//")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.match("(*") || stream.match("/*")) {
    state.comment = stream.string[stream.pos - 2] === "(" ? "*)" : "*/";
    return "comment";
  }
  if (stream.match(/^'(?:\$.|[^'])*'?/) || stream.match(/^"(?:\$.|[^"])*"?/)) return "string";
  if (stream.match(/^%[A-Za-z]+\d*(?:\.\d+)?/)) return "propertyName";
  if (stream.match(/^(?:[A-Za-z_]\w*#)?\d[\w.]*(?:[eE][-+]?\d+)?(?:#[\w.:-]+)?/) || stream.match(/^(?:LT?|T|TIME|LTIME|D|DATE|TOD|DT)#[-\w.:]+/i)) return "number";
  const word = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null;
  if (word) {
    const upper = word[0].toUpperCase();
    if (first && instructions.has(upper)) return "keyword";
    if (keywords.has(upper)) return "keyword";
    if (types.has(upper) || blocks.has(upper)) return "typeName";
    return null;
  }
  if (stream.match(/^(?::=|\?=|=>|<>|<=|>=|\*\*|[-+*/=<>&])/)) return "operator";
  stream.next();
  return null;
}

const colours = syntaxHighlighting(
  tagHighlighter([
    { tag: tags.comment, class: "nc-comment" },
    { tag: tags.string, class: "nc-label" },
    { tag: tags.number, class: "nc-axis" },
    { tag: tags.keyword, class: "nc-code" },
    { tag: tags.typeName, class: "nc-keyword" },
    { tag: tags.propertyName, class: "nc-variable" },
    { tag: tags.operator, class: "nc-operator" },
  ]),
);

/** For a file of this name; nothing for XML and YAML. */
export function languageOf(name: string): Extension {
  const list = name.endsWith(".il");
  if (!list && !isText(name)) return [];
  return [
    StreamLanguage.define<State>({
      startState: () => ({ comment: "" }),
      copyState: (state) => ({ ...state }),
      token: (stream, state) => token(stream, state, list),
    }),
    colours,
  ];
}
