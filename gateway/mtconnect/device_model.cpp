// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/device_model.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace trunnion::gateway::mtconnect {
namespace {

constexpr auto sample = Category::sample, event = Category::event, condition = Category::condition;

constexpr std::array types = {
    ItemType{event, "AVAILABILITY", "", "", "avail", "the gateway hears the machine's launcher"},
    ItemType{event, "ASSET_CHANGED", "", "", "asset_changed", "`tool_table`: a tool that is new or changed"},
    ItemType{event, "ASSET_REMOVED", "", "", "asset_removed", "`tool_table`: a tool that was removed"},
    ItemType{event, "EMERGENCY_STOP", "", "", "estop", "`plc_outputs.emergency_stop`"},
    ItemType{condition, "SYSTEM", "", "", "system", "alarms of all other services"},
    ItemType{condition, "LOGIC_PROGRAM", "", "", "logic", "alarms of the PLC"},
    ItemType{condition, "HARDWARE", "", "", "hardware", "alarms of the drive"},
    ItemType{condition, "COMMUNICATIONS", "", "", "communications", "expected services without heartbeat"},
    ItemType{event, "EXECUTION", "", "", "execution", "`channel_state.state`, `program`"},
    ItemType{event, "CONTROLLER_MODE", "", "", "mode", "`channel_state.mode`"},
    ItemType{event, "PROGRAM", "", "", "program", "`channel_state.program`"},
    ItemType{event, "LINE_NUMBER", "ABSOLUTE", "", "line", "`channel_state.line`"},
    ItemType{event, "PART_COUNT", "COMPLETE", "", "parts", "`channel_state.parts`"},
    ItemType{condition, "MOTION_PROGRAM", "", "", "motion", "alarms of the channel"},
    ItemType{sample, "PATH_FEEDRATE", "ACTUAL", "MILLIMETER/SECOND", "feed", "`channel_state.feed` / 60"},
    ItemType{sample, "PATH_FEEDRATE", "PROGRAMMED", "MILLIMETER/SECOND", "feed_programmed",
             "`channel_state.programmed_feed` / 60"},
    ItemType{event, "PATH_FEEDRATE_OVERRIDE", "PROGRAMMED", "PERCENT", "feed_override",
             "`channel_state.feed_override`, %"},
    ItemType{event, "PATH_FEEDRATE_OVERRIDE", "RAPID", "PERCENT", "rapid_override",
             "`channel_state.rapid_override`, %"},
    ItemType{sample, "PATH_POSITION", "ACTUAL", "MILLIMETER_3D", "position",
             "X Y Z of `channel_state.workpiece`"},
    ItemType{event, "TOOL_NUMBER", "", "", "tool", "`channel_state.tool`"},
    ItemType{event, "TOOL_ASSET_ID", "", "", "tool_asset", "asset of that tool"},
    ItemType{event, "WORK_OFFSET", "", "", "work_offset", "`channel_state.work_offset`: G54, G54.1 P1 ..."},
    ItemType{sample, "POSITION", "ACTUAL", "MILLIMETER", "position", "`feedback.actual` of the axis"},
    ItemType{sample, "POSITION", "COMMANDED", "MILLIMETER", "commanded", "`feedback.commanded` of the axis"},
    ItemType{sample, "AXIS_FEEDRATE", "ACTUAL", "MILLIMETER/SECOND", "feed",
             "`feedback.velocity` of the axis"},
    ItemType{sample, "ANGLE", "ACTUAL", "DEGREE", "angle", "`feedback.actual` of the axis"},
    ItemType{sample, "ANGLE", "COMMANDED", "DEGREE", "commanded", "`feedback.commanded` of the axis"},
    ItemType{sample, "ANGULAR_VELOCITY", "", "DEGREE/SECOND", "velocity", "`feedback.velocity` of the axis"},
    ItemType{sample, "LOAD", "", "PERCENT", "load", "`feedback.torque` of the axis, % of the rated torque"},
    ItemType{event, "ROTARY_MODE", "", "", "rotary_mode", "CONTOUR for a rotary axis, SPINDLE for a spindle"},
    ItemType{sample, "ROTARY_VELOCITY", "ACTUAL", "REVOLUTION/MINUTE", "speed", "`feedback.spindle_speed`"},
    ItemType{sample, "ROTARY_VELOCITY", "COMMANDED", "REVOLUTION/MINUTE", "speed_commanded",
             "`plc_outputs.spindle_speed`"},
    ItemType{event, "ROTARY_VELOCITY_OVERRIDE", "", "PERCENT", "speed_override",
             "`channel_state.spindle_override` of the first channel, %"},
};

}  // namespace

const ItemType& type_of(Quantity quantity) { return types.at(static_cast<std::size_t>(quantity)); }

const std::vector<Quantity>& all_quantities() {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> list;
    for (std::size_t i = 0; i < types.size(); ++i) list.push_back(static_cast<Quantity>(i));
    return list;
  }();
  return all;
}

std::string element_name(const std::string& type) {
  std::string name;
  bool first = true;
  for (const unsigned char c : type) {
    if (c != '_') name.push_back(static_cast<char>(first ? c : std::tolower(c)));
    first = c == '_';
  }
  return name;
}

bool Device::operator==(const Device& other) const {
  const auto text = [](const Device& device) {
    std::string all = device.name + '\n' + device.uuid + '\n' + device.description + '\n';
    for (const auto& part : device.components) {
      all += part.kind + ' ' + part.id + ' ' + part.name + ' ' + std::to_string(part.parent) + '\n';
      for (const auto& item : part.items) all += item.id + ' ' + std::to_string(item.part) + '\n';
    }
    return all;
  };
  return text(*this) == text(other);
}

Device device_of(const MachineShape& shape) {
  using enum Quantity;
  Device device;
  device.name = shape.name;
  device.uuid = shape.uuid;
  device.description = shape.title;
  const auto add = [&](const char* kind, const std::string& id, const std::string& name, int parent,
                       std::uint32_t part, std::initializer_list<Quantity> quantities) {
    Component component{kind, id, name, parent, {}};
    for (const auto quantity : quantities)
      component.items.push_back({id + "_" + type_of(quantity).suffix, quantity, part});
    device.components.push_back(std::move(component));
    return static_cast<int>(device.components.size()) - 1;
  };
  const int top = add("Device", "device", shape.name, -1, 0, {availability, asset_changed, asset_removed});
  const int axes = add("Axes", "axes", "axes", top, 0, {});
  for (const auto& axis : shape.axes) {
    const auto id = "axis" + std::to_string(axis.number);
    if (axis.type == machine::axis_type_linear)
      add("Linear", id, axis.name, axes, axis.number, {position, position_commanded, axis_feed, load});
    else
      add("Rotary", id, axis.name, axes, axis.number,
          {angle, angle_commanded, angular_velocity, load, rotary_mode});
  }
  for (std::uint32_t i = 0; i < shape.spindles.size(); ++i)
    add("Rotary", "spindle" + std::to_string(i), shape.spindles[i].name, axes, i,
        {spindle_speed, spindle_speed_commanded, spindle_override, rotary_mode});
  const int controller = add("Controller", "controller", "controller", top, 0,
                             {emergency_stop, system, logic_program, hardware, communications});
  for (const auto& channel : shape.channels)
    add("Path", "path" + std::to_string(channel.number), channel.name, controller, channel.number,
        {execution, controller_mode, program, line, parts, motion_program, path_feed, path_feed_programmed,
         feed_override, rapid_override, path_position, tool_number, tool_asset, work_offset});
  return device;
}

}  // namespace trunnion::gateway::mtconnect
