// SPDX-License-Identifier: Apache-2.0
// Walks every pair of a state and an event through the real core and compares what follows with the table in
// docs/channel-states.md.
#include <malloc.h>

#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::CommandKind;
using testing::three_axes;

/// A channel whose PLC answers only when a test tells it to.
struct Bench : testing::Channel {
  Bench() {
    parameters->values[105000] = {0, "S"}, parameters->values[105001] = {10, ""};
    parameters->values[105036] = {12000, ""};
    begin();
    cycles_per_round = 8;
    answer_plc = false;
    core->set_cycle_service(true);
  }
  void TestBody() override {}

  Answer mode(Mode to) { return ask(CommandKind::SET_MODE, "", 0, 0, to); }
  Answer jog() { return ask({.command = CommandKind::JOG_AXIS, .axis = 2, .speed = 3000, .press = 7}); }
  Answer wheel() { return ask(CommandKind::HANDWHEEL, "", 9, 1, Mode::AUTO, 1); }
  Answer mdi(const std::string& line) { return ask(CommandKind::MDI_LINE, line); }
  void rounds(int count) {
    for (int i = 0; i < count; ++i) round();
  }
  /// Rounds until the state's name is `wanted`.
  void until(const std::string& wanted, int most = 20000) {
    for (int i = 0; i < most && core->states().name() != wanted; ++i) round();
  }
  void start(const std::string& program, int then = 12) {
    load(program);
    ask(CommandKind::CYCLE_START);
    rounds(then);
  }
  void feed_hold(const std::string& then) {
    ask(CommandKind::FEED_HOLD);
    until(then);
  }
  void finish_function(bool failed) {
    if (!auxiliaries.empty()) core->on_auxiliary_done({0, auxiliaries.back().number, failed});
  }
  /// The service that carries out a called cycle answers.
  void answer_cycle(CycleOutcome outcome) {
    CycleReply reply;
    while (const auto request = core->take_cycle_request()) reply.number = request->number;
    reply.outcome = outcome, reply.reason = "no contact";
    if (outcome == CycleOutcome::CALL) reply.program = "part.nc";
    core->on_cycle_reply(reply);
  }
  void drive_mode(DriveMode to) {
    drive.mode = to;
    core->on_feedback(drive.run(0));
  }
};

const std::string path = "G90\nG1 X100 Y20 F6000\nX0\nM30\n";
const std::string tapped = "G90 G94\nG99 G84 X0 Y0 Z-10 R0 F500\nG80\nM30\n";

struct State {
  const char* label;  ///< as in the document
  const char* name;   ///< of ChannelStates, when it is reached
  std::function<void(Bench&)> reach;
};

void hold_program(Bench& b) {
  b.start(path, 20);
  b.feed_hold("Held program");
}
void suspend(Bench& b, Mode mode) {
  hold_program(b);
  b.mode(mode);
}
void find_line(Bench& b) {
  b.load(path);
  b.ask(CommandKind::START_FROM_LINE, "", 3);
  b.until("Held preparing");
}

std::vector<State> states() {
  return {
      {"Idle AUTO", "Idle", [](Bench& b) { b.load(path); }},
      {"Idle MDI", "Idle", [](Bench& b) { b.load(path), b.mode(Mode::MDI); }},
      {"Idle JOG", "Idle", [](Bench& b) { b.load(path), b.mode(Mode::JOG); }},
      {"Idle REF", "Idle",
       [](Bench& b) {
         b.mode(Mode::MDI), b.mdi("G1 Y5 F6000"), b.until("Idle");  // away from the reference position
         b.load(path), b.mode(Mode::REF);
       }},
      {"Running search", "Running program",
       [](Bench& b) { b.load(path), b.ask(CommandKind::START_FROM_LINE, "", 3); }},
      {"Running program", "Running program", [](Bench& b) { b.start(path, 20); }},
      {"Running skip", "Running program", [](Bench& b) { b.start("G90\nG31 X100 F3000\nM30\n", 20); }},
      {"Running tapping", "Running program",
       [](Bench& b) {
         b.answer_plc = true;
         b.start("S400 M3\n" + tapped, 60);
         b.answer_plc = false;
       }},
      {"Running retracing", "Running retracing",
       [](Bench& b) { b.start(path, 60), b.ask(CommandKind::RETRACE, "", 1); }},
      {"Running MDI", "Running MDI",
       [](Bench& b) { b.mode(Mode::MDI), b.mdi("G91 G1 X50 F6000"), b.rounds(10); }},
      {"Running jog", "Running jog", [](Bench& b) { b.mode(Mode::JOG), b.jog(), b.rounds(10); }},
      {"Running jog stopping", "Running jog stopping",
       [](Bench& b) { b.mode(Mode::JOG), b.jog(), b.rounds(10), b.ask(CommandKind::JOG_STOP); }},
      {"Running handwheel", "Running handwheel", [](Bench& b) { b.mode(Mode::JOG), b.wheel(), b.rounds(5); }},
      {"Preparing", "Preparing",
       [](Bench& b) {
         b.drive.lose_queue();
         find_line(b), b.ask(CommandKind::CYCLE_START), b.rounds(5);
       }},
      {"Preparing return", "Preparing (program suspended)",
       [](Bench& b) {
         suspend(b, Mode::JOG), b.jog(), b.rounds(20), b.ask(CommandKind::JOG_STOP), b.until("Suspended");
         b.mode(Mode::AUTO), b.ask(CommandKind::CYCLE_START), b.rounds(5);
       }},
      {"Waiting program", "Waiting program", [](Bench& b) { b.start("M8\n" + path); }},
      {"Waiting table", "Waiting program", [](Bench& b) { b.start("G10 L2 P1 X5\n" + path); }},
      {"Waiting cycle", "Waiting program", [](Bench& b) { b.start("#3100=9960\n" + path); }},
      {"Waiting MDI", "Waiting MDI", [](Bench& b) { b.mode(Mode::MDI), b.mdi("M8"), b.rounds(3); }},
      {"Waiting preparing", "Waiting preparing",
       [](Bench& b) {
         b.load("M8\n" + path), b.ask(CommandKind::START_FROM_LINE, "", 4), b.until("Held preparing");
         b.ask(CommandKind::CYCLE_START), b.rounds(2);
       }},
      {"Holding program", "Holding program",
       [](Bench& b) { b.start(path, 20), b.ask(CommandKind::FEED_HOLD); }},
      {"Holding retracing", "Holding retracing",
       [](Bench& b) {
         b.start(path, 60), b.ask(CommandKind::RETRACE, "", 1), b.rounds(10), b.ask(CommandKind::FEED_HOLD);
       }},
      {"Holding MDI", "Holding MDI",
       [](Bench& b) {
         b.mode(Mode::MDI), b.mdi("G91 G1 X50 F6000"), b.rounds(10), b.ask(CommandKind::FEED_HOLD);
       }},
      {"Holding jog", "Holding jog",
       [](Bench& b) { b.mode(Mode::JOG), b.jog(), b.rounds(10), b.ask(CommandKind::FEED_HOLD); }},
      {"Holding preparing", "Holding preparing",
       [](Bench& b) {
         find_line(b), b.ask(CommandKind::CYCLE_START), b.rounds(10), b.ask(CommandKind::FEED_HOLD);
       }},
      {"Holding reset", "Holding program, reset",
       [](Bench& b) { b.start(path, 20), b.ask(CommandKind::RESET); }},
      {"Held program", "Held program", hold_program},
      {"Held retracing", "Held retracing",
       [](Bench& b) { b.start(path, 60), b.ask(CommandKind::RETRACE, "", 1), b.until("Held retracing"); }},
      {"Held MDI", "Held MDI",
       [](Bench& b) { b.mode(Mode::MDI), b.mdi("G91 G1 X50 F6000"), b.rounds(10), b.feed_hold("Held MDI"); }},
      {"Held jog", "Held jog",
       [](Bench& b) { b.mode(Mode::JOG), b.jog(), b.rounds(10), b.feed_hold("Held jog"); }},
      {"Held preparing", "Held preparing", find_line},
      {"Suspended AUTO", "Suspended", [](Bench& b) { suspend(b, Mode::JOG), b.mode(Mode::AUTO); }},
      {"Suspended MDI", "Suspended", [](Bench& b) { suspend(b, Mode::MDI); }},
      {"Suspended JOG", "Suspended", [](Bench& b) { suspend(b, Mode::JOG); }},
      {"Suspended REF", "Suspended", [](Bench& b) { suspend(b, Mode::REF); }},
      {"Suspended, running jog", "Running jog (program suspended)",
       [](Bench& b) { suspend(b, Mode::JOG), b.jog(), b.rounds(10); }},
      {"Suspended, running MDI", "Running MDI (program suspended)",
       [](Bench& b) { suspend(b, Mode::MDI), b.mdi("G91 G1 Z50 F6000"), b.rounds(10); }},
      {"Interrupted by the drive", "Interrupted program",
       [](Bench& b) { b.start(path, 20), b.drive_mode(DriveMode::HELD); }},
      {"Interrupted, drive restarted", "Interrupted program",
       [](Bench& b) { b.start(path, 20), b.drive.forget(), b.drive_mode(DriveMode::FOLLOWING); }},
      {"Interrupted, drives off", "Interrupted program, drives off",
       [](Bench& b) { hold_program(b), b.drive_mode(DriveMode::OFF), b.drive_mode(DriveMode::FOLLOWING); }},
      {"Interrupted jog", "Interrupted jog",
       [](Bench& b) { b.mode(Mode::JOG), b.jog(), b.rounds(10), b.drive_mode(DriveMode::HELD); }},
  };
}

struct Event {
  const char* label;
  std::function<Answer(Bench&)> happen;
};

Answer silently(const std::function<void()>& event) {
  event();
  return {};
}

Event command(const char* label, CommandKind kind, double value = 0, double increment = 0,
              Mode mode = Mode::AUTO, const char* text = "") {
  return {label, [=](Bench& b) { return b.ask(kind, text, value, increment, mode, 1); }};
}

std::vector<Event> events() {
  return {
      command("SET_MODE AUTO", CommandKind::SET_MODE, 0, 0, Mode::AUTO),
      command("SET_MODE MDI", CommandKind::SET_MODE, 0, 0, Mode::MDI),
      command("SET_MODE JOG", CommandKind::SET_MODE, 0, 0, Mode::JOG),
      command("SET_MODE REF", CommandKind::SET_MODE, 0, 0, Mode::REF),
      command("SELECT_PROGRAM", CommandKind::SELECT_PROGRAM, 0, 0, Mode::AUTO, "part.nc"),
      command("CYCLE_START", CommandKind::CYCLE_START),
      command("START_FROM_LINE", CommandKind::START_FROM_LINE, 3),
      command("FEED_HOLD", CommandKind::FEED_HOLD),
      command("RESET", CommandKind::RESET),
      command("MDI_LINE", CommandKind::MDI_LINE, 0, 0, Mode::AUTO, "G91 G1 X1 F1000"),
      command("JOG_AXIS", CommandKind::JOG_AXIS, 1000, 5),
      {"JOG_RENEW", [](Bench& b) { return b.ask({.command = CommandKind::JOG_RENEW, .press = 7}); }},
      command("JOG_STOP", CommandKind::JOG_STOP),
      command("REFERENCE_AXIS", CommandKind::REFERENCE_AXIS),
      command("HANDWHEEL", CommandKind::HANDWHEEL, 1, 0.1),
      command("RETRACE on", CommandKind::RETRACE, 1),
      command("RETRACE off", CommandKind::RETRACE, 0),
      command("DRY_RUN", CommandKind::DRY_RUN, 1),
      command("AUXILIARY_LOCK", CommandKind::AUXILIARY_LOCK, 1),
      command("AXIS_LOCK", CommandKind::AXIS_LOCK, 1),
      command("BLOCK_SKIP", CommandKind::BLOCK_SKIP, 1),
      {"SET_PARTS", [](Bench& b) { return b.ask({.command = CommandKind::SET_PARTS, .parts = 7}); }},
      {"TOOL_IN_SPINDLE",
       [](Bench& b) { return b.ask({.command = CommandKind::TOOL_IN_SPINDLE, .tool = 7}); }},
      command("HANDWHEEL_OFFSET", CommandKind::HANDWHEEL_OFFSET, 1),
      command("FEED_OVERRIDE", CommandKind::FEED_OVERRIDE, 0.5),
      command("RAPID_OVERRIDE", CommandKind::RAPID_OVERRIDE, 0.5),
      command("SPINDLE_OVERRIDE", CommandKind::SPINDLE_OVERRIDE, 0.8),
      command("FEED_OVERRIDE_STEP", CommandKind::FEED_OVERRIDE_STEP, 0.1),
      command("RAPID_OVERRIDE_STEP", CommandKind::RAPID_OVERRIDE_STEP, -0.1),
      command("SPINDLE_OVERRIDE_STEP", CommandKind::SPINDLE_OVERRIDE_STEP, 0.1),
      command("SINGLE_BLOCK", CommandKind::SINGLE_BLOCK, 1),
      command("OPTIONAL_STOP", CommandKind::OPTIONAL_STOP, 1),
      {"alarm or PLC holds",
       [](Bench& b) { return silently([&] { b.core->set_hold("Alarm 100: a test"); }); }},
      {"PLC: function done", [](Bench& b) { return silently([&] { b.finish_function(false); }); }},
      {"PLC: function failed", [](Bench& b) { return silently([&] { b.finish_function(true); }); }},
      {"table changed", [](Bench& b) { return silently([&] { b.core->on_table_changed(""); }); }},
      {"table refused", [](Bench& b) { return silently([&] { b.core->on_table_changed("disk full"); }); }},
      {"cycle: part to call", [](Bench& b) { return silently([&] { b.answer_cycle(CycleOutcome::CALL); }); }},
      {"cycle: finished", [](Bench& b) { return silently([&] { b.answer_cycle(CycleOutcome::FINISHED); }); }},
      {"cycle: refused", [](Bench& b) { return silently([&] { b.answer_cycle(CycleOutcome::REFUSED); }); }},
      {"cycle: not answered", [](Bench& b) { return silently([&] { b.core->give_up_cycle(); }); }},
      {"drive stopped", [](Bench& b) { return silently([&] { b.drive_mode(DriveMode::HELD); }); }},
      {"drives off", [](Bench& b) { return silently([&] { b.drive_mode(DriveMode::OFF); }); }},
      {"drive restarted",
       [](Bench& b) { return silently([&] { b.drive.forget(), b.drive_mode(b.drive.mode); }); }},
      {"on its own",
       [](Bench& b) {
         return silently([&] {
           const auto before = b.core->states().name();
           for (int i = 0; i < 3000 && b.core->states().name() == before; ++i) b.round();
         });
       }},
  };
}

/// What each event leads to in `state`. A refusal changes nothing, so the next event may find the same core.
std::vector<std::string> outcomes(const State& state, const std::vector<Event>& all) {
  std::vector<std::string> results;
  std::unique_ptr<Bench> bench;
  for (const auto& event : all) {
    if (!bench) {
      bench = std::make_unique<Bench>();
      state.reach(*bench);
      EXPECT_EQ(bench->core->states().name(), state.name) << "in reaching " << state.label;
    }
    const auto answer = event.happen(*bench);
    const auto after = bench->core->states().name();
    if (answer.accepted) {
      results.push_back(after == state.name ? "stays" : after);
      bench.reset();
    } else {
      EXPECT_EQ(after, state.name) << state.label << ", " << event.label;
      results.push_back("refused " + std::to_string(answer.alarm) + ": " + answer.reason);
    }
  }
  return results;
}

std::string table() {
  const auto rows = states();
  const auto columns = events();
  std::vector<std::vector<std::string>> results;
  results.reserve(rows.size());
  for (const auto& row : rows) results.push_back(outcomes(row, columns));
  std::ostringstream out;
  out << "| event | state before | state after, or refusal |\n|---|---|---|\n";
  for (std::size_t e = 0; e < columns.size(); ++e) {
    std::vector<std::pair<std::string, std::vector<std::string>>> groups;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto& result = results[r][e];
      auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == result; });
      if (group == groups.end()) group = groups.insert(groups.end(), {result, {}});
      group->second.emplace_back(rows[r].label);
    }
    // The largest group comes last, without its names.
    std::stable_sort(groups.begin(), groups.end(),
                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto& [result, names] = groups[i];
      out << "| " << (i == 0 ? columns[e].label : "") << " | ";
      const bool others = i + 1 == groups.size();
      if (others) out << (groups.size() == 1 ? "all states" : "all other states");
      for (std::size_t k = 0; k < names.size() && !others; ++k) out << (k == 0 ? "" : "; ") << names[k];
      out << " | " << result << " |\n";
    }
  }
  return out.str();
}

// A channel's look-ahead takes megabytes, and the walk makes a thousand channels: their memory is kept for
// the next one instead of being given back to the system and cleared again.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

TEST(StateTable, IsWhatTheCoreDoesInEveryStateAtEveryEvent) {
  keep_freed_memory();
  std::ifstream file(CHANNEL_STATES_DOCUMENT);
  ASSERT_TRUE(file) << CHANNEL_STATES_DOCUMENT;
  std::stringstream text;
  text << file.rdbuf();
  const std::string document = text.str(), begin = "<!-- table begins -->\n", end = "<!-- table ends -->";
  const auto from = document.find(begin), to = document.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  const auto real = table();
  if (document.substr(from + begin.size(), to - from - begin.size()) == real) return;
  const std::string written = "channel-states.md";
  std::ofstream(written) << document.substr(0, from + begin.size()) << real << document.substr(to);
  ADD_FAILURE() << "docs/channel-states.md is not what the code does; what it does was written to " << written
                << " in the working directory";
}

}  // namespace
}  // namespace trunnion::channel
