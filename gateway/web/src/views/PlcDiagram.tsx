// SPDX-License-Identifier: Apache-2.0
// A ladder, function block diagram or chart with live values: power flow, values at the pins of blocks, active steps.
import { useSignal } from "@preact/signals";
import { Fragment } from "preact";
import { useEffect, useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { type Diagram, type Element, type ElementKind, inputAt, outputAt, units } from "../plc/diagram";
import { type Power, PowerFlow } from "../plc/power";
import type { Paths } from "../plc/source";
import type { Live } from "../plc/watch";
import { type Texts, text } from "../text/texts";

const isPath = /^(%[A-Za-z]+\d+(\.\d+)?|[A-Za-z_]\w*(\[[\w, ]+\])?(\.\w+(\[[\w, ]+\])?)*)$/;
const kindKey = (kind: ElementKind) => `plcKind${kind[0]!.toUpperCase()}${kind.slice(1)}` as `plcKind${Capitalize<ElementKind>}` & keyof Texts;
const flowText = (t: Texts, power: Power) => (power === true ? t.plcPowerOn : power === false ? t.plcPowerOff : t.plcPowerUnknown);
const flow = (power: Power) => (power === true ? "on" : power === false ? "off" : "unknown");

/** The expressions of an element whose values are shown. */
const shownOf = (one: Element): string[] =>
  one.kind === "block" ? (one.instance ? [...one.inputs, ...one.outputs].map(({ name }) => `${one.instance}.${name}`) : [])
  : one.kind === "step" ? [`${one.text}.X`, `${one.text}.T`]
  : one.kind === "macro" ? one.steps.map((step) => `${step}.X`)
  : isPath.test(one.text) ? [one.text]
  : [];

interface Drawn {
  find: (expression: string) => string | undefined;
  live: ReadonlyMap<string, Live>;
  power: PowerFlow;
}

function Symbol({ one, drawn, language }: { one: Element; drawn: Drawn; language: Diagram["language"] }) {
  const t = text.value;
  const value = (expression: string) => drawn.live.get(drawn.find(expression) ?? "");
  const own = value(one.kind === "step" ? `${one.text}.X` : one.text);
  const forced = shownOf(one).some((expression) => value(expression)?.forced);
  const power = one.kind === "contact" ? drawn.power.output(one.id) : one.kind === "step" ? drawn.power.truth(`${one.text}.X`) : one.kind === "macro" ? drawn.power.active(one) : drawn.power.input(one.inputs[0]);
  const wire = one.y + 26, middle = one.x + one.width / 2;
  const is = one.kind === "contact" || one.kind === "coil" || one.kind === "step" || one.kind === "macro" ? flow(power) : "plain";
  const detail = one.kind === "block" ? `${one.text} ${one.instance}`.trim() : one.kind === "actions" ? one.lines.join(", ") : one.text;
  const label = [
    t[kindKey(one.kind)], (one.negated ? `${t.plcNegated} ` : "") + detail,
    own ? `= ${own.value}` : one.kind === "macro" && power !== undefined ? (power ? "= TRUE" : "= FALSE") : "",
    is === "plain" || one.kind === "step" || one.kind === "macro" ? "" : flowText(t, power), forced ? t.plcForced : "",
  ].filter((part) => part !== "").join(" ");
  const name = (x: number, y: number, content: string, anchor = "middle") => <text x={x} y={y} text-anchor={anchor}>{content}</text>;
  const body = () => {
    switch (one.kind) {
      case "rail":
        return <line class="rail" x1={one.x + 3} x2={one.x + 3} y1={one.y} y2={one.y + one.height} />;
      case "contact":
        return (
          <>
            <line class="wire" x1={one.x} x2={middle - 8} y1={wire} y2={wire} />
            <line class={`wire ${is}`} x1={middle + 8} x2={one.x + one.width} y1={wire} y2={wire} />
            <path d={`M${middle - 8} ${wire - 11}v22M${middle + 8} ${wire - 11}v22${one.negated ? `M${middle - 7} ${wire + 10}l14 -20` : ""}`} />
            {one.edge && name(middle, wire + 4, one.edge === "rising" ? "P" : "N")}
            {name(middle, one.y + 10, one.text)}
          </>
        );
      case "coil":
        return (
          <>
            <line class={`wire ${is}`} x1={one.x} x2={middle - 11} y1={wire} y2={wire} />
            <path d={`M${middle - 7} ${wire - 11}q-8 11 0 22M${middle + 7} ${wire - 11}q8 11 0 22`} />
            {name(middle, wire + 4, one.storage === "set" ? "S" : one.storage === "reset" ? "R" : one.negated ? "/" : one.edge ? (one.edge === "rising" ? "P" : "N") : "")}
            {name(middle, one.y + 10, one.text)}
          </>
        );
      case "block":
        return (
          <>
            <rect x={one.x} y={one.y + 14} width={one.width} height={one.height - 14} rx="3" />
            {name(middle, one.y + 10, one.instance)}
            {name(middle, one.y + 30, one.text)}
            {one.inputs.map((pin, i) => (
              <text key={`i${pin.name}`} x={one.x + 5} y={inputAt(one, i, language).y + 4}>
                {pin.negated ? "○" : ""}{pin.name} <tspan class="value">{one.instance ? value(`${one.instance}.${pin.name}`)?.value : ""}</tspan>
              </text>
            ))}
            {one.outputs.map((pin, i) => (
              <text key={`o${pin.name}`} x={one.x + one.width - 5} y={inputAt(one, i, language).y + 4} text-anchor="end">
                <tspan class="value">{one.instance ? value(`${one.instance}.${pin.name}`)?.value : ""}</tspan> {pin.name}{pin.negated ? "○" : ""}
              </text>
            ))}
          </>
        );
      case "step":
        return (
          <>
            <rect x={one.x} y={one.y} width={one.width} height={one.height} />
            {one.initial && <rect x={one.x + 4} y={one.y + 4} width={one.width - 8} height={one.height - 8} />}
            {name(middle, one.y + 18, one.text)}
            <text class="value" x={middle} y={one.y + 36} text-anchor="middle">{value(`${one.text}.T`)?.value}</text>
          </>
        );
      case "macro":
        return (
          <>
            <rect x={one.x} y={one.y} width={one.width} height={one.height} />
            <path d={`M${one.x} ${one.y + 7}h${one.width}M${one.x} ${one.y + one.height - 7}h${one.width}`} />
            {name(middle, one.y + 26, one.text)}
          </>
        );
      case "transition":
        return (
          <>
            <line class="bar" x1={middle - 14} x2={middle + 14} y1={one.y + 22} y2={one.y + 22} />
            <line class="wire" x1={middle} x2={middle} y1={one.y} y2={one.y + one.height} />
            {name(middle + 20, one.y + 26, one.text, "start")}
          </>
        );
      case "divergence":
        return <line class="wire" x1={one.x} x2={one.x + one.width} y1={one.y + 4} y2={one.y + 4} />;
      case "simultaneous":
        return <path d={`M${one.x} ${one.y + 1}h${one.width}M${one.x} ${one.y + 7}h${one.width}`} />;
      case "actions":
        return (
          <>
            <rect x={one.x} y={one.y} width={one.width} height={one.height} />
            {one.lines.map((line, i) => <text key={i} x={one.x + 6} y={one.y + 20 + i * 20}>{line}</text>)}
          </>
        );
      case "variable":
        return (
          <>
            {name(middle, one.y + 30, one.text)}
            <text class="value" x={middle} y={one.y + 43} text-anchor="middle">{own?.value}</text>
          </>
        );
      default:
        return name(middle, one.y + 30, one.kind === "jump" ? `→ ${one.text}` : one.kind === "label" ? `${one.text}:` : one.kind === "return" ? "→ RETURN" : `>${one.text}>`);
    }
  };
  return (
    <g class={`element ${one.kind} ${is} ${forced ? "forced" : ""}`} role="img" aria-label={label} data-flow={is} tabindex={one.kind === "rail" ? -1 : 0}>
      <title>{label}</title>
      {forced && <rect class="mark" x={one.x - 3} y={one.y - 3} width={one.width + 6} height={one.height + 6} rx="4" />}
      {body()}
    </g>
  );
}

function Wires({ diagram, drawn }: { diagram: Diagram; drawn: Drawn }) {
  const byId = new Map(diagram.elements.map((one) => [one.id, one]));
  return (
    <g aria-hidden="true">
      {diagram.elements.flatMap((one) =>
        one.inputs.flatMap((pin, i) =>
          pin.from.flatMap(({ id, output }) => {
            const source = byId.get(id);
            if (!source) return [];
            const from = outputAt(source, output, diagram.language, one), to = inputAt(one, i, diagram.language);
            const straight = diagram.language === "SFC" && one.kind !== "actions";
            const meets = one.kind === "divergence" || one.kind === "simultaneous" ? { x: from.x, y: to.y } : to;
            // What leads back goes around at the left edge.
            const bend = straight && meets.y <= from.y ? `V${from.y + 6}H6V${meets.y - 6}H${meets.x}V${meets.y}`
              : straight ? `V${(from.y + meets.y) / 2}H${meets.x}V${meets.y}` : `H${to.x - 12}V${to.y}H${to.x}`;
            const is = diagram.language === "SFC" ? "plain" : flow(drawn.power.output(id, output));
            return [{ key: `${id} ${output} ${one.id} ${i}`, is, d: `M${from.x} ${from.y}${bend}` }];
          }),
        ),
      ).sort((a, b) => Number(a.is === "on") - Number(b.is === "on")).map(({ key, is, d }) => <path key={key} class={`wire ${is}`} d={d} />)}
    </g>
  );
}

export function PlcDiagram({ source, paths, live, watch }: { source: string; paths: Paths; live: ReadonlyMap<string, Live>; watch: (paths: string[]) => void }) {
  const t = text.value;
  const drawable = useMemo(() => {
    const root = new DOMParser().parseFromString(source, "application/xml").documentElement;
    return units(root).filter(({ diagrams }) => diagrams.length > 0);
  }, [source]);
  const chosen = useSignal("");
  const instance = useSignal("");
  const seen = useSignal<[number, number]>([0, 1000]);
  const region = useRef<HTMLDivElement>(null);
  const unit = drawable.find(({ name }) => name === chosen.value) ?? drawable[0];
  const prefixes = useMemo(() => (!unit ? [] : paths.prefixes(unit.kind === "program" ? unit.name : "", unit.variables)), [unit, paths]);
  const prefix = prefixes.includes(instance.value) ? instance.value : (prefixes[0] ?? "");
  const find = (expression: string) => (isPath.test(expression) ? paths.find(expression, prefix) : undefined);
  const look = () => {
    const at = region.current;
    if (at) seen.value = [at.scrollTop - 200, at.scrollTop + at.clientHeight + 200];
  };
  useLayoutEffect(look, [unit]);
  let top = 0;
  const wanted = unit?.diagrams.flatMap((diagram) => {
    const begins = top;
    top += diagram.height;
    return diagram.elements.filter(({ y, height }) => begins + y + height > seen.value[0] && begins + y < seen.value[1]).flatMap(shownOf);
  }).flatMap((expression) => find(expression) ?? []) ?? [];
  useEffect(() => watch([...new Set(wanted)]), [wanted.join(" ")]);
  const value = (expression: string) => live.get(find(expression) ?? "")?.value;
  return (
    <>
      <div class="row">
        <select aria-label={t.plcUnit} value={unit?.name ?? ""} onChange={(event) => (chosen.value = event.currentTarget.value)}>
          {drawable.map(({ name }) => <option key={name}>{name}</option>)}
        </select>
        {prefixes.length > 0 && (
          <select aria-label={t.plcInstance} value={prefix} onChange={(event) => (instance.value = event.currentTarget.value)}>
            {prefixes.map((name) => <option key={name}>{name}</option>)}
          </select>
        )}
        <span class="dim">{t.plcFlowAbout}</span>
      </div>
      <div class="plc-code" ref={region} tabIndex={0} role="region" aria-label={t.plcDrawingOf(unit?.name ?? "")} onScroll={look}>
        {drawable.length === 0 && <p class="dim">{t.plcNothingDrawn}</p>}
        {unit?.diagrams.map((diagram, index) => {
          const drawn: Drawn = { find, live, power: new PowerFlow(diagram, value) };
          return (
            <Fragment key={index}>
              {diagram.macro && <div class="title">{t.plcKindMacro} {diagram.macro}</div>}
              <svg class="plc-diagram" width={diagram.width} height={diagram.height} role="group" aria-label={`${unit.name} ${diagram.macro} ${diagram.language}`.replace("  ", " ")}>
                <Wires diagram={diagram} drawn={drawn} />
                {diagram.elements.map((one) => <Symbol key={one.id} one={one} drawn={drawn} language={diagram.language} />)}
              </svg>
            </Fragment>
          );
        })}
      </div>
    </>
  );
}
