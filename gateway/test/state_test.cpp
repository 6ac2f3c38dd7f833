// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "bus/contract.hpp"
#include "core/cluster_state.hpp"
#include "core/merge_patch.hpp"
#include "core/state_document.hpp"
#include "testing_support/allocation_count.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

/// A random object of numbers, arrays and objects, without nulls.
Json random_object(std::mt19937& random, int depth) {
  auto json = Json::object();
  const auto members = random() % 5;
  for (unsigned i = 0; i < members; ++i) {
    const std::string name(1, static_cast<char>('a' + random() % 6));
    switch (random() % (depth > 0 ? 3 : 2)) {
      case 0:
        json[name] = random() % 3;
        break;
      case 1:
        json[name] = Json::array({random() % 2, "x"});
        break;
      default:
        json[name] = random_object(random, depth - 1);
    }
  }
  return json;
}

TEST(MergePatch, AppliedToTheOldStateItGivesTheNewOne) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const auto from = random_object(random, 3), to = random_object(random, 3);
    const auto patch = merge_patch(from, to);
    // The order of members is no part of a JSON value, so both sides are compared without one.
    auto patched = nlohmann::json(from);
    patched.merge_patch(nlohmann::json(patch));
    ASSERT_EQ(patched, nlohmann::json(to)) << from << " -> " << to << " by " << patch;
    ASSERT_EQ(merge_patch(to, to), Json::object());
  }
}

TEST(Trace, KeepsFewRowsEvenlySpreadHoweverManyCome) {
  Trace trace;
  for (std::uint64_t cycle = 100; cycle < 100 + 5000; ++cycle) {
    const double row = static_cast<double>(cycle);
    trace.add(cycle, {&row, 1});
  }
  const auto& rows = trace.rows();
  ASSERT_GE(rows.size(), Trace::most_rows / 2);
  ASSERT_LE(rows.size(), Trace::most_rows);
  EXPECT_EQ(trace.first(), 100u);
  EXPECT_EQ(rows.front()[0], 100);
  for (std::size_t i = 2; i < rows.size(); ++i)
    EXPECT_EQ(rows[i][0] - rows[i - 1][0], rows[1][0] - rows[0][0]);
  ASSERT_EQ(trace.cycles().size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(static_cast<double>(trace.cycles()[i]), rows[i][0]) << "every row has its cycle";
}

TEST(Trace, AMachineThatStandsIsOneRow) {
  Trace trace;
  const double here = 4.5, there = 5;
  for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) trace.add(cycle, {&here, 1});
  EXPECT_EQ(trace.rows().size(), 1u);
  trace.add(1000, {&there, 1});
  EXPECT_EQ(trace.rows().size(), 2u);
  EXPECT_EQ(trace.cycles(), (std::vector<std::uint64_t>{0, 1000}));
}

idl::service::Alarm alarm(std::uint32_t instance, std::uint32_t number, bool active = true) {
  idl::service::Alarm a{};
  a.instance = instance;
  a.number = number;
  a.active = active;
  a.text = "Something";
  return a;
}

idl::service::ServiceState beat(std::uint32_t instance, std::int32_t pid) {
  idl::service::ServiceState state{};
  state.instance = instance;
  state.service = "gantry";
  state.pid = pid;
  state.lifecycle = idl::service::Lifecycle::ACTIVE;
  return state;
}

TEST(StateDocument, AnAlarmKeepsTheTimeItWasFirstSeenAndGoesWhenItIsOver) {
  StateDocument document;
  document.apply(alarm(3, 110), 0, "2026-01-01T00:00:00Z");
  document.apply(alarm(3, 110), 1, "2026-01-01T00:00:01Z");
  auto json = document.document(1);
  ASSERT_TRUE(json["alarms"].contains("3/110/0"));
  EXPECT_EQ(json["alarms"]["3/110/0"]["since"], "2026-01-01T00:00:00Z");
  document.apply(alarm(3, 110, false), 2, "");
  EXPECT_TRUE(document.document(2)["alarms"].empty());
}

TEST(StateDocument, TheClusterHasTheTitleOfTheMachine) {
  StateDocument document;
  document.set_title("AC trunnion machine");
  document.apply(idl::service::Cluster{});
  EXPECT_EQ(document.document(1)["cluster"]["title"], "AC trunnion machine");
}

TEST(StateDocument, AServiceIsSilentWithoutHeartbeatAndAbsentWhenExpectedButNeverHeard) {
  StateDocument document;
  document.apply(beat(4, 100), 10.0);
  idl::service::Cluster cluster{};
  idl::service::ClusterService expected{};
  expected.instance = 9;
  expected.service = "plc";
  expected.restarts = 2;
  cluster.services.push_back(expected);
  auto other = expected;
  other.instance = 4;
  cluster.services.push_back(other);
  document.apply(cluster);
  auto json = document.document(10.0 + heartbeat_timeout / 2)["services"];
  EXPECT_EQ(json["4"]["alive"], true);
  EXPECT_EQ(json["4"]["lifecycle"], "ACTIVE");
  EXPECT_EQ(json["9"]["alive"], false);
  EXPECT_EQ(json["9"]["lifecycle"], "ABSENT");
  EXPECT_EQ(json["9"]["service"], "plc");
  EXPECT_EQ(json["9"]["restarts"], 2);
  json = document.document(10.0 + 2 * heartbeat_timeout)["services"];
  EXPECT_EQ(json["4"]["alive"], false);
}

TEST(StateDocument, AProcessThatASwapHasReplacedIsShownUntilItIsSilent) {
  StateDocument document;
  document.apply(beat(4, 100), 10.0);
  idl::service::Cluster cluster{};
  idl::service::ClusterService successor{};
  successor.instance = 12;
  cluster.services.push_back(successor);
  document.apply(cluster);
  document.apply(beat(12, 101), 10.0);
  auto json = document.document(10.0)["services"];
  EXPECT_EQ(json["4"]["alive"], true);
  EXPECT_EQ(json["4"]["expected"], false);
  document.apply(beat(12, 101), 10.0 + 2 * heartbeat_timeout);
  json = document.document(10.0 + 2 * heartbeat_timeout)["services"];
  EXPECT_FALSE(json.contains("4"));
  EXPECT_EQ(json["12"]["alive"], true);
}

TEST(StateDocument, TheAlarmsOfADeadProcessGoWhenItsSuccessorBeats) {
  StateDocument document;
  document.apply(beat(4, 100), 10.0);
  document.apply(alarm(4, 1), 9.0, "t");
  document.apply(alarm(5, 1), 9.0, "t");
  document.apply(alarm(4, 2), 11.0, "t");  // after the last heartbeat of 100: may be the successor's
  document.apply(beat(4, 101), 11.5);
  const auto alarms = document.document(11.5)["alarms"];
  EXPECT_FALSE(alarms.contains("4/1/0"));
  EXPECT_TRUE(alarms.contains("5/1/0"));
  EXPECT_TRUE(alarms.contains("4/2/0"));
}

TEST(StateDocument, AnotherContractIsShown) {
  StateDocument document;
  idl::service::Announcement announcement{};
  announcement.instance = 1;
  announcement.service = "drive";
  announcement.contract = "theirs";
  document.apply(announcement);
  EXPECT_EQ(document.document(0)["services"]["1"]["contract_match"], false);
  document.apply(idl::service::Cluster{});
  EXPECT_EQ(document.document(2 * heartbeat_timeout)["services"]["1"]["contract_match"], false)
      << "also where the launcher does not name it, which nobody hears beat";
  announcement.contract = bus::contract_of("drive");
  document.apply(announcement);
  EXPECT_EQ(document.document(0)["services"]["1"]["contract_match"], true);
}

idl::stream::Feedback feedback() {
  idl::stream::Feedback batch{};
  batch.first = 50;
  batch.count = 2;
  batch.axis_count = 2;
  batch.commanded = {1, 10, 2, 20};
  batch.actual = {0.5, 10, 1.9, 20.25};
  return batch;
}

using idl::channel::Mode, idl::channel::RunState;

/// What is shown of the run of channel 0 when the drive is at `tick` and the channel is as given.
Json run_time_at(StateDocument& document, std::uint64_t tick, RunState state, Mode mode = Mode::AUTO,
                 bool suspended = false) {
  idl::stream::Feedback batch{};
  batch.tick = tick;
  document.apply(batch);
  idl::channel::ChannelState one{};
  one.state = state;
  one.mode = mode;
  one.suspended = suspended;
  document.apply(one);
  return document.document(1)["run_times"]["0"];
}

TEST(StateDocument, TheTimeOfAProgramCountsFromItsStartToItsEndWithHoldsAndMdiInBetween) {
  StateDocument document;
  run_time_at(document, 1000, RunState::IDLE);
  run_time_at(document, 1100, RunState::RUNNING);
  run_time_at(document, 1500, RunState::HELD);
  run_time_at(document, 2000, RunState::IDLE, Mode::MDI, true);
  auto time = run_time_at(document, 2600, RunState::RUNNING);
  EXPECT_EQ(time["ticks"], 1500);  // 2600 - 1100
  EXPECT_EQ(time["partial"], false);
  EXPECT_EQ(run_time_at(document, 2700, RunState::IDLE)["ticks"], 1600);  // 2700 - 1100
  EXPECT_EQ(run_time_at(document, 9000, RunState::IDLE)["ticks"], 1600);
  EXPECT_EQ(run_time_at(document, 9100, RunState::RUNNING, Mode::MDI)["ticks"], 1600);
  time = run_time_at(document, 9200, RunState::RUNNING);
  EXPECT_EQ(time["ticks"], 0);
  EXPECT_EQ(time["partial"], false);
}

TEST(StateDocument, AProgramThatRanAlreadyOrADriveThatCountsFromZeroAgainGivesAPartOfTheTime) {
  StateDocument document;
  run_time_at(document, 500, RunState::RUNNING);
  auto time = run_time_at(document, 800, RunState::RUNNING);
  EXPECT_EQ(time["ticks"], 300);  // 800 - 500
  EXPECT_EQ(time["partial"], true);
  run_time_at(document, 10, RunState::RUNNING);
  time = run_time_at(document, 50, RunState::RUNNING);
  EXPECT_EQ(time["ticks"], 40);  // 50 - 10
  EXPECT_EQ(time["partial"], true);
}

TEST(StateDocument, ColumnsOfTheFeedbackGoToTheLogicalAxesOfTheDrive) {
  StateDocument document;
  document.set_drive_axes({0, 5});
  document.apply(feedback());
  auto json = document.document(0);
  EXPECT_EQ(json["axes"]["0"]["actual"], 1.9);
  EXPECT_EQ(json["axes"]["5"]["following_error"], -0.25);
  EXPECT_EQ(json["axes"]["0"]["following_error"], 0.1);
  EXPECT_EQ(json["axes"]["0"]["following_peak"], 0.5) << "of the first row, larger than that of the last";
  EXPECT_EQ(json["drive"]["executed"], 52);
  EXPECT_EQ(json["trace"]["rows"], Json::parse("[[0.5,10.0],[1.9,20.25]]"));
  json = document.document(0);
  EXPECT_EQ(json["axes"]["0"]["following_peak"], 0.1) << "peaks start afresh with each document";
  EXPECT_EQ(json["trace"]["first"], 50) << "and the last trace stays until there is a new one";
}

// -0.00125 rev are -0.45 deg.
TEST(StateDocument, ASpindleThatFollowsIsShownWithMasterErrorAndCorrection) {
  StateDocument document;
  auto batch = feedback();
  batch.spindles.resize(2);
  batch.spindles[0].master = -1;
  auto& slave = batch.spindles[1];
  slave.condition = idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED;
  slave.reference = -999.004;
  slave.master = 0;
  slave.synchronization_error = -0.00125;
  slave.correction = 1.256;
  document.apply(batch);
  const auto spindles = document.document(0)["drive"]["spindles"];
  ASSERT_EQ(spindles.size(), 2u);
  EXPECT_EQ(spindles[0]["master"], -1);
  EXPECT_EQ(spindles[0]["synchronization_error"], 0.0);
  EXPECT_EQ(spindles[1]["condition"], "SPINDLE_SYNCHRONIZED");
  EXPECT_EQ(spindles[1]["reference"], -999.0);
  EXPECT_EQ(spindles[1]["master"], 0);
  EXPECT_EQ(spindles[1]["synchronization_error"], -0.45);
  EXPECT_EQ(spindles[1]["correction"], 1.26);
}

TEST(StateDocument, BeforeTheFirstCycleAxesAreShownWhereTheyStand) {
  StateDocument document;
  document.set_drive_axes({0, 5});
  auto rest = feedback();
  rest.count = 0;
  rest.commanded.clear(), rest.actual.clear();
  rest.position = {3, -4};
  document.apply(rest);
  EXPECT_FALSE(document.executed());
  auto axis = document.document(0)["axes"]["5"];
  EXPECT_EQ(axis["position"], -4);
  EXPECT_EQ(axis["actual"], -4);
  EXPECT_EQ(axis["commanded"], -4);
  EXPECT_EQ(axis["following_error"], 0);
  document.apply(feedback());
  EXPECT_TRUE(document.executed());
  document.apply(rest);
  axis = document.document(0)["axes"]["5"];
  EXPECT_EQ(axis["actual"], 20.25) << "of the last cycle";
  EXPECT_EQ(axis["position"], -4);
}

TEST(StateDocument, ABatchWithFewerNumbersThanItSaysIsReadAsFarAsItGoes) {
  StateDocument document;
  document.set_drive_axes({0, 1, 2});
  auto batch = feedback();
  batch.count = 60;
  batch.actual.pop_back();
  document.apply(batch);
  const auto json = document.document(0);
  EXPECT_EQ(json["axes"].size(), 2u);
  EXPECT_EQ(json["axes"]["0"]["actual"], 0.5);
}

ClusterState with_two_axes() {
  auto set = std::make_shared<idl::parameters::ParameterSet>();
  set->revision = 7;
  idl::parameters::Parameter name{};
  for (const std::uint32_t axis : {0u, 4u}) {
    name.number = 100000 + axis * 1000;
    name.text = axis == 0 ? "X" : "C";
    set->values.push_back(name);
  }
  idl::parameters::Parameter rapid{};
  rapid.number = 104034;
  rapid.value = 3600;
  set->values.push_back(rapid);
  set->pending = {{104034, 250, ""}};
  ClusterState cluster;
  cluster.set_parameters(set);
  cluster.channels[0] = {};
  return cluster;
}

TEST(ParameterAnswer, ListsTheAxesTheMachineHasAndNoOthers) {
  const auto answer = parameters_answer(with_two_axes(), {"axis", "rapid_feed", 0, 100});
  ASSERT_EQ(answer["parameters"].size(), 2u) << answer.dump(1);
  EXPECT_EQ(answer["parameters"][0]["number"], 100034);
  EXPECT_EQ(answer["parameters"][0]["value"], 24000) << "the catalogue's default";
  EXPECT_EQ(answer["parameters"][0]["pending"], false);
  EXPECT_EQ(answer["parameters"][1]["number"], 104034);
  EXPECT_EQ(answer["parameters"][1]["value"], 3600);
  EXPECT_EQ(answer["parameters"][1]["pending"], true);
  EXPECT_EQ(answer["parameters"][1]["pending_value"], 250);
  EXPECT_FALSE(answer["parameters"][0].contains("pending_value"));
  EXPECT_EQ(answer["total"], 2);
}

TEST(ParameterAnswer, SearchesByNumberAndGoesByPages) {
  const auto cluster = with_two_axes();
  const auto by_number = parameters_answer(cluster, {"", "104034", 0, 100});
  ASSERT_EQ(by_number["parameters"].size(), 1u);
  EXPECT_EQ(by_number["parameters"][0]["name"], "rapid_feed");
  EXPECT_EQ(parameters_answer(cluster, {"axis", "Rapid Feed", 0, 100})["total"], 2);
  const auto all = parameters_answer(cluster, {"axis", "", 0, 1000});
  const auto page = parameters_answer(cluster, {"axis", "", 3, 2});
  ASSERT_EQ(page["parameters"].size(), 2u);
  EXPECT_EQ(page["parameters"][0], all["parameters"][3]);
  EXPECT_EQ(page["total"], all["total"]);
  EXPECT_TRUE(parameters_answer(cluster, {"nonsense", "", 0, 10})["parameters"].empty());
  EXPECT_TRUE(parameters_answer(ClusterState{}, {}).is_null());
}

TEST(ParameterAnswer, AReadOfOneParameterTakesNoMoreOfALargerSet) {
  const auto allocations = [](const ClusterState& cluster) {
    const auto before = testing_support::allocations;
    EXPECT_EQ(parameter_answer(cluster, 104034)["value"], 3600);
    return testing_support::allocations - before;
  };
  const auto few = with_two_axes();
  auto set = *few.parameters;
  // Values of a table of 10,000 points, as a machine with compensation has them.
  for (std::uint32_t number = 700000; number < 710000; ++number) set.values.push_back({number, 0.001, ""});
  ClusterState many;
  many.set_parameters(std::make_shared<idl::parameters::ParameterSet>(set));
  EXPECT_EQ(allocations(many), allocations(few));
}

}  // namespace
}  // namespace trunnion::gateway
