// SPDX-License-Identifier: Apache-2.0
// Every command over HTTP and on the command line, as it was before both came from one table.
#include "commands/channel_request.hpp"
#include "commands/override_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

namespace trunnion::commands {
namespace {

using bus::Json;
using idl::channel::ChannelRequest;
using idl::channel::CommandKind;
using idl::channel::Mode;
using testing::HasSubstr;

constexpr const char* five_axes = "XYZAC";

ChannelRequest post(const char* route, const Json& body) { return request_of(route, body, five_axes); }

/// `line` is what follows `trunnion channel`.
ChannelRequest words(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; in >> part;) parts.push_back(part);
  const auto* command = find_word(parts.at(0));
  if (command == nullptr) throw std::runtime_error("no such word: " + line);
  return request_of(*command, {parts.begin() + 1, parts.end()}, five_axes);
}

/// The field that is complained about, or "accepted".
template <class Call>
std::string complaint(Call call) {
  try {
    call();
  } catch (const BadField& bad) {
    EXPECT_STRNE(bad.what(), "");
    return bad.field;
  }
  return "accepted";
}

TEST(OperatorCommands, EveryCommandOfTheIdlHasOneRowAndOneWord) {
  std::multiset<CommandKind> kinds;
  std::set<std::string_view> names;
  for (const auto& row : channel_commands()) kinds.insert(row.kind), names.insert(row.word);
  for (std::size_t i = 0; i < bus::enum_size<CommandKind>(); ++i)
    EXPECT_EQ(kinds.count(static_cast<CommandKind>(i)), 1u) << bus::to_string(static_cast<CommandKind>(i));
  EXPECT_EQ(names.size(), channel_commands().size());
}

TEST(OperatorCommands, WhatStopsMotionComesByTheStreamAndWhileTheChannelIsBusy) {
  int stops = 0;
  for (const auto& row : channel_commands()) {
    EXPECT_EQ(motion_of(row.kind), row.motion);
    EXPECT_EQ(stops_motion(row.route), row.motion == Motion::stops) << row.route;
    if (row.motion != Motion::stops) continue;
    ++stops;
    EXPECT_TRUE(row.by_stream && row.busy && row.modes.empty()) << row.route;
  }
  EXPECT_EQ(stops, 2) << "feed hold and the end of a jog";
  EXPECT_EQ(motion_of(CommandKind::CYCLE_START), Motion::starts);
  EXPECT_EQ(motion_of(CommandKind::HANDWHEEL), Motion::neither) << "its counts must not withdraw a hold";
  EXPECT_EQ(motion_of(CommandKind::JOG_RENEW), Motion::neither);
  EXPECT_FALSE(stops_motion("no-such-route"));
}

struct Case {
  const char* route;
  const char* body;
  const char* line;
  ChannelRequest request;
};

// The routes, bodies and words of version 0.2.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"cycle-start", "{}", "start", {.command = CommandKind::CYCLE_START}},
      {"feed-hold", "{}", "hold", {.command = CommandKind::FEED_HOLD}},
      {"reset", "{}", "reset", {.command = CommandKind::RESET}},
      {"select",
       R"({"program":"a.nc"})",
       "select a.nc",
       {.command = CommandKind::SELECT_PROGRAM, .program = "a.nc"}},
      {"mode", R"({"mode":"MDI"})", "mode mdi", {.command = CommandKind::SET_MODE, .mode = Mode::MDI}},
      {"single-block",
       R"({"on":true})",
       "single-block on",
       {.command = CommandKind::SINGLE_BLOCK, .on = true}},
      {"optional-stop", R"({"on":false})", "optional-stop off", {.command = CommandKind::OPTIONAL_STOP}},
      {"dry-run", R"({"on":true})", "dry-run on", {.command = CommandKind::DRY_RUN, .on = true}},
      {"auxiliary-lock",
       R"({"on":true})",
       "auxiliary-lock on",
       {.command = CommandKind::AUXILIARY_LOCK, .on = true}},
      {"retrace", R"({"on":true})", "retrace on", {.command = CommandKind::RETRACE, .on = true}},
      {"handwheel-offset",
       R"({"on":true})",
       "handwheel-offset on",
       {.command = CommandKind::HANDWHEEL_OFFSET, .on = true}},
      {"axis-lock",
       R"({"axes":["X",2]})",
       "axis-lock XZ",
       {.command = CommandKind::AXIS_LOCK, .axes = 0b101}},
      {"axis-lock",
       R"({"axes":["X","Y","Z","A","C"]})",
       "axis-lock all",
       {.command = CommandKind::AXIS_LOCK, .axes = 0b11111}},
      {"axis-lock", R"({"axes":[]})", "axis-lock off", {.command = CommandKind::AXIS_LOCK}},
      {"block-skip",
       R"({"levels":[1,3]})",
       "block-skip 13",
       {.command = CommandKind::BLOCK_SKIP, .levels = 0b101}},
      {"block-skip", R"({"levels":[]})", "block-skip off", {.command = CommandKind::BLOCK_SKIP}},
      {"jog",
       R"({"axis":"C","speed":-600.5,"increment":0.01})",
       "jog C -600.5 0.01",
       {.command = CommandKind::JOG_AXIS, .axis = 4, .speed = -600.5, .increment = 0.01}},
      {"jog",
       R"({"axis":1,"speed":600})",
       "jog Y 600",
       {.command = CommandKind::JOG_AXIS, .axis = 1, .speed = 600}},
      {"jog-stop", R"({"axis":"X"})", "jog-stop", {.command = CommandKind::JOG_STOP}},
      {"jog-stop", R"({"axis":3})", "jog-stop A", {.command = CommandKind::JOG_STOP, .axis = 3}},
      {"handwheel",
       R"({"axis":"Z","counts":-3,"increment":0.01})",
       "handwheel Z -3 0.01",
       {.command = CommandKind::HANDWHEEL, .axis = 2, .increment = 0.01, .counts = -3}},
      {"start-from-line",
       R"({"line":40})",
       "start-from-line 40",
       {.command = CommandKind::START_FROM_LINE, .line = 40}},
      {"reference", R"({"axis":"Z"})", "reference Z", {.command = CommandKind::REFERENCE_AXIS, .axis = 2}},
      {"override",
       R"({"kind":"feed","value":1.5})",
       "feed-override 1.5",
       {.command = CommandKind::FEED_OVERRIDE, .fraction = 1.5}},
      {"override",
       R"({"kind":"rapid","value":0})",
       "rapid-override 0",
       {.command = CommandKind::RAPID_OVERRIDE}},
      {"override",
       R"({"kind":"spindle","value":0.5})",
       "spindle-override 0.5",
       {.command = CommandKind::SPINDLE_OVERRIDE, .fraction = 0.5}},
      {"override-step",
       R"({"kind":"feed","step":-0.05})",
       "feed-override-step -0.05",
       {.command = CommandKind::FEED_OVERRIDE_STEP, .fraction = -0.05}},
      {"override-step",
       R"({"kind":"rapid","step":0.1})",
       "rapid-override-step 0.1",
       {.command = CommandKind::RAPID_OVERRIDE_STEP, .fraction = 0.1}},
      {"jog-renew",
       R"({"press":4000000000})",
       "jog-renew 4000000000",
       {.command = CommandKind::JOG_RENEW, .press = 4000000000}},
      {"parts",
       R"({"parts":4294967295})",
       "parts 4294967295",
       {.command = CommandKind::SET_PARTS, .parts = 4294967295}},
      {"tool-in-spindle",
       R"({"tool":65535})",
       "tool-in-spindle 65535",
       {.command = CommandKind::TOOL_IN_SPINDLE, .tool = 65535}},
      {"override-step",
       R"({"kind":"spindle","step":0.1})",
       "spindle-override-step 0.1",
       {.command = CommandKind::SPINDLE_OVERRIDE_STEP, .fraction = 0.1}},
  };
  return all;
}

TEST(OperatorCommands, ARouteAndAWordGiveTheSameRequest) {
  std::set<CommandKind> seen;
  for (const auto& one : cases()) {
    EXPECT_EQ(post(one.route, Json::parse(one.body)), one.request) << one.route << " " << one.body;
    EXPECT_EQ(words(one.line), one.request) << one.line;
    seen.insert(one.request.command);
  }
  EXPECT_EQ(post("mdi", {{"line", "G0 X1"}}).block, "G0 X1");
  EXPECT_EQ(request_of(*find_word("mdi"), {"G0 X1"}, five_axes), post("mdi", {{"line", "G0 X1"}}));
  seen.insert(CommandKind::MDI_LINE);
  EXPECT_EQ(seen.size(), bus::enum_size<CommandKind>()) << "a command without an example here";
}

TEST(OperatorCommands, WhatCannotBeMeantIsRefusedWithItsField) {
  const std::vector<std::tuple<const char*, const char*, const char*>> bodies = {
      {"jog", R"({"axis":"B","speed":1})", "axis"},
      {"jog", R"({"axis":5,"speed":1})", "axis"},
      {"jog", R"({"axis":-1,"speed":1})", "axis"},
      {"jog", R"({"axis":1.5,"speed":1})", "axis"},
      {"jog", R"({"axis":"XY","speed":1})", "axis"},
      {"jog", R"({"axis":"X","speed":0})", "speed"},
      {"jog", R"({"axis":"X","speed":"fast"})", "speed"},
      {"jog", R"({"axis":"X"})", "speed"},
      {"jog", R"({"axis":"X","speed":2000000})", "speed"},
      {"jog", R"({"axis":"X","speed":1,"increment":-1})", "increment"},
      {"jog", R"({"axis":"X","speed":1,"increments":1})", "increments"},
      {"jog-stop", "{}", "axis"},
      {"override", R"({"kind":"feed","value":1.51})", "value"},
      {"override", R"({"kind":"rapid","value":1.1})", "value"},
      {"override", R"({"kind":"spindle","value":0.4})", "value"},
      {"override", R"({"kind":"coolant","value":1})", "kind"},
      {"override", R"({"value":1})", "kind"},
      {"mode", R"({"mode":"auto"})", "mode"},
      {"mode", "{}", "mode"},
      {"mdi", R"({"line":"  "})", "line"},
      {"mdi", R"({"line":"G0\nM30"})", "line"},
      {"single-block", R"({"on":1})", "on"},
      {"cycle-start", R"({"mode":"AUTO"})", "mode"},
      {"start-from-line", R"({"line":0})", "line"},
      {"start-from-line", R"({"line":1.5})", "line"},
      {"axis-lock", R"({"axes":["Q"]})", "axis"},
      {"axis-lock", R"({"axes":[0,0,0,0,0,0]})", "axes"},
      {"block-skip", R"({"levels":[0]})", "levels"},
      {"block-skip", R"({"levels":[10]})", "levels"},
      {"block-skip", R"({"levels":1})", "levels"},
      {"handwheel", R"({"axis":"Z","counts":0.5,"increment":0.01})", "counts"},
      {"handwheel", R"({"axis":"Z","counts":10001,"increment":0.01})", "counts"},
      {"handwheel", R"({"axis":"Z","counts":1,"increment":0.5})", "increment"},
      {"select", R"({"program":"../x"})", "program"},
  };
  for (const auto& [route, body, field] : bodies)
    EXPECT_EQ(complaint([&, &r = route, &b = body] { post(r, Json::parse(b)); }), field)
        << route << " " << body;
  EXPECT_EQ(complaint([] { post("mdi", {{"line", std::string(257, 'G')}}); }), "line");
  EXPECT_EQ(post("mdi", {{"line", std::string(256, 'G')}}).block.size(), 256u);
  EXPECT_THROW(post("no-such-route", Json::object()), std::logic_error);
}

TEST(OperatorCommands, WordsThatCannotBeMeantAreRefused) {
  for (const char* line :
       {"jog", "jog X", "jog X fast", "jog Q 100", "jog XY 100", "jog X 0", "handwheel X 5",
        "handwheel X 1.5 0.1", "dry-run", "dry-run yes", "mode manual", "axis-lock XQ", "block-skip 1a",
        "block-skip 0", "select", "hold now", "start-from-line 0"})
    EXPECT_NE(complaint([&] { words(line); }), "accepted") << line;
  try {
    words("jog X");
  } catch (const BadField& bad) {
    EXPECT_THAT(bad.what(), HasSubstr("SPEED is missing: jog AXIS SPEED [DISTANCE]"));
  }
}

TEST(OperatorCommands, OnlyThoseWithAxesNeedTheChannelsLetters) {
  std::set<std::string_view> named;
  for (const auto& row : channel_commands())
    if (names_axes(row)) named.insert(row.word);
  EXPECT_EQ(named, (std::set<std::string_view>{"jog", "jog-stop", "reference", "handwheel", "axis-lock"}));
}

TEST(OperatorCommands, ARequestOfAnyClientIsHeldAgainstTheLimits) {
  EXPECT_EQ(outside_limits({.command = CommandKind::FEED_OVERRIDE, .fraction = 1.5}), "");
  EXPECT_EQ(outside_limits({.command = CommandKind::FEED_OVERRIDE, .fraction = 1.6}),
            "value 1.6 must be from 0 to 1.5");
  EXPECT_NE(outside_limits({.command = CommandKind::FEED_OVERRIDE, .fraction = std::nan("")}), "");
  EXPECT_EQ(outside_limits({.command = CommandKind::CYCLE_START, .fraction = 7}), "") << "not its field";
  EXPECT_NE(outside_limits({.command = CommandKind::HANDWHEEL, .increment = 0.5, .counts = 1}), "");
  EXPECT_NE(outside_limits({.command = CommandKind::HANDWHEEL, .increment = 0.1, .counts = -10001}), "");
  EXPECT_NE(outside_limits({.command = CommandKind::JOG_AXIS, .speed = 0}), "");
  EXPECT_NE(outside_limits({.command = CommandKind::JOG_AXIS, .speed = 1, .increment = std::nan("")}), "");
  EXPECT_NE(outside_limits({.command = CommandKind::START_FROM_LINE, .line = 0}), "");
}

TEST(OperatorCommands, AnOverrideWithinItsLimitsIsAccepted) {
  const auto refusal = [](CommandKind kind, double fraction) {
    return outside_limits({.command = kind, .fraction = fraction});
  };
  for (const auto& [kind, limits] : {std::pair{CommandKind::FEED_OVERRIDE, feed_override},
                                     std::pair{CommandKind::RAPID_OVERRIDE, rapid_override},
                                     std::pair{CommandKind::SPINDLE_OVERRIDE, spindle_override}}) {
    EXPECT_EQ(refusal(kind, limits.clamp(-1)), "");
    EXPECT_EQ(refusal(kind, limits.clamp(9)), "");
    EXPECT_NE(refusal(kind, limits.clamp(-1) - 0.01), "");
    EXPECT_NE(refusal(kind, limits.clamp(9) + 0.01), "");
  }
}

TEST(OperatorCommands, NamesThatCouldLeaveTheStoreAreRefused) {
  EXPECT_NO_THROW(check_program_name("PART 1.NC"));
  EXPECT_NO_THROW(check_program_name(std::string(64, 'a')));
  for (const std::string bad : {"", "..", ".hidden", "a/b", "a\\b", "a\nb"})
    EXPECT_THROW(check_program_name(bad), BadField) << bad;
  EXPECT_THROW(check_program_name(std::string(65, 'a')), BadField);
}

}  // namespace
}  // namespace trunnion::commands
