// SPDX-License-Identifier: Apache-2.0
// One parameter: what it does, its limits, and its new value.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { type Answer, get, put, putIfSame } from "../api";
import type { Parameter } from "../contract";
import { limits, title, typedNumber, unit } from "../format";
import { sixDigits, storedValue } from "../state/parameter_file";
import { tell } from "../state/store";
import { changedSince, remember } from "../state/undo";
import { text } from "../text/texts";
import { Guard, GuardNote } from "./Guard";

const pathOf = (number: number) => `/api/parameters/${sixDigits(number)}`;
const bodyOf = (value: number | string) => (typeof value === "string" ? { text: value } : { value });

/** Sends a change of one parameter; it can be taken back. */
async function change(parameter: Parameter, body: { value: number } | { text: string } | { reset: true }): Promise<Answer> {
  const before = storedValue(parameter);
  const answer = await put(pathOf(parameter.number), body);
  if (!answer.ok) return answer;
  const read = () => get<Parameter>(pathOf(parameter.number));
  // The machine's default is known when the gateway has heard of it.
  let after = "value" in body ? body.value : "text" in body ? body.text : before;
  for (let i = 0; "reset" in body && after === before && i < 5; ++i) {
    await new Promise((resolve) => setTimeout(resolve, 100));
    after = storedValue((await read()).body ?? parameter);
  }
  if (after === before) return answer;
  remember({
    what: `${sixDigits(parameter.number)} ${before} → ${after}`,
    undo: async () => {
      const now = await read();
      if (!now.body) return now;
      return storedValue(now.body) === after ? putIfSame(pathOf(parameter.number), bodyOf(before), now.tag) : changedSince();
    },
  });
  return answer;
}

export function ParameterEditor({ parameter, done }: { parameter: Parameter; done: () => void }) {
  const entered = useSignal(String(storedValue(parameter)));
  const refused = useSignal("");
  const stored = useRef(storedValue(parameter));
  useEffect(() => {
    // Only a value that changed meanwhile replaces what is being typed.
    const now = storedValue(parameter);
    if (stored.current === now) return;
    stored.current = now;
    entered.value = String(now);
    refused.value = "";
  }, [parameter.value, parameter.pending_value]);
  const t = text.value;
  const isText = typeof parameter.value === "string";
  const needs = parameter.access === "builder" ? "builder" : "setter";
  const send = async (body: Parameters<typeof change>[1]) => {
    const answer = await change(parameter, body);
    refused.value = answer.reason;
    if (!answer.ok) return;
    tell(t.stored(`${sixDigits(parameter.number)} ${title(parameter.name)}`), false);
    done();
  };
  const save = () => {
    const number = typedNumber(entered.value);
    if (isText) void send({ text: entered.value });
    else if (number === undefined) refused.value = t.notANumber;
    else void send({ value: number });
  };
  return (
    <section class="editor" aria-label={t.parameter}>
      <h2>{sixDigits(parameter.number)}</h2>
      <h3>{title(parameter.name)}</h3>
      <p>{parameter.help}</p>
      <GuardNote needs={needs} />
      <Guard needs={needs}>
        <form
          onSubmit={(event) => {
            event.preventDefault();
            save();
          }}
        >
          <label for="parameter-value">{t.value} {parameter.unit && <span class="dim">{t.valueIn(unit(parameter.unit, t.or))}</span>}</label>
          <input
            id="parameter-value"
            data-test="parameter-value"
            class="digits"
            value={entered.value}
            autocomplete="off"
            inputMode={isText ? "text" : "decimal"}
            aria-invalid={refused.value !== ""}
            onInput={(event) => (entered.value = event.currentTarget.value)}
          />
          <button type="submit" class="primary" data-test="parameter-save">{t.store}</button>
        </form>
      </Guard>
      {refused.value && <p class="refusal" role="alert" data-test="parameter-refusal">{refused.value}</p>}
      <dl>
        <dt>{t.activeValue}</dt>
        <dd class="digits">{String(parameter.value) || "–"}</dd>
        <dt>{t.limits}</dt>
        <dd class="digits">{limits(parameter.minimum, parameter.maximum) || "–"}</dd>
        <dt>{t.defaultValue}</dt>
        <dd class="digits">{parameter.default ?? "–"}</dd>
        <dt>{t.takesEffect}</dt>
        <dd>{parameter.activation}</dd>
        <dt>{t.access}</dt>
        <dd>{parameter.access}</dd>
      </dl>
      {parameter.pending && <p class="tag warn">{t.waitsFor(String(parameter.pending_value), parameter.activation.toLowerCase())}</p>}
      <Guard needs={needs}>
        <button title={t.machineDefaultAbout} onClick={() => void send({ reset: true })}>{t.machineDefault}</button>
      </Guard>
    </section>
  );
}
