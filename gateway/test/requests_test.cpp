// SPDX-License-Identifier: Apache-2.0
#include "core/requests.hpp"

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

// The commands themselves are tested in libs/cluster/commands.
TEST(Requests, ACommandGoesToTheChannelWithItsAxes) {
  const auto request = channel_request("jog", {{"axis", "C"}, {"speed", -600.5}}, five_axes());
  EXPECT_EQ(request.channel, 2);
  EXPECT_EQ(request.command, CommandKind::JOG_AXIS);
  EXPECT_EQ(request.axis, 4);
  EXPECT_EQ(request.speed, -600.5);
  EXPECT_THROW(channel_request("jog", {{"axis", "B"}, {"speed", 1}}, five_axes()), BadRequest);
}

TEST(Requests, ABodyIsBoundedBeforeItIsKept) {
  const auto refusal = [](const std::string& body) -> std::string {
    try {
      parse_body(body);
    } catch (const BadRequest& bad) {
      return bad.what();
    }
    return "";
  };
  const auto members = [](int count) {
    std::string body = "{";
    for (int i = 0; i < count; ++i)
      body += (i > 0 ? ",\"" : "\"") + std::to_string(i) + "\":" + std::to_string(i);
    return body + "}";
  };
  const auto levels = [](std::size_t count) {
    return "{\"a\":" + std::string(count - 1, '[') + std::string(count - 1, ']') + "}";
  };
  const auto values = [](std::size_t count) {
    std::string body = "{\"a\":[1";
    for (std::size_t i = 3; i < count; ++i) body += ",1";
    return body + "]}";
  };
  EXPECT_EQ(refusal(members(64)), "");
  EXPECT_EQ(refusal(members(65)), "the body has more than 64 members in an object");
  EXPECT_EQ(refusal("{\"rows\":[" + members(64) + "," + members(64) + "]}"), "");
  EXPECT_EQ(refusal(levels(16)), "");
  EXPECT_EQ(refusal(levels(17)), "the body has more than 16 levels");
  EXPECT_EQ(refusal(values(65536)), "");
  EXPECT_EQ(refusal(values(65537)), "the body has more than 65536 values");
  EXPECT_EQ(refusal(members(90000)), "the body has more than 64 members in an object");
  EXPECT_EQ(refusal("{\"a\":"), "the body is not JSON");
  EXPECT_EQ(refusal("[]"), "the body must be a JSON object");
}

TEST(Requests, ThePanelsRoutesAreTheKindsOfTheIdl) {
  using idl::plc::PanelRequestKind;
  EXPECT_EQ(panel_request("emergency-stop", Json::object()).kind, PanelRequestKind::PRESS_EMERGENCY_STOP);
  EXPECT_EQ(panel_request("release", Json::object()).kind, PanelRequestKind::RELEASE_EMERGENCY_STOP);
  EXPECT_EQ(panel_request("reset", Json::object()).kind, PanelRequestKind::RESET_EMERGENCY_STOP);
  EXPECT_THROW(panel_request("release", {{"on", true}}), BadRequest);
}

TEST(Requests, AnAlarmResetIsForAllUnlessAChannelIsNamed) {
  EXPECT_EQ(alarm_reset(Json::object()).channel, 65535);
  EXPECT_EQ(alarm_reset({{"channel", 1}}).channel, 1);
  EXPECT_THROW(alarm_reset({{"channel", 0.5}}), BadRequest);
  EXPECT_THROW(alarm_reset({{"channel", -1}}), BadRequest);
}

TEST(Requests, AParameterIsSetByWhatItsTypeTakes) {
  const auto set = parameter_request(100034, false, {{"value", 12.5}, {"who", "test"}});
  EXPECT_EQ(set.operation, idl::parameters::Operation::SET);
  EXPECT_EQ(set.who, "test");
  ASSERT_EQ(set.values.size(), 1u);
  EXPECT_EQ(set.values[0].number, 100034u);
  EXPECT_EQ(set.values[0].value, 12.5);
  EXPECT_EQ(parameter_request(100000, true, {{"text", "X"}}).values[0].text, "X");
  EXPECT_EQ(parameter_request(100034, false, {{"reset", true}}).operation,
            idl::parameters::Operation::RESET_TO_DEFAULT);
  EXPECT_THROW(parameter_request(100034, false, {{"text", "1"}}), BadRequest);
  EXPECT_THROW(parameter_request(100000, true, {{"value", 1}}), BadRequest);
  EXPECT_THROW(parameter_request(100034, false, Json::object()), BadRequest);
  EXPECT_THROW(parameter_request(100034, false, {{"value", 1}, {"reset", true}}), BadRequest);
  EXPECT_THROW(parameter_request(100034, false, {{"reset", false}}), BadRequest);
}

TEST(Requests, AWorkOffsetHasNineNumbers) {
  const Json nine = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto set = work_offset_request({{"channel", 0}, {"index", 5}, {"values", nine}});
  EXPECT_EQ(set.offsets.at(0).values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(work_offset_request({{"channel", 0}, {"index", 61}, {"values", nine}}).offsets.at(0).index, 61);
  EXPECT_THROW(work_offset_request({{"channel", 0}, {"index", 62}, {"values", nine}}), BadRequest);
  EXPECT_THROW(work_offset_request({{"channel", 0}, {"index", 0}, {"values", {1, 2}}}), BadRequest);
  EXPECT_THROW(work_offset_request({{"channel", 0}, {"index", 0}}), BadRequest);
}

TEST(Requests, SeveralParametersAreOneRequestAndEachMustFitItsType) {
  const auto set = parameter_import(
      {{"values", {{{"number", 100034}, {"value", 12.5}}, {{"number", 40000}, {"text", "left"}}}}});
  EXPECT_EQ(set.operation, idl::parameters::Operation::IMPORT);
  ASSERT_EQ(set.values.size(), 2u);
  EXPECT_EQ(set.values[0].value, 12.5);
  EXPECT_EQ(set.values[1].text, "left");
  const auto refused = [](const Json& row) {
    EXPECT_THROW(parameter_import({{"values", Json::array({row})}}), BadRequest) << row;
  };
  refused({{"number", 100034}, {"text", "1"}});
  refused({{"number", 40000}, {"value", 1}});
  refused({{"number", 100034}});
  refused({{"number", 999}, {"value", 1}});
  refused({{"number", 100034}, {"value", 1}, {"unit", "mm"}});
  refused(5);
  EXPECT_THROW(parameter_import({{"values", Json::array()}}), BadRequest);
  EXPECT_THROW(parameter_import(Json::object()), BadRequest);
}

TEST(Requests, AToolHasAllItsFields) {
  const Json fields = {
      {"length", 112.25}, {"length_wear", -0.05}, {"radius", 5}, {"radius_wear", 0}, {"name", "mill"}};
  auto body = fields;
  body["revision"] = 7;
  const auto set = tool_request(3, body);
  EXPECT_EQ(set.operation, idl::parameters::Operation::SET_TOOL);
  EXPECT_EQ(set.revision, 7u);
  ASSERT_EQ(set.tools.size(), 1u);
  EXPECT_EQ(set.tools[0].number, 3u);
  EXPECT_EQ(set.tools[0].length_wear, -0.05);
  EXPECT_EQ(set.tools[0].name, "mill");
  for (const auto& [name, value] : fields.items()) {
    auto incomplete = fields;
    incomplete.erase(name);
    EXPECT_THROW(tool_request(3, incomplete), BadRequest) << name;
  }
  EXPECT_EQ(set.tools[0].life_unit, idl::parameters::LifeUnit::MINUTES);
  body["type"] = "drill";
  body["life_used"] = 12.5;
  body["life_limit"] = 90;
  body["life_unit"] = "PIECES";
  const auto whole = tool_request(3, body).tools.at(0);
  EXPECT_EQ(whole.type, "drill");
  EXPECT_EQ(whole.life_used, 12.5);
  EXPECT_EQ(whole.life_limit, 90);
  EXPECT_EQ(whole.life_unit, idl::parameters::LifeUnit::PIECES);
  const std::vector<std::pair<std::string, Json>> wrong = {
      {"life_unit", "HOURS"}, {"life_used", -1}, {"life_limit", "90"}, {"type", std::string(33, 'x')}};
  for (const auto& [name, value] : wrong) {
    auto refused = fields;
    refused[name] = value;
    EXPECT_THROW(tool_request(3, refused), BadRequest) << name;
  }
  EXPECT_EQ(tool_removal(3, "12").revision, 12u);
  EXPECT_EQ(tool_removal(3, "").revision, 0u);
  EXPECT_THROW(tool_removal(3, "x"), BadRequest);
}

TEST(Requests, AProgramIsRenamedToANameThatAProgramMayHave) {
  const auto renamed = rename_request("a.nc", {{"name", "b.nc"}});
  EXPECT_EQ(renamed.operation, idl::program::Operation::RENAME);
  EXPECT_EQ(renamed.new_name, "b.nc");
  EXPECT_THROW(rename_request("a.nc", {{"name", "../b.nc"}}), BadRequest);
  EXPECT_THROW(rename_request("a.nc", Json::object()), BadRequest);
}

TEST(Requests, BodiesThatAreNoObjectsAreRefused) {
  EXPECT_TRUE(parse_body(" \r\n").empty());
  EXPECT_THROW(parse_body("{"), BadRequest);
  EXPECT_THROW(parse_body("[1]"), BadRequest);
  EXPECT_THROW(parse_body("{\"a\":1e999}"), BadRequest);
}

TEST(Requests, NumbersInPathsAreDecimalDigitsOnly) {
  EXPECT_EQ(path_number("000001", 999999), 1u);
  EXPECT_EQ(path_number("", 9), std::nullopt);
  EXPECT_EQ(path_number("-1", 9), std::nullopt);
  EXPECT_EQ(path_number("1x", 9), std::nullopt);
  EXPECT_EQ(path_number("10", 9), std::nullopt);
  EXPECT_EQ(path_number("99999999999999999999", 9), std::nullopt);
}

}  // namespace
}  // namespace trunnion::gateway
