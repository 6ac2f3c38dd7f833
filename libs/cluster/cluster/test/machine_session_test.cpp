// SPDX-License-Identifier: Apache-2.0
// What a session asks of a channel and of the program store, in which order, and what it gives back.
#include "cluster/machine_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "testing_support/refusal.hpp"

namespace trunnion::cluster {
namespace {

using idl::channel::Mode;
using idl::channel::RunState;
using idl::program::ProgramReply;
using idl::program::ProgramRequest;
using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::refusal_of;

constexpr std::uint32_t session_domain = 65;
constexpr const char* temporary_program = "servo-test.tmp.nc";

struct Behaviour {
  int refusals = 0;                  ///< of a selection: the list with the program has not come
  int old_texts = 0;                 ///< then: the list has the text of before
  RunState at_end = RunState::IDLE;  ///< of a started program
  RunState at_first = RunState::IDLE;
  bool homed = true;
};

// Channel 0, which has the program part.nc in JOG, and the program store.
class AnsweringMachine {
 public:
  explicit AnsweringMachine(Behaviour behaviour = {}) : behaviour_(behaviour) {
    state_.state = behaviour.at_first;
    state_.homed = behaviour.homed;
    state_.mode = Mode::JOG;
    state_.program = "part.nc";
    states_.write(state_);
    thread_ = std::thread([this] { answer(); });
  }
  ~AnsweringMachine() {
    over_ = true;
    thread_.join();
  }
  /// What was accepted.
  std::vector<std::string> asked() {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

 private:
  void answer() {
    while (!over_) {
      for (ChannelRequest request; channel_.take(request);) channel_.reply(request, applied(request));
      for (ProgramRequest request; programs_.take(request);) programs_.reply(request, stored(request));
      bus_.signal().wait(0.01);
    }
  }
  void note(const std::string& what) {
    const std::lock_guard lock(mutex_);
    asked_.push_back(what);
  }
  ChannelReply applied(const ChannelRequest& request) {
    ChannelReply reply;
    reply.accepted = true;
    switch (request.command) {
      case CommandKind::SET_MODE:
        state_.mode = request.mode;
        note(request.mode == Mode::AUTO ? "AUTO" : "JOG");
        break;
      case CommandKind::SELECT_PROGRAM:
        if (behaviour_.refusals > 0) {
          --behaviour_.refusals;
          reply.accepted = false;
          reply.reason = "no program " + request.program;
          break;
        }
        state_.program = request.program;
        state_.program_revision = behaviour_.old_texts > 0 ? revision_ - 1 : revision_;
        behaviour_.old_texts = std::max(0, behaviour_.old_texts - 1);
        note("select " + request.program);
        break;
      case CommandKind::CYCLE_START:
        state_.state = behaviour_.at_end;
        note("start");
        break;
      case CommandKind::FEED_HOLD:
        note("hold");
        break;
      case CommandKind::RESET:
        note("reset");
        break;
      default:
        note("another command");
    }
    states_.write(state_);
    return reply;
  }
  ProgramReply stored(const ProgramRequest& request) {
    ProgramReply reply;
    reply.accepted = true;
    if (request.operation == idl::program::Operation::COMMIT_UPLOAD) {
      reply.entry.revision = ++revision_;
      note("store " + request.name);
    }
    if (request.operation == idl::program::Operation::REMOVE) note("remove " + request.name);
    return reply;
  }

  Behaviour behaviour_;
  bus::Bus bus_{bus::Vendor::cyclonedds, {session_domain}};
  service::RequestServer<ChannelRequest, ChannelReply> channel_{bus_, topics::channel_request,
                                                                topics::channel_reply};
  service::RequestServer<ProgramRequest, ProgramReply> programs_{bus_, topics::program_request,
                                                                 topics::program_reply};
  bus::Writer<idl::channel::ChannelState> states_ = bus_.writer(topics::channel_state);
  idl::channel::ChannelState state_;
  std::uint64_t revision_ = 7;
  std::mutex mutex_;
  std::vector<std::string> asked_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

TEST(MachineSession, AsksAgainForAProgramThatTheChannelDoesNotKnowYet) {
  AnsweringMachine machine({.refusals = 3});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession(client, 0).select("part.nc");
  EXPECT_THAT(machine.asked(), ElementsAre("AUTO", "select part.nc"));
}

TEST(MachineSession, StatesWhyAProgramIsNotSelected) {
  AnsweringMachine machine({.refusals = 1000});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  EXPECT_EQ(refusal_of([&] { session.select("other.nc"); }), "no program other.nc");
}

// The channel takes the text of before twice, then the new one.
TEST(MachineSession, ExecutesTheNewTextAndGivesTheChannelBack) {
  AnsweringMachine machine({.refusals = 2, .old_texts = 2});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  session.take();
  EXPECT_EQ(session.before().program, "part.nc");
  session.select_temporary(temporary_program, "G1 X1 F100\nM30\n");
  EXPECT_EQ(session.run([] {}, 60), MachineSession::End::idle);
  EXPECT_FALSE(session.moves());
  session.hold();
  session.end();
  session.restore();
  EXPECT_THAT(machine.asked(), ElementsAre("AUTO", "store servo-test.tmp.nc", "select servo-test.tmp.nc",
                                           "select servo-test.tmp.nc", "select servo-test.tmp.nc", "start",
                                           "select part.nc", "JOG", "remove servo-test.tmp.nc"));
}

TEST(MachineSession, StoresATextOnce) {
  AnsweringMachine machine;
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  for (const char* text : {"M30\n", "M30\n", "M2\n"}) session.select_temporary(temporary_program, text);
  EXPECT_THAT(machine.asked(), ElementsAre("AUTO", "store servo-test.tmp.nc", "select servo-test.tmp.nc",
                                           "AUTO", "select servo-test.tmp.nc", "AUTO",
                                           "store servo-test.tmp.nc", "select servo-test.tmp.nc"));
}

TEST(MachineSession, GivesNothingBackThatItHasNotTaken) {
  AnsweringMachine machine;
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  session.take();
  session.restore();
  EXPECT_THAT(machine.asked(), ElementsAre());
}

TEST(MachineSession, EndsAMotionThatWasHeld) {
  AnsweringMachine machine({.at_end = RunState::HELD});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  EXPECT_EQ(session.run([] {}, 60), MachineSession::End::stopped);
  EXPECT_TRUE(session.moves());
  session.hold();
  session.end();
  EXPECT_THAT(machine.asked(), ElementsAre("start", "hold", "reset"));
}

TEST(MachineSession, DoesNotWaitLongerThanItMay) {
  AnsweringMachine machine({.at_end = RunState::RUNNING});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  EXPECT_EQ(session.run([] {}, 0), MachineSession::End::overdue);
  EXPECT_TRUE(session.moves());
}

TEST(MachineSession, LeavesAMotionToWhoInterruptsTheWait) {
  AnsweringMachine machine({.at_end = RunState::RUNNING});
  Client client(bus::NetworkSettings{session_domain});
  MachineSession session(client, 0);
  EXPECT_EQ(refusal_of([&] { session.run([] { throw std::runtime_error("interrupted"); }, 60); }),
            "interrupted");
  EXPECT_TRUE(session.moves());
}

TEST(MachineSession, RefusesAChannelThatIsBusyOrHasNoReference) {
  for (const auto& [behaviour, reason] :
       {std::pair(Behaviour{.at_first = RunState::RUNNING}, "channel 0 is busy"),
        std::pair(Behaviour{.homed = false}, "select mode REF")}) {
    AnsweringMachine machine(behaviour);
    Client client(bus::NetworkSettings{session_domain});
    MachineSession session(client, 0);
    EXPECT_THAT(refusal_of([&] { session.take(); }), HasSubstr(reason));
  }
}

}  // namespace
}  // namespace trunnion::cluster
