// SPDX-License-Identifier: Apache-2.0
// A fault in each phase of a measurement of the kinematics: the motion stops, the alarm names cause and
// poses, no parameter changes, and the measurement goes on after its complete poses.
#include <set>

#include "measurement_rig.hpp"

namespace trunnion::integration {
namespace {

using Act = std::function<void(MeasurementRig&)>;

struct Fault {
  std::string name;
  std::string probe;  ///< of truth.yaml, in addition
  Phase phase = Phase::MEASURING;
  unsigned complete = 0;  ///< poses, when `act` comes
  Act act;                ///< nothing: the probe is the fault
  std::string cause;      ///< in the error and the alarm
  std::string also = {};  ///< or this
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

void press_stop(MeasurementRig& rig) {
  rig.cluster->client().panel(idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
}
void abort(MeasurementRig& rig) {
  const auto reply = rig.order(Operation::ABORT);
  EXPECT_TRUE(reply.accepted) << reply.reason;
}
Act killed(const std::string& service) {
  return [service](MeasurementRig& rig) { rig.kill(service); };
}

struct MeasurementFaults : ::testing::TestWithParam<Fault> {
  MeasurementRig rig;
};

// Where the axes are at rest in two states that follow each other.
bool rests(MeasurementRig& rig) {
  const auto before = rig.cluster->channels[0].machine;
  const auto count = rig.cluster->state_count[0];
  rig.until([&] { return rig.cluster->state_count[0] > count + 2; }, 2);
  return before == rig.cluster->channels[0].machine;
}

TEST_P(MeasurementFaults, StopWriteNothingAndGoOn) {
  const auto& fault = GetParam();
  rig.start(std::string(MeasurementRig::good_probe) + fault.probe);
  const auto reply = rig.measure();
  ASSERT_TRUE(reply.accepted) << reply.reason;
  if (fault.act) {
    ASSERT_TRUE(rig.until([&] {
      return rig.state.phase == fault.phase && rig.state.complete >= fault.complete;
    })) << rig.told();
    fault.act(rig);
  }
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  const auto names = [&](const std::string& text) {
    return text.find(fault.cause) != std::string::npos ||
           (!fault.also.empty() && text.find(fault.also) != std::string::npos);
  };
  EXPECT_TRUE(names(rig.state.error)) << rig.told();
  const auto kept = std::to_string(rig.state.complete) + " of 5 poses are complete";
  EXPECT_NE(rig.state.error.find("; nothing written, " + kept), std::string::npos) << rig.state.error;
  EXPECT_TRUE(rig.until([&] { return rig.cluster->has_alarm(180, kept); })) << rig.told();
  EXPECT_TRUE(rests(rig)) << rig.told();
  EXPECT_FALSE(rig.changed());
  EXPECT_TRUE(rig.state.may_continue);
  EXPECT_FALSE(rig.state.may_confirm);

  // A probe that is at fault is replaced while the control is off.
  const auto complete = rig.state.complete;
  if (!fault.probe.empty()) {
    rig.stop();
    rig.start(MeasurementRig::good_probe);
    EXPECT_EQ(rig.state.phase, Phase::INTERRUPTED);
    EXPECT_EQ(rig.state.complete, complete) << "kept over the end of every process";
  }
  ASSERT_TRUE(rig.clear_machine()) << rig.told();
  // The service may hear of the end of the line that cleared the machine a moment after this test.
  MeasurementReply again;
  rig.until([&] {
    again = rig.order(Operation::CONTINUE);
    return again.reason.find("is RUNNING with a program") == std::string::npos;
  });
  ASSERT_TRUE(again.accepted) << again.reason;
  ASSERT_TRUE(rig.until([&] {
    return rig.state.phase == Phase::WAITING || rig.state.phase == Phase::INTERRUPTED;
  })) << rig.told();
  ASSERT_EQ(rig.state.phase, Phase::WAITING) << rig.told();
  EXPECT_EQ(rig.state.complete, MeasurementRig::poses);
  EXPECT_FALSE(rig.changed());
  const auto confirmed = rig.order(Operation::CONFIRM);
  ASSERT_TRUE(confirmed.accepted) << confirmed.reason;
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED && rig.changed(); })) << rig.told();
  EXPECT_TRUE(rig.state.written);
  // The offset of A is that of its axis less that of C, 120 + 90 um; the inclinations of 36 urad over some
  // 82 mm go into the offsets (examples/calibration/truth.yaml).
  EXPECT_NEAR(rig.pending(40433), 0.21, 0.005);
  EXPECT_NEAR(rig.pending(40435), 0.05, 0.005);
  EXPECT_NEAR(rig.pending(40436), -0.09, 0.005);
}

// Each touch is two contacts. Five touches check the repeatability, then each pose has twenty contacts.
const std::string no_contact = "no contact";
std::vector<Fault> all_faults() {
  using enum Phase;
  const std::string early = ", early_mm: 0.5, early_from_touch: ", lost = ", no_signal_from_touch: ",
                    stuck = ", stuck_from_touch: ";
  const std::string ended = "the measurement process has ended", interrupted = "alarm 144",
                    service = "alarm 100";
  const std::string stop = "mergency stop";
  return {
      {"planning_abort", "", PLANNING, 0, abort, "plan: aborted"},
      {"planning_emergency_stop", "", PLANNING, 0, press_stop, stop},
      {"planning_kill_measurement", "", PLANNING, 0, killed("measurement"), "plan: " + ended},
      {"repeatability_no_signal_first_touch", lost + "1", MEASURING, 0, {}, no_contact},
      {"repeatability_no_signal_second_touch", lost + "4", MEASURING, 0, {}, no_contact},
      {"repeatability_early_signal", early + "5", MEASURING, 0, {}, "5 touches of one point differ"},
      {"repeatability_stuck", stuck + "3", MEASURING, 0, {}, "repeatability of the probe: alarm"},
      {"repeatability_abort", "", REPEATABILITY, 0, abort, "repeatability of the probe: aborted"},
      {"repeatability_emergency_stop", "", REPEATABILITY, 0, press_stop, stop},
      {"repeatability_kill_measurement", "", REPEATABILITY, 0, killed("measurement"), ended},
      {"repeatability_kill_channel", "", REPEATABILITY, 0, killed("channel"), service, interrupted},
      {"repeatability_kill_drive", "", REPEATABILITY, 0, killed("drive"), service, interrupted},
      {"first_touch_no_signal", lost + "31", MEASURING, 0, {}, "pose A-60 C0: alarm 1501"},
      {"second_touch_no_signal", lost + "32", MEASURING, 0, {}, "pose A-60 C0: alarm 1501"},
      {"first_touch_stuck", stuck + "31", MEASURING, 0, {}, "pose A-60 C0: alarm"},
      {"second_touch_stuck", stuck + "32", MEASURING, 0, {}, "pose A-60 C0: alarm"},
      {"touches_early",
       early + "31",
       MEASURING,
       0,
       {},
       "pose A-60 C0: measured diameter of the sphere 25.99"},
      {"between_poses_abort", "", MEASURING, 1, abort, "aborted"},
      {"between_poses_emergency_stop", "", MEASURING, 2, press_stop, stop},
      {"between_poses_kill_measurement", "", MEASURING, 1, killed("measurement"), ended},
      {"between_poses_kill_channel", "", MEASURING, 1, killed("channel"), service, interrupted},
      {"between_poses_kill_drive", "", MEASURING, 3, killed("drive"), service, interrupted},
      {"retracting_emergency_stop", "", RETRACTING, 5, press_stop, stop},
      {"retracting_kill_measurement", "", RETRACTING, 5, killed("measurement"), ended},
  };
}

// Each takes some 20 s, so a sample runs always: every phase, every cause and every process once. The rest
// runs in `make faults`.
bool in_sample(const Fault& fault) {
  static const std::set<std::string> names{
      "planning_emergency_stop",    "repeatability_no_signal_second_touch",
      "repeatability_early_signal", "repeatability_kill_channel",
      "second_touch_stuck",         "touches_early",
      "between_poses_abort",        "between_poses_kill_drive",
      "retracting_kill_measurement"};
  return names.contains(fault.name);
}
std::vector<Fault> faults(bool sample) {
  auto chosen = all_faults();
  std::erase_if(chosen, [&](const Fault& fault) { return in_sample(fault) != sample; });
  return chosen;
}

constexpr auto name_of_fault = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Sample, MeasurementFaults, ::testing::ValuesIn(faults(true)), name_of_fault);
INSTANTIATE_TEST_SUITE_P(DISABLED_Rest, MeasurementFaults, ::testing::ValuesIn(faults(false)), name_of_fault);

TEST(MeasurementFaultSample, NamesFaultsThatExist) { EXPECT_EQ(faults(true).size(), 9u); }

struct MeasurementResults : ::testing::Test {
  MeasurementRig rig;

  void measure_all(const std::string& inputs = MeasurementRig::inputs) {
    rig.start(MeasurementRig::good_probe);
    const auto reply = rig.measure(inputs);
    ASSERT_TRUE(reply.accepted) << reply.reason;
    ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::WAITING; })) << rig.told();
  }
};

TEST_F(MeasurementResults, SurviveKillAndEmergencyStopBeforeTheConfirmation) {
  measure_all();
  rig.kill("measurement");
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::WAITING; })) << rig.told();
  press_stop(rig);
  EXPECT_TRUE(rig.until([&] { return rig.cluster->has_alarm(130); })) << rig.told();
  EXPECT_FALSE(rig.changed());
  EXPECT_EQ(rig.state.phase, Phase::WAITING);
  const auto reply = rig.order(Operation::CONFIRM);
  ASSERT_TRUE(reply.accepted) << reply.reason;
  EXPECT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED && rig.changed(); })) << rig.told();
}

TEST_F(MeasurementResults, AreWrittenWholeOrNotAtAllWhenTheServiceIsKilledWhileItWrites) {
  measure_all();
  // The parameters service does not answer while it is suspended, so the kill comes before its answer.
  const auto parameters = rig.cluster->service("parameters")->pid;
  ::kill(parameters, SIGSTOP);
  const auto reply = rig.order(Operation::CONFIRM);
  EXPECT_TRUE(reply.accepted) << reply.reason;
  EXPECT_TRUE(rig.until([&] { return rig.state.phase == Phase::WRITING; })) << rig.told();
  const auto measurement = rig.cluster->service("measurement")->pid;
  ::kill(measurement, SIGKILL);
  ::kill(parameters, SIGCONT);
  ASSERT_TRUE(rig.until([&] {
    return rig.cluster->ready() && rig.cluster->service("measurement")->pid != measurement &&
           (rig.state.phase == Phase::WAITING || rig.state.phase == Phase::FINISHED);
  })) << rig.told();
  if (rig.state.phase == Phase::WAITING) {
    const auto again = rig.order(Operation::CONFIRM);
    ASSERT_TRUE(again.accepted) << again.reason;
  }
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED; })) << rig.told();
  EXPECT_TRUE(rig.state.written);
  ASSERT_TRUE(rig.until([&] { return rig.changed(); })) << rig.told();
  for (const auto& change : rig.result().changes) EXPECT_EQ(rig.pending(change.number), change.after);
}

TEST_F(MeasurementResults, BeyondAToleranceThatNeedsAResetCannotBeConfirmed) {
  measure_all(std::string(MeasurementRig::inputs) + "vector_tolerance_mm: 0.1\ntolerance_alarm: reset\n");
  EXPECT_TRUE(rig.until([&] { return rig.cluster->has_alarm(181, "the tolerance is 0.1000 mm"); }))
      << rig.told();
  EXPECT_FALSE(rig.state.may_confirm);
  EXPECT_FALSE(rig.order(Operation::CONFIRM).accepted);
  EXPECT_TRUE(rig.order(Operation::DISCARD).accepted);
  EXPECT_TRUE(rig.until([&] { return rig.state.phase == Phase::NOTHING; }));
  EXPECT_FALSE(rig.cluster->has_alarm(181));
  EXPECT_FALSE(rig.changed());
}

TEST_F(MeasurementResults, OfAMeasurementThatOnlyMeasuresWriteNothing) {
  rig.start(MeasurementRig::good_probe);
  MeasurementRequest request;
  request.operation = Operation::START;
  request.inputs = MeasurementRig::inputs;
  request.mode = idl::measurement::Mode::MEASURE_ONLY;
  ASSERT_TRUE(rig.order(request).accepted);
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED; })) << rig.told();
  EXPECT_FALSE(rig.state.written);
  EXPECT_TRUE(rig.result().valid);
  EXPECT_FALSE(rig.order(Operation::CONFIRM).accepted);
  EXPECT_FALSE(rig.changed());
  // The touches are kept: the correction needs no motion.
  const auto cycle = rig.cluster->channels[0].cycle;
  request.mode = idl::measurement::Mode::ONLY_CORRECT;
  const auto reply = rig.order(request);
  ASSERT_TRUE(reply.accepted) << reply.reason;
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::WAITING; })) << rig.told();
  EXPECT_EQ(rig.cluster->channels[0].cycle, cycle);
}

TEST_F(MeasurementResults, AreRefusedWhereThereIsNoMachineToMeasure) {
  rig.start(MeasurementRig::good_probe);
  const auto refused = [&](const std::string& inputs, const std::string& reason) {
    const auto reply = rig.measure(inputs);
    EXPECT_FALSE(reply.accepted);
    EXPECT_NE(reply.reason.find(reason), std::string::npos) << reply.reason;
    EXPECT_EQ(rig.state.phase, Phase::NOTHING);
  };
  refused("mode: [", "inputs:1:");
  refused("sphere: {centre_mm: [60, 40, 400]}\n", "is not within its travel");
  refused("axes: {A: {start_deg: -60, end_deg: 60, points: 2}, C: {}}\n", "3 .. 12");
  refused("measuring_path_mm: 3\n", "measuring_path_mm 3 mm is above 2.36 mm");
  refused("axes: {A: {start_deg: -60, end_deg: 60, points: 3, normalization: 5}, C: {}}\n",
          "the normalizations do not fix the free components");
  press_stop(rig);
  ASSERT_TRUE(rig.until([&] { return rig.cluster->has_alarm(130); }));
  // The service may hear of the alarm later than this client. What it has begun by then it interrupts itself.
  if (rig.measure(MeasurementRig::inputs).accepted) {
    ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
    ASSERT_TRUE(rig.order(Operation::DISCARD).accepted);
    ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::NOTHING; })) << rig.told();
  }
  refused(MeasurementRig::inputs, "alarm 130");
}

}  // namespace
}  // namespace trunnion::integration
