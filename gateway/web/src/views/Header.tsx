// SPDX-License-Identifier: Apache-2.0
import { channel, channelList, channelNumber, channels, chooseChannel, machine, stop, view, type ViewName } from "../state/store";
import { onPress } from "./press";

const views: [ViewName, string][] = [
  ["operate", "Operate"],
  ["parameters", "Parameters"],
  ["offsets", "Tools & offsets"],
  ["diagnosis", "Diagnosis"],
];

const pressEmergencyStop = () => void stop("Emergency stop", "/api/panel/emergency-stop");

function EmergencyStop() {
  const plc = machine.value.plc;
  if (!plc?.emergency_stop) {
    return (
      <button
        class="estop"
        data-test="estop"
        title="Ask the PLC for an emergency stop. Not a replacement for the hard-wired one."
        {...onPress(pressEmergencyStop)}
      >
        E-STOP
      </button>
    );
  }
  return (
    <button class="estop engaged" {...onPress(pressEmergencyStop)}>
      STOPPED
    </button>
  );
}

function ChannelTabs() {
  if (channelList.value.length < 2) return null;
  return (
    <div class="segments" role="tablist" aria-label="channel">
      {channelList.value.map((number) => (
        <button
          key={number}
          role="tab"
          aria-selected={number === channelNumber.value}
          onClick={() => chooseChannel(number)}
        >
          {channels.value[String(number)]?.name || `Channel ${number}`}
        </button>
      ))}
    </div>
  );
}

export function Header() {
  const state = machine.value;
  const one = channel.value;
  const cluster = state.cluster;
  return (
    <header>
      <div class="machine-name">
        <strong data-test="machine">{cluster?.machine || "Trunnion"}</strong>
        <span class={`tag ${cluster?.ready ? "good" : "warn"}`} data-test="cluster">
          {cluster ? (cluster.ready ? "cluster ready" : "cluster not ready") : "no cluster"}
        </span>
        {cluster?.virtual_time && <span class="tag note">virtual time</span>}
      </div>
      {one && (
        <div class="run">
          <span class="mode" data-test="mode">{one.mode}</span>
          <span class={`state ${one.state.toLowerCase()}`} data-test="state">{one.state}</span>
          <span class="program">
            <span class="program-name">{one.program || "no program"}</span>
            <span class="meter" role="progressbar" aria-valuenow={Math.round(one.progress * 100)}>
              <i style={{ width: `${Math.min(1, one.progress) * 100}%` }} />
            </span>
            <span class="dim digits">
              {one.line} / {one.lines_total}
            </span>
          </span>
        </div>
      )}
      <ChannelTabs />
      <nav>
        {views.map(([name, title], index) => (
          <button
            key={name}
            aria-current={view.value === name ? "page" : undefined}
            title={`Alt+${index + 1}`}
            data-test={`view-${name}`}
            onClick={() => (view.value = name)}
          >
            {title}
          </button>
        ))}
      </nav>
      <EmergencyStop />
    </header>
  );
}
