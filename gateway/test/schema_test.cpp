// SPDX-License-Identifier: Apache-2.0
// What the gateway sends is what openapi.json says, since the page's types are made of that.
#include <gtest/gtest.h>

#include <fstream>

#include "core/cluster_state.hpp"
#include "core/state_document.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

const Json& api() {
  static const Json document = [] {
    std::ifstream file(OPENAPI_FILE);
    return Json::parse(file);
  }();
  return document;
}

bool is_type(const std::string& type, const Json& value) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  if (type == "null") return value.is_null();
  return value.is_object();
}

/// Where `value` is not what `schema` says: a path and what is wrong. Members that are not described are
/// wrong, too, unless the schema allows them.
void compare(const Json& schema, const Json& value, const std::string& at, std::vector<std::string>& wrong) {
  if (schema.contains("$ref"))
    return compare(api()[Json::json_pointer(schema["$ref"].get<std::string>().substr(1))], value, at, wrong);
  if (schema.contains("oneOf")) {
    for (const auto& choice : schema["oneOf"]) {
      std::vector<std::string> off;
      compare(choice, value, at, off);
      if (off.empty()) return;
    }
    wrong.push_back(at + ": " + value.dump() + " is none of the choices");
    return;
  }
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    wrong.push_back(at + ": " + value.dump() + " is not one of " + schema["enum"].dump());
  if (schema.contains("type") && !is_type(schema["type"], value)) {
    wrong.push_back(at + ": " + value.dump() + " is no " + schema["type"].get<std::string>());
    return;
  }
  if (value.is_array() && schema.contains("items"))
    for (const auto& one : value) compare(schema["items"], one, at + "[]", wrong);
  if (!value.is_object()) return;
  const auto known = schema.value("properties", Json::object());
  const auto others = schema.value("additionalProperties", Json(false));
  for (const auto& [name, member] : value.items()) {
    auto place = at;
    place.append(".").append(name);
    if (known.contains(name))
      compare(known[name], member, place, wrong);
    else if (others.is_object())
      compare(others, member, place, wrong);
    else if (others == false)
      wrong.push_back(place + " is not described");
  }
  for (const auto& name : schema.value("required", Json::array()))
    if (!value.contains(name.get<std::string>()))
      wrong.push_back(at + "." + name.get<std::string>() + " is missing");
}

std::vector<std::string> differences(const char* schema, const Json& value) {
  std::vector<std::string> wrong;
  compare(api()["components"]["schemas"].at(schema), value, schema, wrong);
  return wrong;
}

idl::channel::ChannelState channel() {
  idl::channel::ChannelState state;
  state.name = "left", state.mode = idl::channel::Mode::JOG, state.state = idl::channel::RunState::HELD;
  state.axes = {0, 1}, state.letters = "XC", state.machine = {1, 2}, state.modal = {"G1"};
  return state;
}

/// Everything the stream can carry.
Json whole_document() {
  StateDocument document;
  idl::service::Cluster cluster;
  cluster.services.resize(1);
  cluster.services[0].instance = 9;
  document.apply(cluster);
  idl::service::Announcement announcement;
  announcement.instance = 4;
  document.apply(announcement);
  idl::service::ServiceState state;
  state.instance = 4;
  document.apply(state, 1);
  idl::service::Alarm alarm;
  alarm.instance = 4, alarm.active = true, alarm.severity = idl::service::Severity::ERROR;
  document.apply(alarm, 1, "2026-01-01T00:00:00Z");
  document.apply(channel());
  idl::plc::Outputs outputs;
  outputs.coolant = {1}, outputs.spindle_speed = {500};
  outputs.channels.resize(1);
  document.apply(outputs);
  document.apply(idl::measurement::MeasurementState{});
  idl::stream::Feedback feedback;
  feedback.first = 100, feedback.count = 1, feedback.axis_count = 2,
  feedback.mode = idl::stream::DriveMode::HELD;
  feedback.commanded = {1, 2}, feedback.actual = {1, 2}, feedback.spindle_speed = {500};
  feedback.spindles.resize(1);
  document.set_drive_axes({0, 5});
  document.apply(feedback);
  for (const char* what : {"parameters", "pending", "tools", "work_offsets", "programs"})
    document.set_revision(what, 3);
  auto whole = document.document(1);
  whole["operating"] = {{"holder", {{"number", 7}, {"name", "ann"}}}};
  return whole;
}

TEST(Schema, TheStreamCarriesWhatIsDescribed) {
  const auto document = whole_document();
  EXPECT_EQ(differences("MachineState", document), std::vector<std::string>{});
  for (const auto& [name, schema] : api()["components"]["schemas"]["MachineState"]["properties"].items())
    EXPECT_TRUE(document.contains(name) && !document[name].empty()) << name << " is not tested";
  for (const auto& [name, schema] : api()["components"]["schemas"]["Revisions"]["properties"].items())
    EXPECT_TRUE(document["revisions"].contains(name)) << name;
}

TEST(Schema, TablesAndProgramsAreWhatIsDescribed) {
  idl::parameters::ToolTable tools;
  tools.tools.resize(1);
  EXPECT_EQ(differences("ToolTable", bus::to_json(tools)), std::vector<std::string>{});
  idl::parameters::WorkOffsets offsets;
  offsets.offsets.push_back({0, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9}});
  EXPECT_EQ(differences("WorkOffsets", bus::to_json(offsets)), std::vector<std::string>{});
  idl::program::ProgramList programs;
  programs.programs.resize(1);
  EXPECT_EQ(differences("ProgramList", bus::to_json(programs)), std::vector<std::string>{});
  idl::plc::Image image;
  image.x = {1}, image.b = {-1};
  EXPECT_EQ(differences("PlcImage", bus::to_json(image)), std::vector<std::string>{});
  const idl::channel::Variables variables{0, {50, 500}, {1.5, -2}};
  EXPECT_EQ(differences("Variables", bus::to_json(variables)), std::vector<std::string>{});
}

TEST(Schema, AWrongDocumentIsFound) {
  auto document = whole_document();
  document["drive"]["mode"] = "FLYING";
  document["channels"]["0"].erase("feed");
  document["axes"]["5"]["colour"] = 1;
  document["plc"]["feed_hold"] = 0;
  EXPECT_EQ(differences("MachineState", document).size(), 4u);
}

}  // namespace
}  // namespace trunnion::gateway
