// SPDX-License-Identifier: Apache-2.0
// The state machine by itself: every transition from every state, allowed or not.
#include "channel_states.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace trunnion::channel {
namespace {

using Change = std::function<void(ChannelStates&)>;

SuspendedProgram left() { return {}; }

/// One of each state.
std::map<std::string, Change> all_states() {
  const Change program = [](auto& s) { s.begin(Activity::program); };
  const Change held = [=](auto& s) { program(s), s.pause(); };
  return {
      {"Idle", [](auto&) {}},
      {"Running program", program},
      {"Running MDI", [](auto& s) { s.begin(Activity::mdi); }},
      {"Running jog", [](auto& s) { s.begin(Activity::jog); }},
      {"Preparing", [=](auto& s) { program(s), s.prepare({}, false); }},
      {"Waiting program", [=](auto& s) { program(s), s.wait(); }},
      {"Holding program", [=](auto& s) { program(s), s.hold(); }},
      {"Held program", held},
      {"Held preparing", [=](auto& s) { program(s), s.prepare({}, true); }},
      {"Interrupted program", [](auto& s) { s.begin_interrupted(); }},
      {"Interrupted jog", [](auto& s) { s.begin(Activity::jog), s.interrupt(false); }},
      {"Suspended", [=](auto& s) { held(s), s.suspend(left()); }},
  };
}

struct Transition {
  const char* name;
  Change change;
  std::map<std::string, std::string> allowed;  ///< state before -> state after; from all others it throws
};

TEST(ChannelStates, EveryTransitionIsAllowedFromTheStatesItsCommentNamesAndThrowsFromTheOthers) {
  const std::vector<Transition> transitions = {
      {"begin program",
       [](auto& s) { s.begin(Activity::program); },
       {{"Idle", "Running program"},
        {"Suspended", "Running program (program suspended)"},
        {"Interrupted program", "Running program"},
        {"Interrupted jog", "Running program"}}},
      {"begin jog",
       [](auto& s) { s.begin(Activity::jog); },
       {{"Idle", "Running jog"}, {"Suspended", "Running jog (program suspended)"}}},
      {"begin interrupted", [](auto& s) { s.begin_interrupted(); }, {{"Idle", "Interrupted program"}}},
      {"prepare", [](auto& s) { s.prepare({}, false); }, {{"Running program", "Preparing"}}},
      {"begin return", [](auto& s) { s.begin_return({}); }, {{"Suspended", "Preparing (program suspended)"}}},
      {"end preparation", [](auto& s) { s.end_preparation(); }, {{"Preparing", "Running program"}}},
      {"wait",
       [](auto& s) { s.wait(); },
       {{"Running program", "Waiting program"},
        {"Running MDI", "Waiting MDI"},
        {"Preparing", "Waiting preparing"}}},
      {"hold",
       [](auto& s) { s.hold(); },
       {{"Running program", "Holding program"},
        {"Running MDI", "Holding MDI"},
        {"Running jog", "Holding jog"},
        {"Preparing", "Holding preparing"}}},
      {"pause",
       [](auto& s) { s.pause(); },
       {{"Running program", "Held program"},
        {"Running MDI", "Held MDI"},
        {"Running jog", "Held jog"},
        {"Preparing", "Held preparing"}}},
      {"come to rest", [](auto& s) { s.come_to_rest(); }, {{"Holding program", "Held program"}}},
      {"resume",
       [](auto& s) { s.resume(); },
       {{"Held program", "Running program"}, {"Held preparing", "Preparing"}}},
      {"resume interrupted",
       [](auto& s) { s.resume_interrupted(); },
       {{"Interrupted program", "Running program"}, {"Interrupted jog", "Running jog"}}},
      {"reset at rest",
       [](auto& s) { s.reset_at_rest(); },
       {{"Running program", "Holding program, reset"},
        {"Running MDI", "Holding MDI, reset"},
        {"Running jog", "Holding jog, reset"},
        {"Preparing", "Holding preparing, reset"},
        {"Holding program", "Holding program, reset"}}},
      {"suspend", [](auto& s) { s.suspend(left()); }, {{"Held program", "Suspended"}}},
  };
  for (const auto& [name, reach] : all_states())
    for (const auto& transition : transitions) {
      ChannelStates states;
      reach(states);
      ASSERT_EQ(states.name(), name);
      const auto after = transition.allowed.find(name);
      if (after == transition.allowed.end()) {
        EXPECT_THROW(transition.change(states), std::bad_variant_access) << transition.name << ", " << name;
        EXPECT_EQ(states.name(), name) << transition.name << " must change nothing when it throws";
      } else {
        transition.change(states);
        EXPECT_EQ(states.name(), after->second) << transition.name << ", " << name;
      }
    }
}

TEST(ChannelStates, AnInterruptionRemembersWhatItInterruptedAndHow) {
  for (const auto& [name, reach] : all_states()) {
    ChannelStates states;
    reach(states);
    const auto activity = states.activity();
    states.interrupt(false);
    EXPECT_EQ(states.in<Interrupted>(), activity.has_value()) << name;
    EXPECT_EQ(states.activity(), activity) << name;
  }
  ChannelStates states;
  states.begin(Activity::program);
  states.reset_at_rest();
  states.interrupt(false);
  EXPECT_TRUE(states.abandoned());
  states.resume_interrupted();
  EXPECT_EQ(states.name(), "Holding program, reset") << "the remaining path was dropped";
}

TEST(ChannelStates, DrivesThatWereOffNeedAResetAlsoUnderAProgramThatWasLeft) {
  ChannelStates states;
  states.begin(Activity::program);
  states.pause();
  states.suspend(left());
  states.interrupt(true);
  EXPECT_TRUE(states.in<Suspended>());
  EXPECT_TRUE(states.needs_reset());
  states.begin(Activity::mdi);
  states.wait();
  states.end_wait(false);
  EXPECT_EQ(states.name(), "Running MDI (program suspended)") << "MDI itself continues";
  states.forget_suspended();
  states.end();
  EXPECT_FALSE(states.needs_reset());
  EXPECT_TRUE(states.in<Idle>());
}

TEST(ChannelStates, AnEndReturnsToTheSuspendedProgramOrToIdle) {
  for (const auto& [name, reach] : all_states()) {
    ChannelStates states;
    reach(states);
    states.end();
    EXPECT_EQ(states.name(), name == "Suspended" ? "Suspended" : "Idle") << name;
    EXPECT_FALSE(states.busy());
  }
}

TEST(ChannelStates, AnAnswerThatComesAfterAnInterruptionChangesNothing) {
  ChannelStates states;
  states.begin(Activity::program);
  states.wait();
  states.interrupt(true);
  states.end_wait(false);
  EXPECT_EQ(states.name(), "Interrupted program, drives off");
}

}  // namespace
}  // namespace trunnion::channel
