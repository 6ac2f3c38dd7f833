// SPDX-License-Identifier: Apache-2.0
// The simulated devices of the machine, which a hand moves, turns and breaks, and input bits of no device. What is set
// here is forced, so that no device and no program changes it.
import { useEffect, useMemo, useRef } from "preact/hooks";
import { post } from "../api";
import { counted, simulatedDevices, type Control, type DeviceType } from "../plc/devices";
import { devices, inputBits, type Source } from "../plc/source";
import type { Live } from "../plc/watch";
import { tell } from "../state/store";
import { text, type Texts } from "../text/texts";
import { Guard, GuardNote } from "./Guard";
import { ask } from "./Question";

interface Props {
  sources: readonly Source[];
  all: readonly string[];
  live: ReadonlyMap<string, Live>;
  watch: (paths: string[]) => void;
}

interface Hand {
  live: ReadonlyMap<string, Live>;
  /** Asks before: on real hardware too a forced value moves the machine. `agreed` is called when the value is sent. */
  set: (path: string, value: string, agreed?: () => void) => void;
  release: (path: string) => void;
}

const order = async (path: string, body: object) => {
  const answer = await post(path, body);
  if (!answer.ok) tell(answer.reason, true);
};

const typeName = (t: Texts, type: DeviceType): string =>
  ({ actuator: t.plcActuator, switch: t.plcSwitchDevice, magazine: t.plcMagazine, key: t.plcKey, rotary_switch: t.plcRotarySwitch,
    handwheel: t.plcHandwheel, position_switch: t.plcPositionSwitch })[type];

/** What a key of devices.yaml means. */
const keyName = (t: Texts, key: string): string => {
  const names: Record<string, string> = {
    extend: t.plcExtend, retract: t.plcRetract, command: t.plcCommand, blocked: t.plcBlocked, fault: t.plcFault, input: t.plcPressed,
    position: t.plcPosition, place: t.plcPlace, turned: t.plcTurned, extended: t.plcExtended, retracted: t.plcRetracted, on: t.plcOn,
    at_place: t.plcAtPlace, lamp: t.plcLamp, value: t.plcValue, counter: t.plcCounter,
  };
  return names[key] ?? key;
};

function Release({ name, path, hand }: { name: string; path: string; hand: Hand }) {
  return <button aria-label={text.value.plcRelease(name)} disabled={!hand.live.get(path)?.forced} onClick={() => hand.release(path)}>✕</button>;
}

function Bit({ name, path, hand, caption }: { name: string; path: string; hand: Hand; caption?: string }) {
  const value = hand.live.get(path)?.value;
  const on = value === "TRUE";
  return (
    <div class="row">
      <button role="switch" aria-checked={on} aria-label={text.value.plcSwitch(name)} onClick={() => hand.set(path, on ? "FALSE" : "TRUE")}>
        {caption ? `${caption}: ${value ?? "–"}` : value ?? "–"}
      </button>
      <Release name={name} path={path} hand={hand} />
    </div>
  );
}

function Operated({ device, control, hand }: { device: string; control: Control; hand: Hand }) {
  const t = text.value;
  const name = `${device}: ${keyName(t, control.key)}`;
  const now = hand.live.get(control.path);
  if (control.kind === "bit") return <Bit name={name} path={control.path} hand={hand} caption={keyName(t, control.key)} />;
  if (control.kind === "position")
    return (
      <div class="row">
        <select aria-label={name} value={now?.value ?? ""} onChange={(event) => {
          const chosen = event.currentTarget.value;
          event.currentTarget.value = now?.value ?? "";
          hand.set(control.path, chosen);
        }}>
          {control.names.map((position, i) => <option key={i} value={String(control.first + i)}>{position}</option>)}
        </select>
        <Release name={name} path={control.path} hand={hand} />
      </div>
    );
  return <Handwheel device={device} name={name} path={control.path} hand={hand} />;
}

/** How long a value that was sent counts before its echo, ms. */
const echoTime = 1000;

// Who turns a handwheel that is forced already is not asked again for every count. A hand is faster than the echo of the
// values: a count adds to what was sent last, and the values are sent one after the other.
function Handwheel({ device, name, path, hand }: { device: string; name: string; path: string; hand: Hand }) {
  const t = text.value;
  const now = hand.live.get(path);
  const sent = useRef<{ value: string; at: number } | null>(null);
  const last = useRef<Promise<void>>(Promise.resolve());
  if (sent.current && now?.forced && now.value === sent.current.value) sent.current = null;
  const turn = (counts: number) => {
    const under = sent.current && Date.now() - sent.current.at < echoTime ? sent.current : null;
    const value = counted(under?.value ?? now?.value ?? "0", counts);
    const keep = () => { sent.current = { value, at: Date.now() }; };
    if (under === null && !now?.forced) return hand.set(path, value, keep);
    keep();
    last.current = last.current.then(() => order("/api/plc/force", { values: [{ path, value }] }));
  };
  return (
    <div class="row">
      {[-10, -1, 1, 10].map((counts) => (
        <button key={counts} aria-label={t.plcTurn(device, counts)} onClick={() => turn(counts)}>{counts > 0 ? `+${counts}` : `−${-counts}`}</button>
      ))}
      <Release name={name} path={path} hand={hand} />
    </div>
  );
}

export function PlcSimulator({ sources, all, live, watch }: Props) {
  const t = text.value;
  const known = useMemo(() => simulatedDevices(sources.find(({ name }) => name === "devices.yaml")?.text ?? ""), [sources]);
  const paths = useMemo(() => known.flatMap(({ controls, shows }) => [...controls, ...shows].map(({ path }) => path)), [known]);
  const bits = useMemo(() => inputBits(sources).filter(({ address }) => !paths.includes(address)), [sources, paths]);
  // A program `simulation` of the machine's own has no description: its values.
  const others = useMemo(() => [...devices(all)].filter(([name]) => !known.some((device) => name.toLowerCase() === `device_${device.name.toLowerCase()}`)), [all, known]);
  const wanted = [...paths, ...bits.map(({ address }) => address), ...others.flatMap(([, values]) => values)];
  useEffect(() => {
    watch(wanted);
    return () => watch([]);
  }, [wanted.join(" ")]);
  const hand: Hand = {
    live,
    set: (path, value, agreed) => ask(t.plcForceQuestion(path, value), t.plcForce, () => {
      agreed?.();
      void order("/api/plc/force", { values: [{ path, value }] });
    }),
    release: (path) => void order("/api/plc/release", { paths: [path] }),
  };
  const forced = (path: string) => live.get(path)?.forced === true;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.plcSimulator}>
      <GuardNote needs="builder" />
      {known.length + bits.length + others.length === 0 && <p class="dim">{t.plcNoDevices}</p>}
      {known.length > 0 && (
        <table class="plc-devices">
          <caption>{t.plcDevices}</caption>
          <tbody>
            {known.map(({ name, type, controls, shows }) => (
              <tr key={name} class={[...controls, ...shows].some(({ path }) => forced(path)) ? "forced" : ""}>
                <td>{name.replaceAll("_", " ")} <span class="dim">{typeName(t, type)}</span></td>
                <td><Guard needs="builder">{controls.map((control) => <Operated key={control.key} device={name} control={control} hand={hand} />)}</Guard></td>
                <td class="digits">{shows.map(({ key, path }) => <div key={key}><span class="dim">{keyName(t, key)}</span> {live.get(path)?.value ?? "–"}</div>)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      <table>
        <caption>{t.plcInputBits}</caption>
        <tbody>
          {bits.map(({ address, name }) => (
            <tr key={address} class={forced(address) ? "forced" : ""}>
              <td>{name || address} {name && <span class="dim">{address}</span>}</td>
              <td><Guard needs="builder"><Bit name={name || address} path={address} hand={hand} /></Guard></td>
            </tr>
          ))}
        </tbody>
      </table>
      {others.map(([device, values]) => (
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
