// SPDX-License-Identifier: Apache-2.0
#include "core/measurement_requests.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using Order = idl::measurement::Operation;

/// The field that is refused; empty when nothing is.
std::string refused_field(Operation operation, const char* body) {
  try {
    measurement_request(operation, parse_body(body));
    return {};
  } catch (const BadRequest& bad) {
    return bad.field;
  }
}

TEST(MeasurementRequests, AStartHasInputsModeSphereAndProbe) {
  const auto request = measurement_request(
      Operation::measurement_start,
      parse_body(R"({"channel": 1, "inputs": "mode: correct\naxes: {}", "mode": "only_correct",
                     "sphere_mm": [60, 40, -360.5], "probe_length_mm": 61, "retract": true})"));
  EXPECT_EQ(request.operation, Order::START);
  EXPECT_EQ(request.channel, 1);
  EXPECT_EQ(request.inputs, "mode: correct\naxes: {}");
  EXPECT_EQ(request.mode, idl::measurement::Mode::ONLY_CORRECT);
  EXPECT_EQ(request.sphere, (std::vector<double>{60, 40, -360.5}));
  EXPECT_EQ(request.probe_length, std::vector<double>{61});
  EXPECT_TRUE(request.retract);
  const auto empty = measurement_request(Operation::measurement_start, parse_body(""));
  EXPECT_EQ(empty.mode, idl::measurement::Mode::AS_INPUTS);
  EXPECT_TRUE(empty.inputs.empty() && empty.sphere.empty() && empty.probe_length.empty() && !empty.retract);
}

TEST(MeasurementRequests, WhatCannotBeMeantIsRefusedByItsField) {
  const auto start = Operation::measurement_start;
  EXPECT_EQ(refused_field(start, R"({"channel": -1})"), "channel");
  EXPECT_EQ(refused_field(start, R"({"inputs": 5})"), "inputs");
  EXPECT_EQ(refused_field(start, ("{\"inputs\": \"" + std::string(16385, 'x') + "\"}").c_str()), "inputs");
  EXPECT_EQ(refused_field(start, R"({"mode": "write"})"), "mode");
  EXPECT_EQ(refused_field(start, R"({"sphere_mm": [1, 2]})"), "sphere_mm");
  EXPECT_EQ(refused_field(start, R"({"sphere_mm": [1, 2, 1e9]})"), "sphere_mm");
  EXPECT_EQ(refused_field(start, R"({"probe_length_mm": -1})"), "probe_length_mm");
  EXPECT_EQ(refused_field(start, R"({"write": true})"), "write");
  EXPECT_EQ(refused_field(Operation::measurement_abort, R"({"channel": 0})"), "channel");
}

TEST(MeasurementRequests, TheOrdersAreThoseOfTheService) {
  const auto order = [](Operation operation) {
    return measurement_request(operation, parse_body("{}")).operation;
  };
  EXPECT_EQ(order(Operation::measurement_continue), Order::CONTINUE);
  EXPECT_EQ(order(Operation::measurement_abort), Order::ABORT);
  EXPECT_EQ(order(Operation::measurement_discard), Order::DISCARD);
  EXPECT_EQ(order(Operation::measurement_confirm), Order::CONFIRM);
  EXPECT_TRUE(measurement_request(Operation::measurement_confirm, parse_body(R"({"acknowledge": true})"))
                  .acknowledge);
}

TEST(MeasurementRequests, AnUndoIsOneImportOfTheValuesBeforeInTheNameOfWhoAsks) {
  const calibration::LastCalibration last{
      "T2", "bob calibrate", {{40433, 0.1}, {40435, 1}}, {{40433, 0.2}, {40435, 2}}};
  const auto request = undo_request(last, std::string(100, 'a'));
  EXPECT_EQ(request.operation, idl::parameters::Operation::IMPORT);
  EXPECT_EQ(request.who, std::string(49, 'a') + " calibrate undo") << "64 bytes are the bound";
  ASSERT_EQ(request.values.size(), 2u);
  EXPECT_EQ(request.values[0].number, 40433u);
  EXPECT_EQ(request.values[0].value, 0.1);
  EXPECT_EQ(request.values[1].value, 1);
  const auto answer = calibration_answer(last);
  EXPECT_EQ(answer["who"], "bob calibrate");
  EXPECT_EQ(answer["changes"][1], (bus::Json{{"number", 40435}, {"before", 1.0}, {"after", 2.0}}));
}

}  // namespace
}  // namespace trunnion::gateway
