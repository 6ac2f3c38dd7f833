#include "src/orders.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using bus::Json;
using idl::channel::CommandKind;

idl::channel::ChannelState five_axes() {
  idl::channel::ChannelState state{};
  state.channel = 2;
  state.axes = {0, 1, 2, 4, 6};
  state.letters = "XYZAC";
  return state;
}

idl::channel::ChannelRequest order(Operation operation, const Json& body) {
  return channel_order(operation, body, five_axes());
}

/// The field that is complained about, or "accepted".
std::string complaint(Operation operation, const Json& body) {
  try {
    order(operation, body);
  } catch (const BadRequest& bad) {
    EXPECT_STRNE(bad.what(), "");
    return bad.field;
  }
  return "accepted";
}

TEST(Orders, JogTakesTheAxisByLetterOrIndexAndKeepsTheSignOfTheSpeed) {
  const auto by_letter = order(Operation::jog, {{"axis", "C"}, {"speed", -600.5}, {"increment", 0.01}});
  EXPECT_EQ(by_letter.channel, 2);
  EXPECT_EQ(by_letter.command, CommandKind::JOG_AXIS);
  EXPECT_EQ(by_letter.axis, 4);
  EXPECT_EQ(by_letter.speed, -600.5);
  EXPECT_EQ(by_letter.increment, 0.01);
  EXPECT_EQ(order(Operation::jog_stop, {{"axis", 3}}).axis, 3);
}

TEST(Orders, AJogThatCannotBeMeantIsRefusedWithItsField) {
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "B"}, {"speed", 1}}), "axis");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", 5}, {"speed", 1}}), "axis");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", -1}, {"speed", 1}}), "axis");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", 1.5}, {"speed", 1}}), "axis");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "XY"}, {"speed", 1}}), "axis");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "X"}, {"speed", 0}}), "speed");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "X"}, {"speed", "fast"}}), "speed");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "X"}}), "speed");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "X"}, {"speed", 1}, {"increment", -1}}), "increment");
  EXPECT_EQ(complaint(Operation::jog, {{"axis", "X"}, {"speed", 1}, {"increments", 1}}), "increments");
}

TEST(Orders, OverridesHaveTheLimitsOfTheirKind) {
  EXPECT_EQ(order(Operation::override_, {{"kind", "feed"}, {"value", 1.5}}).command,
            CommandKind::FEED_OVERRIDE);
  EXPECT_EQ(order(Operation::override_, {{"kind", "rapid"}, {"value", 0}}).command,
            CommandKind::RAPID_OVERRIDE);
  EXPECT_EQ(order(Operation::override_, {{"kind", "spindle"}, {"value", 0.5}}).fraction, 0.5);
  EXPECT_EQ(complaint(Operation::override_, {{"kind", "feed"}, {"value", 1.51}}), "value");
  EXPECT_EQ(complaint(Operation::override_, {{"kind", "rapid"}, {"value", 1.1}}), "value");
  EXPECT_EQ(complaint(Operation::override_, {{"kind", "spindle"}, {"value", 0.4}}), "value");
  EXPECT_EQ(complaint(Operation::override_, {{"kind", "coolant"}, {"value", 1}}), "kind");
}

TEST(Orders, ModesAreNamedAsInTheIdl) {
  EXPECT_EQ(order(Operation::mode, {{"mode", "REF"}}).mode, idl::channel::Mode::REF);
  EXPECT_EQ(complaint(Operation::mode, {{"mode", "auto"}}), "mode");
  EXPECT_EQ(complaint(Operation::mode, Json::object()), "mode");
}

TEST(Orders, AnMdiLineIsOneLineThatFitsTheBus) {
  EXPECT_EQ(order(Operation::mdi, {{"line", "G0 X1"}}).block, "G0 X1");
  EXPECT_EQ(order(Operation::mdi, {{"line", std::string(256, 'G')}}).block.size(), 256u);
  EXPECT_EQ(complaint(Operation::mdi, {{"line", std::string(257, 'G')}}), "line");
  EXPECT_EQ(complaint(Operation::mdi, {{"line", "  "}}), "line");
  EXPECT_EQ(complaint(Operation::mdi, {{"line", "G0\nM30"}}), "line");
}

TEST(Orders, SwitchesBecomeOneAndZeroAndKeysTakeNoFields) {
  EXPECT_TRUE(order(Operation::single_block, {{"on", true}}).on);
  EXPECT_FALSE(order(Operation::optional_stop, {{"on", false}}).on);
  EXPECT_EQ(complaint(Operation::single_block, {{"on", 1}}), "on");
  EXPECT_EQ(order(Operation::cycle_start, Json::object()).command, CommandKind::CYCLE_START);
  EXPECT_EQ(order(Operation::feed_hold, Json::object()).command, CommandKind::FEED_HOLD);
  EXPECT_EQ(order(Operation::reset, Json::object()).command, CommandKind::RESET);
  EXPECT_EQ(complaint(Operation::cycle_start, {{"mode", "AUTO"}}), "mode");
}

TEST(Orders, ALineCountsFromOne) {
  const auto request = order(Operation::start_from_line, {{"line", 40}});
  EXPECT_EQ(request.command, CommandKind::START_FROM_LINE);
  EXPECT_EQ(request.line, 40u);
  EXPECT_EQ(complaint(Operation::start_from_line, {{"line", 0}}), "line");
  EXPECT_EQ(complaint(Operation::start_from_line, {{"line", 1.5}}), "line");
}

TEST(Orders, SwitchesOfTheProgramAreThoseOfTheIdl) {
  EXPECT_EQ(order(Operation::dry_run, {{"on", true}}).command, CommandKind::DRY_RUN);
  EXPECT_EQ(order(Operation::auxiliary_lock, {{"on", true}}).command, CommandKind::AUXILIARY_LOCK);
  EXPECT_EQ(order(Operation::retrace, {{"on", true}}).command, CommandKind::RETRACE);
  EXPECT_EQ(order(Operation::handwheel_offset, {{"on", true}}).command, CommandKind::HANDWHEEL_OFFSET);
}

TEST(Orders, AxesAndLevelsBecomeBits) {
  EXPECT_EQ(order(Operation::axis_lock, {{"axes", {"X", 2}}}).axes, 0b101);
  EXPECT_EQ(order(Operation::axis_lock, {{"axes", Json::array()}}).axes, 0);
  EXPECT_EQ(complaint(Operation::axis_lock, {{"axes", {"Q"}}}), "axis");
  EXPECT_EQ(order(Operation::block_skip, {{"levels", {1, 3}}}).levels, 0b101);
  EXPECT_EQ(complaint(Operation::block_skip, {{"levels", {0}}}), "levels");
  EXPECT_EQ(complaint(Operation::block_skip, {{"levels", 1}}), "levels");
}

TEST(Orders, AHandwheelGivesWholeCounts) {
  const auto request = order(Operation::handwheel, {{"axis", "Z"}, {"counts", -3}, {"increment", 0.01}});
  EXPECT_EQ(request.command, CommandKind::HANDWHEEL);
  EXPECT_EQ(request.axis, 2);
  EXPECT_EQ(request.counts, -3);
  EXPECT_EQ(request.increment, 0.01);
  EXPECT_EQ(complaint(Operation::handwheel, {{"axis", "Z"}, {"counts", 0.5}, {"increment", 0.01}}), "counts");
}

TEST(Orders, ThePanelsKindsAreThoseOfTheIdl) {
  EXPECT_EQ(panel_order(Operation::emergency_stop, Json::object()).kind,
            PanelRequestKind::PRESS_EMERGENCY_STOP);
  EXPECT_EQ(panel_order(Operation::release, Json::object()).kind, PanelRequestKind::RELEASE_EMERGENCY_STOP);
  EXPECT_EQ(panel_order(Operation::panel_reset, Json::object()).kind, PanelRequestKind::RESET_EMERGENCY_STOP);
}

TEST(Orders, AnAlarmResetIsForAllUnlessAChannelIsNamed) {
  EXPECT_EQ(alarm_reset_order(Json::object()).channel, 65535);
  EXPECT_EQ(alarm_reset_order({{"channel", 1}}).channel, 1);
  EXPECT_THROW(alarm_reset_order({{"channel", 0.5}}), BadRequest);
  EXPECT_THROW(alarm_reset_order({{"channel", -1}}), BadRequest);
}

TEST(Orders, AParameterIsSetByWhatItsTypeTakes) {
  const auto set = parameter_order(100034, false, {{"value", 12.5}, {"who", "test"}});
  EXPECT_EQ(set.operation, idl::parameters::Operation::SET);
  EXPECT_EQ(set.who, "test");
  ASSERT_EQ(set.values.size(), 1u);
  EXPECT_EQ(set.values[0].number, 100034u);
  EXPECT_EQ(set.values[0].value, 12.5);
  EXPECT_EQ(parameter_order(100000, true, {{"text", "X"}}).values[0].text, "X");
  EXPECT_EQ(parameter_order(100034, false, {{"reset", true}}).operation,
            idl::parameters::Operation::RESET_TO_DEFAULT);
  EXPECT_THROW(parameter_order(100034, false, {{"text", "1"}}), BadRequest);
  EXPECT_THROW(parameter_order(100000, true, {{"value", 1}}), BadRequest);
  EXPECT_THROW(parameter_order(100034, false, Json::object()), BadRequest);
  EXPECT_THROW(parameter_order(100034, false, {{"value", 1}, {"reset", true}}), BadRequest);
  EXPECT_THROW(parameter_order(100034, false, {{"reset", false}}), BadRequest);
}

TEST(Orders, AWorkOffsetHasNineNumbers) {
  const Json nine = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto set = work_offset_order({{"channel", 0}, {"index", 5}, {"values", nine}});
  EXPECT_EQ(set.offsets.at(0).values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_THROW(work_offset_order({{"channel", 0}, {"index", 54}, {"values", nine}}), BadRequest);
  EXPECT_THROW(work_offset_order({{"channel", 0}, {"index", 0}, {"values", {1, 2}}}), BadRequest);
  EXPECT_THROW(work_offset_order({{"channel", 0}, {"index", 0}}), BadRequest);
}

TEST(Orders, BodiesThatAreNoObjectsAreRefused) {
  EXPECT_TRUE(parse_body(" \r\n").empty());
  EXPECT_THROW(parse_body("{"), BadRequest);
  EXPECT_THROW(parse_body("[1]"), BadRequest);
  EXPECT_THROW(parse_body("{\"a\":1e999}"), BadRequest);
}

TEST(Orders, NumbersInPathsAreDecimalDigitsOnly) {
  EXPECT_EQ(path_number("000001", 999999), 1u);
  EXPECT_EQ(path_number("", 9), std::nullopt);
  EXPECT_EQ(path_number("-1", 9), std::nullopt);
  EXPECT_EQ(path_number("1x", 9), std::nullopt);
  EXPECT_EQ(path_number("10", 9), std::nullopt);
  EXPECT_EQ(path_number("99999999999999999999", 9), std::nullopt);
}

TEST(Orders, NamesThatCouldLeaveTheStoreAreRefused) {
  EXPECT_NO_THROW(check_program_name("PART 1.NC"));
  EXPECT_NO_THROW(check_program_name(std::string(64, 'a')));
  for (const std::string bad : {"", "..", ".hidden", "a/b", "a\\b", "a\nb"})
    EXPECT_THROW(check_program_name(bad), BadRequest) << bad;
  EXPECT_THROW(check_program_name(std::string(65, 'a')), BadRequest);
}

}  // namespace
}  // namespace trunnion::gateway
