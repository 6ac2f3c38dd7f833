// channel: what an operator asks of a channel.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>

#include "bus/json.hpp"
#include "client.hpp"
#include "cluster.hpp"
#include "commands.hpp"

namespace trunnion::deploy {
namespace {

using idl::channel::CommandKind;
using idl::channel::Mode;
using idl::channel::RunState;

struct Order {
  std::uint16_t channel = 0;
  std::string what;
  std::vector<std::string> arguments;
  std::uint32_t from_line = 0;
};

const std::map<std::string, CommandKind> plain{{"start", CommandKind::CYCLE_START},
                                               {"hold", CommandKind::FEED_HOLD},
                                               {"reset", CommandKind::RESET},
                                               {"jog-stop", CommandKind::JOG_STOP}};
const std::map<std::string, CommandKind> switches{
    {"dry-run", CommandKind::DRY_RUN},           {"auxiliary-lock", CommandKind::AUXILIARY_LOCK},
    {"retrace", CommandKind::RETRACE},           {"handwheel-offset", CommandKind::HANDWHEEL_OFFSET},
    {"single-block", CommandKind::SINGLE_BLOCK}, {"optional-stop", CommandKind::OPTIONAL_STOP}};

const std::string& argument(const Order& order, std::size_t index, const char* meaning) {
  if (index >= order.arguments.size())
    throw std::runtime_error("channel " + order.what + " needs " + meaning);
  return order.arguments[index];
}

double number(const std::string& text) {
  std::size_t read = 0;
  double value = 0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != text.size()) throw std::runtime_error("'" + text + "' is not a number");
  return value;
}

bool on(const Order& order) {
  const auto& text = argument(order, 0, "on or off");
  if (text != "on" && text != "off") throw std::runtime_error("'" + text + "': on or off");
  return text == "on";
}

Mode mode(const std::string& text) {
  const std::map<std::string, Mode> modes{
      {"auto", Mode::AUTO}, {"mdi", Mode::MDI}, {"jog", Mode::JOG}, {"ref", Mode::REF}};
  const auto found = modes.find(text);
  if (found == modes.end()) throw std::runtime_error("mode '" + text + "': auto, mdi, jog or ref");
  return found->second;
}

std::size_t axis(const idl::channel::ChannelState& state, char letter) {
  const auto at = state.letters.find(letter);
  if (at == std::string::npos)
    throw std::runtime_error(std::string("the channel has no axis ") + letter + ", it has " + state.letters);
  return at;
}

// "off", "all", or letters such as XZ: bit i for axis i of the channel.
std::uint16_t axis_mask(const idl::channel::ChannelState& state, const std::string& text) {
  if (text == "off") return 0;
  std::uint32_t mask = 0;
  if (text == "all")
    mask = (1u << state.letters.size()) - 1;
  else
    for (const char letter : text) mask |= 1u << axis(state, letter);
  return static_cast<std::uint16_t>(mask);
}

// "off", or levels such as 13: bit 0 for level 1.
std::uint16_t level_mask(const std::string& text) {
  if (text == "off") return 0;
  std::uint32_t mask = 0;
  for (const char level : text) {
    if (level < '1' || level > '9') throw std::runtime_error("'" + text + "': levels 1 to 9, or off");
    mask |= 1u << (level - '1');
  }
  return static_cast<std::uint16_t>(mask);
}

ChannelRequest request_of(Client& client, const Order& order) {
  ChannelRequest request;
  request.channel = order.channel;
  const auto state = [&] {
    auto reader = client.bus().reader(topics::channel_state);
    const double until = node::monotonic_seconds() + 2;
    idl::channel::ChannelState newest;
    while (node::monotonic_seconds() < until) {
      while (reader.take(newest))
        if (newest.channel == order.channel) return newest;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    throw std::runtime_error("channel " + std::to_string(order.channel) + " is not there");
  };
  if (order.what == "start" && order.from_line != 0) {
    request.command = CommandKind::START_FROM_LINE;
    request.line = order.from_line;
  } else if (const auto found = plain.find(order.what); found != plain.end()) {
    request.command = found->second;
  } else if (const auto change = switches.find(order.what); change != switches.end()) {
    request.command = change->second;
    request.on = on(order);
  } else if (order.what == "select") {
    request.command = CommandKind::SELECT_PROGRAM;
    request.program = argument(order, 0, "a program");
  } else if (order.what == "mode") {
    request.command = CommandKind::SET_MODE;
    request.mode = mode(argument(order, 0, "auto, mdi, jog or ref"));
  } else if (order.what == "axis-lock") {
    request.command = CommandKind::AXIS_LOCK;
    request.axes = axis_mask(state(), argument(order, 0, "axis letters, all or off"));
  } else if (order.what == "block-skip") {
    request.command = CommandKind::BLOCK_SKIP;
    request.levels = level_mask(argument(order, 0, "levels, or off"));
  } else {  // jog AXIS SPEED [DISTANCE], handwheel AXIS COUNTS INCREMENT
    const bool wheel = order.what == "handwheel";
    const auto& letter = argument(order, 0, "an axis");
    if (letter.size() != 1) throw std::runtime_error("'" + letter + "' is no axis");
    request.axis = static_cast<std::uint8_t>(axis(state(), letter[0]));
    request.command = wheel ? CommandKind::HANDWHEEL : CommandKind::JOG_AXIS;
    const double value = number(argument(order, 1, wheel ? "counts" : "a speed"));
    if (wheel)
      request.counts = static_cast<std::int32_t>(std::clamp(value, -1e6, 1e6));
    else
      request.speed = value;
    if (wheel || order.arguments.size() > 2) request.increment = number(argument(order, 2, "an increment"));
  }
  return request;
}

// The search for the line is over when the channel is held, or idle again because it failed.
std::string await_line(Client& client, std::uint16_t channel) {
  auto states = client.bus().reader(topics::channel_state);
  auto alarms = client.bus().reader(topics::alarm);
  const double until = node::monotonic_seconds() + 60;
  std::string alarm;
  idl::channel::ChannelState state;
  int idle = 0;
  while (node::monotonic_seconds() < until) {
    idl::service::Alarm a;
    while (alarms.take(a))
      if (a.source == "channel" && a.part == channel && a.severity >= idl::service::Severity::ERROR)
        alarm = "alarm " + std::to_string(a.number) + ": " + a.text;
    while (states.take(state)) {
      if (state.channel != channel) continue;
      if (state.state == RunState::HELD) return state.detail;
      idle = state.state == RunState::IDLE ? idle + 1 : 0;
    }
    if (idle > 3) throw std::runtime_error(alarm.empty() ? "the line was not found" : alarm);
    client.bus().signal().wait(0.02);
  }
  throw std::runtime_error("the line was not found within 60 s");
}

int run(const Common& common, const Order& order) {
  const auto cluster = find_cluster(common.domain);
  Client client(cluster.run.domain);
  client.channel(request_of(client, order));
  std::string detail;
  if (order.what == "start" && order.from_line != 0) detail = await_line(client, order.channel);
  if (common.json)
    std::cout << bus::text_of({{"accepted", true}, {"detail", detail}}) << "\n";
  else if (!detail.empty())
    std::printf("%s\n", detail.c_str());
  return 0;
}

}  // namespace

void add_channel_command(CLI::App& app, Common& common) {
  auto order = std::make_shared<Order>();
  auto* command = add_command(
      app, common, "channel",
      "Operate a channel: start [--from-line N], hold, reset, select PROGRAM, mode auto|mdi|jog|ref, "
      "single-block|optional-stop|dry-run|auxiliary-lock|retrace|handwheel-offset on|off, "
      "axis-lock XYZ|all|off, block-skip 13|off, jog AXIS SPEED [DISTANCE], jog-stop, "
      "handwheel AXIS COUNTS INCREMENT",
      [&common, order] { return run(common, *order); });
  command->add_option("what", order->what, "What to do")
      ->required()
      ->check(CLI::IsMember({"start", "hold", "reset", "select", "mode", "single-block", "optional-stop",
                             "dry-run", "auxiliary-lock", "retrace", "handwheel-offset", "axis-lock",
                             "block-skip", "jog", "jog-stop", "handwheel"}));
  command->add_option("arguments", order->arguments, "Program, mode, on or off, axes, levels")
      ->expected(0, 3);
  command->add_option("--channel", order->channel, "Channel number");
  command->add_option("--from-line", order->from_line,
                      "With start: search this line, say what will happen, and wait for another start");
}

}  // namespace trunnion::deploy
