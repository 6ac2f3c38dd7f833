// SPDX-License-Identifier: Apache-2.0
#include "identification/true_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing_support/refusal.hpp"

namespace trunnion::identification {
namespace {

using testing::StartsWith;

TrueMachine ac_table(const std::vector<std::string>& settings) {
  return load_true_machine(std::string(TRUNNION_SOURCE) + "/configs/machines/ac-table", 0, settings);
}

TEST(TrueMachines, TakeErrorsTemperaturesAndTheModelFromSettings) {
  auto machine = ac_table({"XOC=10", "rise.X=5", "040437=-300"});
  EXPECT_EQ(machine.name, "ac-table");
  const auto error = truth::location_error(machine.truth.geometry, machine.outline, "XOC");
  ASSERT_TRUE(error);
  EXPECT_NEAR(*error->value, 0.010, 1e-12);
  EXPECT_EQ(machine.report->temperatures[0], 5);
  EXPECT_EQ(machine.model.at(40437), -300);
}

TEST(TrueMachines, RefuseSettingsThatTheyDoNotHave) {
  const auto refusal = [](const char* setting) {
    return testing_support::refusal_of([&] { ac_table({setting}); });
  };
  EXPECT_THAT(refusal("XOC=ten"), StartsWith("--set XOC=ten: expected a number within "));
  EXPECT_EQ(refusal("rise.Q=1"),
            "--set rise.Q=1: expected rise. and an axis letter, or rise.S of the spindle");
  EXPECT_THAT(refusal("XOC"), StartsWith("--set XOC: expected a number within "));
}

TEST(TrueMachines, TakeAnotherModelWithTheSameErrors) {
  auto machine = ac_table({"rise.X=5"});
  machine.report->tool_length = 80;
  const auto other = ac_table({"040437=-300"});
  take_model(machine, other.model, 0);
  EXPECT_EQ(machine.model.at(40437), -300);
  EXPECT_EQ(machine.report->tool_length, 80);
  EXPECT_EQ(machine.report->temperatures[0], 5);
  const geometry::Angles c180{0, 0, 180, 0, 0, 0};
  const truth::Vec3 tip(10, 0, 0);
  EXPECT_LT((machine.report->model().machine_from_tip(tip, c180, 80) -
             other.report->model().machine_from_tip(tip, c180, 80))
                .norm(),
            1e-12);
}

TEST(TrueMachines, HaveExactInstrumentsWithoutAnEntry) {
  EXPECT_EQ(instrument(ac_table({}), "ballbar").noise, 0);
}

}  // namespace
}  // namespace trunnion::identification
