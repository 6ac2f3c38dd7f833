// SPDX-License-Identifier: Apache-2.0
// Recordings of a machine in use verify every service: whatever the machine has done before they start.
#include "recorded_machine.hpp"
#include "verification/alignment.hpp"

namespace trunnion::integration {
namespace {

struct Case {
  std::string machine;
  Time time;
  std::string vendor;
};

std::vector<Case> cases() {
  std::vector<Case> all{{"ac-table", Time::virtual_, "cyclonedds"}};
  // The whole matrix: `make recordings`.
  if (getenv("TRUNNION_ALL_RECORDINGS") == nullptr) return all;
  all.push_back({"ac-table", Time::real, "cyclonedds"});
  for (const auto* machine : {"ac-table", "ac-head", "b-head-c-table", "bc-table", "cb-head", "four-axis",
                              "gantry-cb-head", "nutating-b-head-c-table", "two-channel"})
    for (const auto* vendor : {"fastdds", "mixed"}) all.push_back({machine, Time::virtual_, vendor});
  return all;
}

class Recording : public testing::TestWithParam<Case> {
 protected:
  RecordedMachine machine_{GetParam().machine, GetParam().time, GetParam().vendor};
};

TEST_P(Recording, OfANewMachine) {
  machine_.record("new.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("new.mcap");
  EXPECT_GT(machine_.cycles("channel"), 100u);
}

TEST_P(Recording, OfASecondRunInOneLife) {
  machine_.run_programs();
  machine_.record("second.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("second.mcap");
  EXPECT_GT(machine_.cycles("channel"), 100u);
}

TEST_P(Recording, OfThreeRunsOfWhichTheLastTwoAreTheSameFromTheirStarts) {
  machine_.record("runs.mcap");
  for (int i = 0; i < 3; ++i) machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("runs.mcap");
  // Two channels start at different moments; the first run starts at another position.
  if (GetParam().time == Time::real || GetParam().machine == "two-channel") return;
  const auto recording = verification::load_recording(machine_.file("runs.mcap"));
  verification::DiffOptions options;
  options.topics = {"path_batch",   "kinematics_batch",  "compensation_batch",
                    "gantry_batch", "auxiliary_request", "auxiliary_done"};
  const auto d = verification::difference(verification::aligned(recording, 0, 2),
                                          verification::aligned(recording, 0, 3), options);
  EXPECT_TRUE(d.equal()) << text_of(d, "second", "third");
  EXPECT_GT(d.cycles, 400u);
}

// Saved when the emergency stop is pressed; in the seconds before are a whole run and several requests for
// states.
TEST_P(Recording, OfAFlightRecorder) {
  machine_.run_programs();
  machine_.record("flight.mcap", {"--last", "4", "--after", "0.3"});
  for (int i = 0; i < 3; ++i) {
    machine_.cluster().until([] { return false; }, 2.5);
    machine_.run_programs();
  }
  machine_.cluster().client().panel(idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
  machine_.cluster().until([] { return false; }, 1);
  machine_.stop_recording();
  machine_.expect_verified("flight-0001.mcap");
}

TEST_P(Recording, AfterAndDuringChangesOfParametersAndOffsets) {
  machine_.run_programs();
  machine_.change_values();
  machine_.record("changed.mcap");
  machine_.run_programs();
  machine_.change_values();
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("changed.mcap");
}

TEST_P(Recording, AfterDownAndUpOnKeptState) {
  machine_.run_programs();
  machine_.change_values();
  machine_.down();
  machine_.up();
  machine_.record("again.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("again.mcap");
}

// A counter of milliseconds passes 2^31 after 25 days and 2^32 after 50; 30 days are in between.
TEST_P(Recording, OfAMachineWhoseCountersPassThirtyOneAndThirtyTwoBits) {
  machine_.run_programs();
  machine_.down();
  machine_.up();
  machine_.record("early.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  const std::set<std::string> topics{"path_batch", "kinematics_batch", "compensation_batch", "gantry_batch"};
  verification::DiffOptions options;
  options.topics = topics;
  const auto early = verification::load_recording(machine_.file("early.mcap"));
  for (const int bits : {31, 32}) {
    SCOPED_TRACE("2^" + std::to_string(bits));
    const auto edge = std::uint64_t{1} << bits;
    machine_.down();
    machine_.set_counters(edge - 300, edge - 500);
    machine_.up();
    const auto name = "late" + std::to_string(bits) + ".mcap";
    machine_.record(name);
    machine_.run_programs();
    EXPECT_LT(machine_.cluster().feedback.first, edge + 100000);
    EXPECT_GT(machine_.cluster().feedback.first, edge);
    EXPECT_GT(machine_.cluster().feedback.tick, edge);
    machine_.stop_recording();
    machine_.expect_verified(name);
    EXPECT_GT(machine_.cycles("channel"), 300u);
    if (GetParam().machine == "two-channel" || GetParam().time == Time::real) continue;
    const auto late = verification::load_recording(machine_.file(name));
    const auto d = verification::difference(verification::aligned(early, 0, 1),
                                            verification::aligned(late, 0, 1), options);
    EXPECT_TRUE(d.equal()) << text_of(d, "early", "late");
    EXPECT_GT(d.cycles, 300u);
    for (const auto* service : {"kinematics", "channel", "drive", "plc"}) machine_.kill_service(service);
    EXPECT_EQ(machine_.cluster().state(), RunState::IDLE) << "no program was under way";
    machine_.run_programs();
  }
}

TEST_P(Recording, OfAMachineThatOnlyIdledBefore) {
  machine_.cluster().until([] { return false; }, 1);
  machine_.record("idled.mcap");
  machine_.cluster().until([] { return false; }, 1);
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("idled.mcap");
}

TEST_P(Recording, ThatStartsInMidMotion) {
  machine_.run_programs();
  machine_.start_programs();
  ASSERT_TRUE(machine_.cluster().until([&] { return machine_.cluster().feedback.count > 0; }));
  machine_.record("moving.mcap");
  ASSERT_TRUE(machine_.await_end());
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("moving.mcap");
}

TEST_P(Recording, InParts) {
  machine_.record("parts.mcap", {"--part-time", "1"});
  for (int i = 0; i < 4; ++i) {
    machine_.run_programs();
    machine_.cluster().until([] { return false; }, 0.6);
  }
  machine_.stop_recording();
  machine_.expect_verified("parts-0001.mcap");
  // In real time the program takes longer than a part, and a channel gives its state at rest.
  const bool real = GetParam().time == Time::real;
  machine_.expect_verified("parts-0002.mcap",
                           real ? std::set<std::string>{"channel"} : std::set<std::string>{});
}

TEST_P(Recording, AfterEachServiceWasKilled) {
  machine_.run_programs();
  for (const auto* service : {"drive", "plc", "channel", "parameters", "program", "kinematics"})
    machine_.kill_service(service);
  machine_.record("killed.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("killed.mcap");
}

TEST_P(Recording, AfterServicesWereSwapped) {
  machine_.run_programs();
  for (const auto* service : {"plc", "drive", "parameters", "program", "kinematics", "channel"})
    machine_.swap(service);
  // A channel that is restarted behind a program which ended with functions is interrupted there.
  machine_.reset();
  machine_.record("swapped.mcap");
  machine_.run_programs();
  machine_.stop_recording();
  machine_.expect_verified("swapped.mcap");
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  auto name =
      info.param.machine + (info.param.time == Time::real ? "_real_" : "_virtual_") + info.param.vendor;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Machines, Recording, testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace trunnion::integration
