// SPDX-License-Identifier: Apache-2.0
// Simulated devices of the machine, and inputs that are switched by hand: a forced value, so that no device changes it.
import { useEffect, useMemo } from "preact/hooks";
import { post } from "../api";
import { devices, inputBits, type Source } from "../plc/source";
import type { Live } from "../plc/watch";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { Guard, GuardNote } from "./Guard";
import { ask } from "./Question";

interface Props {
  sources: readonly Source[];
  all: readonly string[];
  live: ReadonlyMap<string, Live>;
  watch: (paths: string[]) => void;
}

export function PlcSimulator({ sources, all, live, watch }: Props) {
  const t = text.value;
  const bits = useMemo(() => inputBits(sources), [sources]);
  const known = useMemo(() => devices(all), [all]);
  const wanted = [...bits.map(({ address }) => address), ...[...known.values()].flat()];
  useEffect(() => {
    watch(wanted);
    return () => watch([]);
  }, [wanted.join(" ")]);
  const order = async (path: string, body: object) => {
    const answer = await post(path, body);
    if (!answer.ok) tell(answer.reason, true);
  };
  // On real hardware too a forced input moves the machine.
  const set = (address: string, value: string) =>
    ask(t.plcForceQuestion(address, value), t.plcForce, () => void order("/api/plc/force", { values: [{ path: address, value }] }));
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.plcSimulator}>
      <GuardNote needs="builder" />
      {bits.length + known.size === 0 && <p class="dim">{t.plcNoDevices}</p>}
      <table>
        <tbody>
          {bits.map(({ address, name }) => {
            const one = live.get(address);
            const on = one?.value === "TRUE";
            return (
              <tr key={address} class={one?.forced ? "forced" : ""}>
                <td>{name || address} {name && <span class="dim">{address}</span>}</td>
                <td>
                  <Guard needs="builder">
                    <div class="row">
                      <button role="switch" aria-checked={on} aria-label={t.plcSwitch(name || address)} onClick={() => set(address, on ? "FALSE" : "TRUE")}>{one?.value ?? "–"}</button>
                      <button aria-label={t.plcRelease(name || address)} disabled={!one?.forced} onClick={() => void order("/api/plc/release", { paths: [address] })}>✕</button>
                    </div>
                  </Guard>
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
      {[...known].map(([device, values]) => (
        <table key={device}>
          <caption>{device}</caption>
          <tbody>
            {values.map((path) => (
              <tr key={path}><td>{path.slice(`simulation.${device}`.length + 1) || device}</td><td class="right digits">{live.get(path)?.value ?? "–"}</td></tr>
            ))}
          </tbody>
        </table>
      ))}
    </div>
  );
}
