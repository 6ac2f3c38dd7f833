// SPDX-License-Identifier: Apache-2.0
#include "channel_status.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "active_alarms.hpp"
#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "figures.hpp"
#include "interrupt_watch.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "spindle_status.hpp"
#include "standard_output.hpp"

namespace trunnion::cli {
namespace {

// s: a channel publishes its state every 0.05 s, the drive at least every 0.1 s
constexpr double longest_silence = 1;
constexpr std::chrono::milliseconds period(100);

struct Status {
  idl::channel::ChannelState state;
  std::vector<std::string> units;       // of each axis
  std::size_t alarms = 0;               // active on the machine
  bool connected = true;                // the state is the one of now
  std::vector<SpindleStatus> spindles;  // empty while the drive is silent
};

class StatusReader {
 public:
  StatusReader(cluster::Client& client, std::uint16_t channel)
      : alarms_(client),
        states_(client.reader_from_now(topics::channel_state)),
        feedbacks_(client.reader_from_now(topics::feedback)),
        parameters_(machine::parameters_of(client.newest(topics::parameter_set))),
        state_(client.newest(topics::channel_state, channel)),
        received_(service::monotonic_seconds()) {
    alarms_.wait_for_all();
    const double until = service::monotonic_seconds() + longest_silence;
    while (!take_feedback() && service::monotonic_seconds() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  Status read() {
    for (idl::channel::ChannelState state; states_.take(state);) {
      if (state.channel != state_.channel) continue;
      state_ = state;
      received_ = service::monotonic_seconds();
    }
    take_feedback();
    Status status{
        state_, {}, alarms_.take().size(), service::monotonic_seconds() - received_ < longest_silence, {}};
    if (service::monotonic_seconds() - heard_ < longest_silence)
      status.spindles = spindle_status(machine::spindles(parameters_), feedback_);
    for (const auto axis : state_.axes)
      status.units.emplace_back(
          parameters_.integer(parameter::axis_type, axis) == machine::axis_type_linear ? "mm" : "deg");
    return status;
  }

 private:
  bool take_feedback() {
    if (!feedbacks_.take_newest(feedback_)) return false;
    heard_ = service::monotonic_seconds();
    return true;
  }

  ActiveAlarms alarms_;
  bus::Reader<idl::channel::ChannelState> states_;
  bus::Reader<idl::stream::Feedback> feedbacks_;
  machine::Parameters parameters_;
  idl::channel::ChannelState state_;
  double received_ = 0;  // s
  idl::stream::Feedback feedback_;
  double heard_ = -longest_silence;  // s, of the drive
};

std::size_t axis_count(const Status& status) {
  const auto& state = status.state;
  return std::min({state.letters.size(), status.units.size(), state.machine.size(), state.workpiece.size(),
                   state.distance_to_go.size()});
}

bus::Json json_of(const Status& status) {
  const auto& state = status.state;
  auto spindles = bus::Json::array();
  for (const auto& spindle : status.spindles) spindles.push_back(spindle.json());
  auto axes = bus::Json::array();
  for (std::size_t i = 0; i < axis_count(status); ++i)
    axes.push_back({{"axis", std::string(1, state.letters[i])},
                    {"unit", status.units[i]},
                    {"machine", state.machine[i]},
                    {"workpiece", state.workpiece[i]},
                    {"distance_to_go", state.distance_to_go[i]}});
  return {{"channel", state.channel},
          {"name", state.name},
          {"connected", status.connected},
          {"mode", bus::to_string(state.mode)},
          {"state", bus::to_string(state.state)},
          {"detail", state.detail},
          {"program", state.program},
          {"line", state.line},
          {"lines_total", state.lines_total},
          {"axes", axes},
          {"feed_mm_per_min", state.feed},
          {"programmed_feed_mm_per_min", state.programmed_feed},
          {"feed_override", state.feed_override},
          {"rapid_override", state.rapid_override},
          {"spindle_programmed_per_min", state.spindle_programmed},
          {"spindle_override", state.spindle_override},
          {"spindles", spindles},
          {"tool", state.tool},
          {"length_offset", state.length_offset},
          {"tool_length_mm", state.tool_length},
          {"alarms", status.alarms}};
}

std::vector<std::string> lines_of(const Status& status) {
  constexpr double percent = 100;
  const auto& state = status.state;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("channel {} {}: {}, {}", unsigned{state.channel}, state.name,
                              bus::to_string(state.mode), bus::to_string(state.state)));
  if (!status.connected)
    lines.emplace_back("NO CONNECTION: these are the last values; see `trunnion status`");
  if (!state.detail.empty()) lines.push_back(state.detail);
  lines.push_back(fmt::format("program  {}, line {} of {}", state.program.empty() ? "none" : state.program,
                              state.line, state.lines_total));
  for (std::size_t i = 0; i < axis_count(status); ++i)
    lines.push_back(fmt::format("{}  machine {:>12.4f}  workpiece {:>12.4f}  to go {:>12.4f} {}",
                                state.letters[i], state.machine[i], state.workpiece[i],
                                state.distance_to_go[i], status.units[i]));
  lines.push_back(fmt::format("feed     {:.1f} mm/min, F {:.1f}, override {:.0f} %, rapid {:.0f} %",
                              state.feed, state.programmed_feed, percent * state.feed_override,
                              percent * state.rapid_override));
  lines.push_back(fmt::format("spindle  S {:.0f} 1/min, override {:.0f} %", state.spindle_programmed,
                              percent * state.spindle_override));
  for (const auto& spindle : status.spindles) lines.push_back(spindle.line());
  lines.push_back(
      fmt::format("tool     T{}, H{}, length {:.4f} mm", state.tool, state.length_offset, state.tool_length));
  lines.push_back(fmt::format("alarms   {}", status.alarms));
  return lines;
}

// Over those lines that were shown before; a line that is too long ends at the edge. Returns their number.
std::size_t show_in_place(const Status& status, std::size_t shown) {
  std::string screen = shown > 0 ? "\033[" + std::to_string(shown) + "A" : "";
  screen += "\033[?7l";
  const auto lines = lines_of(status);
  for (const auto& line : lines) screen.append(line).append("\033[K\n");
  std::cout << screen << "\033[J\033[?7h" << std::flush;
  return lines.size();
}

int watch_status(StatusReader& reader, bool terminal) {
  const InterruptWatch interrupts;
  std::size_t shown = 0;
  bus::Json last;
  while (!InterruptWatch::requested()) {
    const auto status = reader.read();
    if (terminal) {
      shown = show_in_place(status, shown);
    } else if (auto json = json_of(status); json != last) {
      std::cout << bus::text_of(json) << std::endl;
      last = std::move(json);
    }
    std::this_thread::sleep_for(period);
    if (!output_is_read()) return raise(SIGPIPE);
  }
  return 0;
}

}  // namespace

int show_channel_status(const Common& common, std::uint16_t channel, bool watch) {
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  StatusReader reader(client, channel);
  if (watch) return watch_status(reader, !common.json && isatty(STDOUT_FILENO) != 0);
  const auto status = reader.read();
  if (common.json)
    std::cout << bus::text_of(json_of(status)) << "\n";
  else
    for (const auto& line : lines_of(status)) std::cout << line << "\n";
  return 0;
}

}  // namespace trunnion::cli
