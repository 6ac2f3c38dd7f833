// SPDX-License-Identifier: Apache-2.0
// The classes of the manuals, with the channels and axes that the machine has.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { Parameter } from "../contract";
import { channelList, channelName, channels, machine } from "../state/store";
import { text } from "../text/texts";

export interface Branch {
  /** Class of the API; empty: every parameter. */
  group: string;
  /** Thousands of the numbers; null: the whole class. */
  unit: number | null;
}

interface Node extends Branch {
  title: string;
  children: Node[];
}

const channelBase = 40, axisBase = 100, compensationBase = 300;

export function ParameterTree({ chosen, choose }: { chosen: Branch; choose: (branch: Branch) => void }) {
  const axes = useSignal<{ number: number; name: string }[]>([]);
  const revision = machine.value.revisions.parameters;
  useEffect(() => {
    void get<{ parameters: Parameter[] }>("/api/parameters?class=axis&search=axis_name&limit=200").then((answer) => {
      const named = answer.body?.parameters.filter((one) => one.name === "axis_name") ?? [];
      if (answer.body) axes.value = named.map((one) => ({ number: one.number / 1000 - axisBase, name: String(one.value) }));
    });
  }, [revision]);
  const t = text.value;
  const unitsOf = (group: string, base: number) =>
    axes.value.map(({ number, name }): Node => ({ group, unit: base + number, title: t.axisUnit(number, name), children: [] }));
  const nodes: Node[] = [
    { group: "", unit: null, title: t.classAll, children: [] },
    { group: "nc", unit: null, title: t.classNc, children: [] },
    { group: "user", unit: null, title: t.classMachine, children: [] },
    {
      group: "channel", unit: null, title: t.classChannel,
      children: channelList.value.map((number) => ({ group: "channel", unit: channelBase + number, title: channelName(channels.value[String(number)]!), children: [] })),
    },
    { group: "axis", unit: null, title: t.classAxis, children: unitsOf("axis", axisBase) },
    { group: "compensation", unit: null, title: t.classCompensation, children: unitsOf("compensation", compensationBase) },
    { group: "table", unit: null, title: t.classTables, children: [] },
  ];
  const same = (node: Branch) => node.group === chosen.group && node.unit === chosen.unit;
  const row = (node: Node, level: number) => (
    <button key={`${node.group}/${node.unit}`} class={`branch level-${level}`} aria-pressed={same(node)} onClick={() => choose({ group: node.group, unit: node.unit })}>
      {node.title}
    </button>
  );
  return (
    <section class="parameter-tree" aria-label={t.parameterClass}>
      <div class="scroll" tabIndex={0} role="group" aria-label={t.parameterClass}>
        {nodes.map((node) => (
          <>
            {row(node, 1)}
            {node.group === chosen.group && node.group !== "" && node.children.map((child) => row(child, 2))}
          </>
        ))}
      </div>
    </section>
  );
}
