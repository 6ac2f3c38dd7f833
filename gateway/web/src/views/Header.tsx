// SPDX-License-Identifier: Apache-2.0
// The state bar over the whole width, in every view: what the channel does, and the two keys that stop. Nothing may lie
// over it (state_bar.css keeps it above everything else), and no content moves the keys: they have an area of fixed size.
import { useEffect } from "preact/hooks";
import { duration } from "../format";
import { cyclePeriod } from "../state/cycle_period";
import { plan, remaining } from "../state/plan";
import { channel, channelList, channelName, channelNumber, channels, chooseChannel, connection, holdAll, machine, stop } from "../state/store";
import { text } from "../text/texts";
import { Operator } from "./OperatingRight";
import { onPress } from "./press";

const pressEmergencyStop = () => void stop(text.peek().emergencyStop, "/api/panel/emergency-stop");

function EmergencyStop() {
  const stopped = machine.value.plc?.emergency_stop;
  return (
    <button
      class={`estop ${stopped ? "engaged" : ""}`}
      data-test={stopped ? "estop-engaged" : "estop"}
      aria-label={`${stopped ? text.value.emergencyStopped : text.value.emergencyStopKey}: ${text.value.emergencyStop}`}
      title={text.value.emergencyStopAbout}
      {...onPress(pressEmergencyStop)}
    >
      {stopped ? text.value.emergencyStopped : text.value.emergencyStopKey}
    </button>
  );
}

function ChannelTabs() {
  if (channelList.value.length < 2) return null;
  return (
    <div class="segments" role="group" aria-label={text.value.channel}>
      {channelList.value.map((number) => (
        <button key={number} aria-pressed={number === channelNumber.value} onClick={() => chooseChannel(number)}>
          {channelName(channels.value[String(number)]!)}
        </button>
      ))}
    </div>
  );
}

function Elapsed({ number }: { number: number }) {
  const time = machine.value.run_times?.[String(number)];
  const period = cyclePeriod.value;
  if (!time || time.ticks === 0 || period === undefined) return null;
  return (
    <span class="elapsed digits" title={time.partial ? text.value.elapsedPartAbout : text.value.elapsedAbout}>
      <span class="dim">{text.value.elapsed}</span>
      <b data-test="elapsed">{time.partial && "> "}{duration(time.ticks * period)}</b>
    </span>
  );
}

/** Of the selected program: its planned time before it is started, then what is left of it. */
function Remaining() {
  const [planned, left] = [plan.value, remaining.value];
  const one = channel.value;
  if (!planned || planned.alarm !== undefined || left === undefined || !one) return null;
  const t = text.value;
  const begun = one.suspended || (one.mode === "AUTO" && one.state !== "IDLE");
  return (
    <span class="elapsed digits" title={begun ? t.remainingAbout : t.plannedAbout}>
      <span class="dim">{begun ? t.remaining : t.planned}</span>
      <b data-test="remaining">{!planned.complete && "> "}{duration(left)}</b>
    </span>
  );
}

/** The executed share of the planned time: lines would not do, they call others and repeat. */
function Progress() {
  const [planned, left] = [plan.value, remaining.value];
  if (!planned?.complete || !planned.seconds || left === undefined) return null;
  const percent = Math.round(100 * (1 - left / planned.seconds));
  return (
    <span class="meter" role="progressbar" aria-label={text.value.progress} aria-valuemin={0} aria-valuemax={100} aria-valuenow={percent}>
      <i style={{ width: `${percent}%` }} />
    </span>
  );
}

/** Whether the cluster is ready, which nobody knows without the gateway. */
function ClusterTag() {
  const t = text.value;
  const cluster = machine.value.cluster;
  const lost = connection.value === "lost";
  const state = lost ? t.connectionLost : !cluster ? t.noCluster : cluster.ready ? t.clusterReady : t.clusterNotReady;
  return <span class={`tag ${cluster?.ready && !lost ? "good" : "warn"}`} data-test="cluster">{state}</span>;
}

export function Header() {
  const one = channel.value;
  const cluster = machine.value.cluster;
  const name = cluster?.title || cluster?.machine || "Trunnion";
  useEffect(() => {
    document.title = name;
  }, [name]);
  const t = text.value;
  const typed = one?.mode === "MDI" && one.state !== "IDLE" && !one.suspended;
  return (
    <header aria-label={t.stateBar}>
      <div class="facts">
        <div class="machine-name">
          <strong data-test="machine" title={cluster?.machine}>{name}</strong>
          <ClusterTag />
          {cluster?.virtual_time && <span class="tag note">{t.virtualTime}</span>}
          <Operator />
        </div>
        <ChannelTabs />
        {one && (
          <>
            <span class="mode" data-test="mode" data-mode={one.mode}>{t[`mode${one.mode}`]}</span>
            <span class={`state ${one.state.toLowerCase()}`} data-test="state" data-state={one.state}>{t[`state${one.state}`]}</span>
            <div class="run">
              <b class="program-name" data-test="running">{typed ? t.modeMDI : one.program || t.noProgram}</b>
              {!typed && <Progress />}
              <span class="dim digits">{!typed && one.lines_total > 0 && t.lineOf(one.line, one.lines_total)}</span>
            </div>
            <Elapsed number={one.channel} />
            <Remaining />
          </>
        )}
      </div>
      <div class="stops">
        <button class="hold" data-test="feed-hold" title={t.feedHoldAbout} {...onPress(holdAll)}>
          {t.feedHold}
        </button>
        <EmergencyStop />
      </div>
    </header>
  );
}
