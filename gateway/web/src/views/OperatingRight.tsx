// SPDX-License-Identifier: Apache-2.0
// Who operates: in the state bar, the keys that take, give and hand over, and the question of another station.
import { changeOperating, type Action, operating } from "../state/operating";
import { tell } from "../state/store";
import { text } from "../text/texts";

function change(action: Action, done: string): void {
  void changeOperating(action).then((answer) => tell(answer.ok ? done : answer.reason, !answer.ok));
}

/** In the state bar. */
export function Operator() {
  const { one, mine, holder } = operating.value;
  if (!one) return null;
  const t = text.value;
  return (
    <span class={`tag operator ${mine ? "good" : holder ? "warn" : ""}`} data-test="operator">
      {mine ? t.youOperate : holder ? t.otherOperates(holder.name) : t.nobodyOperates}
    </span>
  );
}

export function OperatingKey() {
  const { one, mine, holder, mayTakeOver, asks } = operating.value;
  if (!one) return null;
  const t = text.value;
  if (mine) return <button onClick={() => change("release", t.nobodyOperates)}>{t.giveBack}</button>;
  if (!holder) return <button onClick={() => change("take", t.youOperate)}>{t.operateHere}</button>;
  if (mayTakeOver) return <button onClick={() => change("take", t.youOperate)}>{t.takeOverRight}</button>;
  return <button disabled={asks} onClick={() => change("take", t.askedFor(holder.name))}>{asks ? t.asking : t.askForRight}</button>;
}

/** Another station asks for the right of this one. */
export function OperatingQuestion() {
  const { mine, asking } = operating.value;
  if (!mine || !asking) return null;
  const t = text.value;
  const question = t.othersAsk(asking.name);
  return (
    <div class="question operating" role="alertdialog" aria-label={question}>
      <p>{question}</p>
      <button class="primary" onClick={() => change("hand_over", t.otherOperates(asking.name))}>{t.handOver}</button>
      <button onClick={() => change("refuse", t.youOperate)}>{t.keepRight}</button>
    </div>
  );
}
