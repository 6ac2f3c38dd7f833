// SPDX-License-Identifier: Apache-2.0
#include "spindle_orders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace trunnion::cli {
namespace {

using testing::ElementsAre;

const std::vector<machine::AxisInfo> two_spindles{{3, "S1", machine::axis_type_spindle},
                                                  {4, "S2", machine::axis_type_spindle}};

CouplingOrder read_order(const std::string& word, const std::vector<std::string>& arguments) {
  return coupling_order(word, arguments, two_spindles);
}

std::string refusal_of(const std::string& word, const std::vector<std::string>& arguments) {
  try {
    read_order(word, arguments);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

// The addresses of spindles in the NUM dialect are 24 and 25, in #4822 they count from 1.
TEST(SpindleOrders, AreTheLinesOfAProgramInTheDialectOfTheChannel) {
  const auto couple = read_order("couple", {"S2", "S1", "-30"});
  EXPECT_THAT(order_lines(couple, false), ElementsAre("#4880=-30", "#4822=1"));
  EXPECT_THAT(order_lines(couple, true), ElementsAre("EC-30", "E94125=24"));
  const auto uncouple = read_order("uncouple", {"S2"});
  EXPECT_THAT(order_lines(uncouple, false), ElementsAre("#4822=0"));
  EXPECT_THAT(order_lines(uncouple, true), ElementsAre("E94125=-1"));
}

TEST(SpindleOrders, WithoutAnAngleLeaveTheOneThatWasOrderedBefore) {
  EXPECT_THAT(order_lines(read_order("couple", {"1", "2"}), false), ElementsAre("#4821=2"));
  EXPECT_THAT(order_lines(read_order("couple", {"1", "2"}), true), ElementsAre("E94124=25"));
}

// In hundredths of a degree, and never with an exponent.
TEST(SpindleOrders, AnAngleHasTheUnitOfThePlc) {
  EXPECT_EQ(order_lines(read_order("couple", {"S2", "S1", "123.456"}), false).front(), "#4880=123.46");
  EXPECT_EQ(order_lines(read_order("couple", {"S2", "S1", "0.00004"}), false).front(), "#4880=0");
  EXPECT_EQ(order_lines(read_order("couple", {"S2", "S1", "-0.001"}), true).front(), "EC0");
}

TEST(SpindleOrders, AreRefusedWithWhatIsWrong) {
  EXPECT_EQ(refusal_of("couple", {"S2"}), "write: couple SLAVE MASTER [ANGLE]");
  EXPECT_EQ(refusal_of("uncouple", {"S2", "S1"}), "write: uncouple SLAVE");
  EXPECT_EQ(refusal_of("couple", {"S3", "S1"}), "the machine has no spindle S3: it has S1, S2");
  EXPECT_EQ(refusal_of("couple", {"S2", "2"}), "spindle S2 cannot follow itself");
  EXPECT_EQ(refusal_of("couple", {"S2", "S1", "361"}), "'361' is no angle: -360 to 360 deg");
  EXPECT_EQ(refusal_of("couple", {"S2", "S1", "30deg"}), "'30deg' is no angle: -360 to 360 deg");
  EXPECT_EQ(refusal_of("couple", {"S2", "S1", "nan"}), "'nan' is no angle: -360 to 360 deg");
  EXPECT_THROW(coupling_order("uncouple", {"S1"}, {}), std::runtime_error);
}

TEST(SpindleOrders, TheNumDialectHasWordsForFourSpindles) {
  std::vector<machine::AxisInfo> five = two_spindles;
  for (const char* name : {"S3", "S4", "S5"}) five.push_back({5, name, machine::axis_type_spindle});
  const auto order = coupling_order("couple", {"S1", "S5"}, five);
  EXPECT_THAT(order_lines(order, false), ElementsAre("#4821=5"));
  EXPECT_THROW(order_lines(order, true), std::runtime_error);
  EXPECT_THAT(order_lines(coupling_order("couple", {"S4", "S3"}, five), true), ElementsAre("E94127=26"));
}

TEST(SpindleOrders, AreCarriedOutWhenTheDriveSaysSo) {
  const auto couple = read_order("couple", {"S2", "S1"});
  const auto uncouple = read_order("uncouple", {"S2"});
  idl::stream::Feedback feedback;
  EXPECT_FALSE(is_carried_out(couple, feedback));
  EXPECT_FALSE(is_carried_out(uncouple, feedback));
  feedback.spindles.resize(2);
  auto& slave = feedback.spindles[1];
  slave.master = -1;
  EXPECT_FALSE(is_carried_out(couple, feedback));
  EXPECT_TRUE(is_carried_out(uncouple, feedback));
  slave.master = 0;
  slave.condition = idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZING;
  EXPECT_FALSE(is_carried_out(couple, feedback));
  EXPECT_FALSE(is_carried_out(uncouple, feedback));
  slave.condition = idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED;
  EXPECT_TRUE(is_carried_out(couple, feedback));
  slave.master = 1;
  EXPECT_FALSE(is_carried_out(couple, feedback)) << "it follows another one";
}

}  // namespace
}  // namespace trunnion::cli
