// SPDX-License-Identifier: Apache-2.0
// channel: an operator's command to a channel, its status, and spindles that follow each other. The words of
// the other commands are the table's (idl/operator_commands.yaml).
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include "bus/json.hpp"
#include "channel_status.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "cluster/stored_program.hpp"
#include "commands.hpp"
#include "commands/channel_request.hpp"
#include "couple_command.hpp"
#include "interrupt_watch.hpp"
#include "new_alarms.hpp"
#include "spindle_orders.hpp"

namespace trunnion::cli {
namespace {

using idl::channel::CommandKind;
using idl::channel::RunState;

constexpr const char* status_word = "status";

struct ChannelOptions {
  std::string word;
  std::vector<std::string> arguments;
  std::uint16_t channel = 0;
  std::uint32_t from_line = 0;
  bool take_over = false;
  bool watch = false;
};

idl::channel::ChannelRequest request_of(cluster::Client& client, const ChannelOptions& options) {
  if (options.word == "start" && options.from_line != 0)
    return {.channel = options.channel, .command = CommandKind::START_FROM_LINE, .line = options.from_line};
  const auto* command = commands::find_word(options.word);
  if (command == nullptr) throw std::runtime_error("no such command: " + options.word);
  const bool axes = commands::names_axes(*command) && !options.arguments.empty();
  const auto letters = axes ? client.newest(topics::channel_state, options.channel).letters : "";
  auto request = commands::request_of(*command, options.arguments, letters);
  request.channel = options.channel;
  if (request.command == CommandKind::SELECT_PROGRAM)
    if (const auto stored = cluster::find_program(client.newest(topics::program_list), request.program))
      request.program = stored->name;
  return request;
}

// The search for the line is over when the channel is held, or idle again because it failed.
std::string await_line(cluster::Client& client, std::uint16_t channel, NewAlarms& alarms) {
  auto states = client.reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + 60;
  idl::channel::ChannelState state;
  int idle = 0;
  while (service::monotonic_seconds() < until) {
    const auto& error = alarms.error();
    while (states.take(state)) {
      if (state.channel != channel) continue;
      if (state.state == RunState::HELD) return state.detail;
      idle = state.state == RunState::IDLE ? idle + 1 : 0;
    }
    if (idle > 3) throw std::runtime_error(error.empty() ? "the line was not found" : error);
    client.bus().signal().wait(0.02);
  }
  throw std::runtime_error("the line was not found within 60 s");
}

// A jog without an increment lasts as long as this command: until it is interrupted, or the channel ends it.
void renew_until_released(cluster::Client& client, const idl::channel::ChannelRequest& jog) {
  const InterruptWatch interrupts;
  std::fprintf(stderr, "Jogging until Ctrl-C, jog-stop or the end of travel\n");
  bool moving = true;
  while (moving && !InterruptWatch::requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    try {
      client.channel({.channel = jog.channel, .command = CommandKind::JOG_RENEW, .press = jog.press});
    } catch (const std::runtime_error&) {
      moving = false;
    }
  }
  if (moving) client.channel({.channel = jog.channel, .command = CommandKind::JOG_STOP, .axis = jog.axis});
}

int run_command(const Common& common, const ChannelOptions& options) {
  if (options.word == status_word && options.arguments.empty())
    return show_channel_status(common, options.channel, options.watch);
  if (options.word == status_word) throw std::runtime_error("status has no arguments: give --channel N");
  if (options.watch) throw std::runtime_error("--watch is an option of status");
  if (options.word == couple_word || options.word == uncouple_word)
    return couple_spindles(common, options.word, options.arguments, options.channel, options.take_over);
  const auto cluster = cluster::find_cluster(common.domain);
  cluster::Client client(cluster.run.domain);
  auto request = request_of(client, options);
  // Stops are everybody's.
  std::optional<cluster::OperatingStation> station;
  if (request.command != CommandKind::FEED_HOLD && request.command != CommandKind::JOG_STOP)
    station.emplace(cluster.run.domain, options.take_over);
  const bool jogs_until_released = request.command == CommandKind::JOG_AXIS && request.increment == 0;
  if (jogs_until_released && request.press == 0) request.press = std::random_device{}() | 1u;
  std::optional<NewAlarms> alarms;
  if (options.word == "start" && options.from_line != 0) alarms.emplace(client, options.channel);
  client.channel(request);
  if (jogs_until_released) renew_until_released(client, request);
  std::string detail;
  if (alarms) detail = await_line(client, options.channel, *alarms);
  if (common.json)
    std::cout << bus::text_of({{"accepted", true}, {"detail", detail}}) << "\n";
  else if (!detail.empty())
    std::printf("%s\n", detail.c_str());
  return 0;
}

std::string list_of_commands() {
  std::string text =
      "status: position, mode, state, program and line, feed, tool, alarms, and the spindles of the machine, "
      "once or with --watch\n"
      "couple SLAVE MASTER [ANGLE], uncouple SLAVE: a spindle follows another one, ANGLE deg added, or no "
      "longer (docs/spindles.md)\n"
      "COMMANDS, described in docs/operator-commands.md:";
  for (const auto& row : commands::channel_commands()) {
    const auto usage = commands::usage(row);
    text +=
        "\n  " + usage + std::string(usage.size() < 34 ? 34 - usage.size() : 1, ' ') + std::string(row.about);
  }
  return text;
}

}  // namespace

void add_channel_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<ChannelOptions>();
  auto* command = add_command(app, common, "channel", "Operate a channel, or show its status",
                              [&common, options] { return run_command(common, *options); });
  std::vector<std::string> words{status_word, couple_word, uncouple_word};
  for (const auto& row : commands::channel_commands()) words.emplace_back(row.word);
  command->add_option("what", options->word, "What to do")->required()->check(CLI::IsMember(words));
  command
      ->add_option("arguments", options->arguments,
                   "Program, mode, on or off, axes, levels, spindles, numbers")
      ->expected(0, 3);
  command->add_option("--channel", options->channel, "Channel number");
  command->add_option("--from-line", options->from_line,
                      "With start: search this line, report what will happen, and wait for another start");
  command->add_flag(
      "--watch", options->watch,
      "With status: until Ctrl-C, in place at a terminal, otherwise one line of JSON per change");
  command->add_flag("--take-right", options->take_over, cluster::take_right_help);
  command->footer(list_of_commands());
}

}  // namespace trunnion::cli
