// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { get, type Parameter, put } from "../api";
import { limits, title, unit } from "../format";
import { machine, tell } from "../state/store";
import { text, type Texts } from "../text/texts";

const classes: [string, keyof Texts & `class${string}`][] = [
  ["", "classAll"],
  ["nc", "classNc"],
  ["user", "classMachine"],
  ["channel", "classChannel"],
  ["axis", "classAxis"],
  ["compensation", "classCompensation"],
  ["table", "classTables"],
];

const sixDigits = (number: number) => String(number).padStart(6, "0");

function Editor({ parameter, done }: { parameter: Parameter; done: () => void }) {
  const entered = useSignal(String(parameter.value));
  const refused = useSignal("");
  const stored = useRef(parameter.value);
  useEffect(() => {
    // Only a value that changed meanwhile replaces what is being typed.
    if (stored.current === parameter.value) return;
    stored.current = parameter.value;
    entered.value = String(parameter.value);
    refused.value = "";
  }, [parameter.value]);
  const t = text.value;
  const isText = typeof parameter.value === "string";
  const save = async () => {
    const number = Number(entered.value.replace(",", "."));
    if (!isText && (entered.value.trim() === "" || !Number.isFinite(number))) {
      refused.value = t.notANumber;
      return;
    }
    const answer = await put(`/api/parameters/${sixDigits(parameter.number)}`, isText ? { text: entered.value } : { value: number });
    refused.value = answer.reason;
    if (!answer.ok) return;
    tell(t.stored(`${sixDigits(parameter.number)} ${title(parameter.name)}`), false);
    done();
  };
  return (
    <section class="editor" aria-label={t.parameter}>
      <h2>{sixDigits(parameter.number)}</h2>
      <h3>{title(parameter.name)}</h3>
      <p>{parameter.help}</p>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void save();
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
      {refused.value && <p class="refusal" role="alert" data-test="parameter-refusal">{refused.value}</p>}
      <dl>
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
    </section>
  );
}

export function Parameters() {
  const search = useSignal("");
  const group = useSignal("");
  const found = useSignal<Parameter[]>([]);
  const total = useSignal(0);
  const problem = useSignal("");
  const chosen = useSignal<number | null>(null);
  const { parameters: revision, pending } = machine.value.revisions;
  const load = async () => {
    const query = new URLSearchParams({ limit: "400" });
    if (group.value) query.set("class", group.value);
    if (search.value.trim()) query.set("search", search.value.trim());
    const answer = await get<{ parameters: Parameter[]; total: number }>(`/api/parameters?${query.toString()}`);
    problem.value = answer.reason;
    if (!answer.ok || !answer.body) return;
    found.value = answer.body.parameters;
    total.value = answer.body.total;
  };
  useEffect(() => {
    const timer = setTimeout(() => void load(), 120);
    return () => clearTimeout(timer);
  }, [search.value, group.value, revision, pending]);
  const t = text.value;
  const current = found.value.find((parameter) => parameter.number === chosen.value);
  return (
    <main class="parameters">
      <section class="list" aria-label={t.parameters}>
        <div class="title">
          <h2>{t.parameters}</h2>
          <input
            type="search"
            autofocus
            data-test="parameter-search"
            placeholder={t.numberOrName}
            aria-label={t.numberOrName}
            value={search.value}
            onInput={(event) => (search.value = event.currentTarget.value)}
          />
          <div class="segments" role="group" aria-label={t.parameterClass}>
            {classes.map(([value, title]) => (
              <button key={value} aria-pressed={group.value === value} onClick={() => (group.value = value)}>
                {t[title] as string}
              </button>
            ))}
          </div>
          <span class="dim end">
            {found.value.length < total.value ? t.shownOf(found.value.length, total.value) : total.value}
            {pending ? ` · ${t.pending(pending)}` : ""}
          </span>
        </div>
        <div class="scroll">
          <table>
            <thead>
              <tr><th>{t.number}</th><th>{t.name}</th><th class="right">{t.value}</th><th>{t.unit}</th><th>{t.limits}</th><th>{t.effect}</th></tr>
            </thead>
            <tbody>
              {found.value.map((parameter) => (
                <tr
                  key={parameter.number}
                  tabIndex={0}
                  aria-selected={parameter.number === chosen.value}
                  data-parameter={sixDigits(parameter.number)}
                  onClick={() => (chosen.value = parameter.number)}
                  onFocus={() => (chosen.value = parameter.number)}
                >
                  <td class="digits">{sixDigits(parameter.number)}</td>
                  <td>{title(parameter.name)}</td>
                  <td class={`right digits ${parameter.value === parameter.default ? "" : "changed"}`}>{parameter.value}</td>
                  <td class="dim">{unit(parameter.unit, t.or)}</td>
                  <td class="dim digits">{limits(parameter.minimum, parameter.maximum)}</td>
                  <td>{parameter.activation}{parameter.pending && <span class="tag warn">{t.waits(String(parameter.pending_value))}</span>}</td>
                </tr>
              ))}
            </tbody>
          </table>
          {problem.value && <p class="refusal">{problem.value}</p>}
          {!problem.value && found.value.length === 0 && <p class="dim">{t.nothingFound}</p>}
        </div>
      </section>
      {current ? (
        <Editor key={current.number} parameter={current} done={() => void load()} />
      ) : (
        <section class="editor dim">{t.chooseParameter}</section>
      )}
    </main>
  );
}
