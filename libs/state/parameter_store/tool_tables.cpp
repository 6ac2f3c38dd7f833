// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/tool_tables.hpp"

#include <sstream>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "machine/yaml.hpp"
#include "text/utf8.hpp"

namespace trunnion::tool_tables {
namespace {

constexpr double limit = 100000;         // mm or deg
constexpr double longest_life = 999999;  // minutes or pieces
constexpr std::uint32_t largest_tool = 99999999;
constexpr std::size_t name_bytes = 64, type_bytes = 32;
constexpr const char *minutes = "minutes", *pieces = "pieces";
using canonical::axis_letters;

std::string check_value(const std::string& who, double value, double minimum, double maximum = limit) {
  if (value >= minimum && value <= maximum) return "";
  std::ostringstream text;
  text << who << ": " << value << " is outside " << minimum << " .. " << maximum;
  return text.str();
}

std::string check_text(const std::string& who, const std::string& value, std::size_t most) {
  if (value.size() > most) return who + ": longer than " + std::to_string(most) + " bytes";
  return text::valid_utf8_prefix(value) != value.size() ? who + ": not UTF-8" : "";
}

template <class T>
T value(const std::string& file, const YAML::Node& node, const std::string& key) {
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(machine::at(file, node) + "'" + key + "' has a value of the wrong kind");
  }
}

/// The list itself, or the one under `key` beside its revision; nothing for an empty file.
YAML::Node list_of(const std::string& text, const std::string& file, const char* key,
                   std::uint64_t& revision) {
  const auto document = machine::parse_yaml(text, file);
  if (document.IsSequence() || document.IsNull()) return document;
  if (!document.IsMap()) throw std::runtime_error(machine::at(file, document) + "expected a list");
  for (const auto& entry : document) {
    const auto name = machine::scalar(file, entry.first);
    if (name == "revision")
      revision = value<std::uint64_t>(file, entry.second, name);
    else if (name != key)
      throw std::runtime_error(machine::at(file, entry.first) + "unknown key '" + name + "'");
  }
  const auto list = document[key];
  if (list && !list.IsSequence() && !list.IsNull())
    throw std::runtime_error(machine::at(file, list) + "expected a list");
  return list ? list : YAML::Node();
}

}  // namespace

std::string check_tool(const idl::parameters::Tool& tool) {
  const auto who = "tool " + std::to_string(tool.number);
  if (tool.number < 1 || tool.number > largest_tool)
    return who + ": the number is outside 1 .. " + std::to_string(largest_tool);
  for (const auto& error : {check_text(who + " (name)", tool.name, name_bytes),
                            check_text(who + " (type)", tool.type, type_bytes),
                            check_value(who + " (length)", tool.length, -limit),
                            check_value(who + " (length_wear)", tool.length_wear, -limit),
                            check_value(who + " (radius)", tool.radius, 0),
                            check_value(who + " (radius_wear)", tool.radius_wear, -limit),
                            check_value(who + " (life_used)", tool.life_used, 0, longest_life),
                            check_value(who + " (life_limit)", tool.life_limit, 0, longest_life)})
    if (!error.empty()) return error;
  return "";
}

std::string work_offset_code(std::uint8_t index) {
  constexpr std::uint8_t basic = 6, external = 54;
  if (index == external) return "EXT";
  if (index > external) return "G54.4P" + std::to_string(index - external);
  return index < basic ? "G" + std::to_string(54 + index) : "G54.1P" + std::to_string(index - basic + 1);
}

std::string check_offset(const idl::parameters::WorkOffset& offset) {
  const auto who =
      "channel " + std::to_string(offset.channel) + " work offset " + std::to_string(offset.index);
  if (offset.channel > 31) return who + ": the channel is outside 0 .. 31";
  if (offset.index >= work_offset_count)
    return who + ": the index is outside 0 .. " + std::to_string(work_offset_count - 1);
  if (offset.values.size() != 9) return who + ": expected nine values";
  for (std::size_t i = 0; i < 9; ++i) {
    auto error = check_value("channel " + std::to_string(offset.channel) + " " +
                                 work_offset_code(offset.index) + " " + axis_letters[i],
                             offset.values[i], -limit);
    if (!error.empty()) return error;
  }
  return "";
}

namespace {

idl::parameters::LifeUnit life_unit_of(const std::string& file, const YAML::Node& node,
                                       const std::string& key) {
  const auto name = value<std::string>(file, node, key);
  if (name == minutes) return idl::parameters::LifeUnit::MINUTES;
  if (name == pieces) return idl::parameters::LifeUnit::PIECES;
  throw std::runtime_error(machine::at(file, node) + "'" + name + "' is not " + minutes + " or " + pieces);
}

}  // namespace

Tools read_tools(const std::string& text, const std::string& file, std::uint64_t& revision) {
  Tools tools;
  for (const auto& node : list_of(text, file, "tools", revision)) {
    if (!node.IsMap()) throw std::runtime_error(machine::at(file, node) + "expected {number, length, ...}");
    idl::parameters::Tool tool;
    for (const auto& entry : node) {
      const auto key = machine::scalar(file, entry.first);
      if (key == "number")
        tool.number = value<std::uint32_t>(file, entry.second, key);
      else if (key == "length")
        tool.length = value<double>(file, entry.second, key);
      else if (key == "length_wear")
        tool.length_wear = value<double>(file, entry.second, key);
      else if (key == "radius")
        tool.radius = value<double>(file, entry.second, key);
      else if (key == "radius_wear")
        tool.radius_wear = value<double>(file, entry.second, key);
      else if (key == "name")
        tool.name = value<std::string>(file, entry.second, key);
      else if (key == "type")
        tool.type = value<std::string>(file, entry.second, key);
      else if (key == "life_used")
        tool.life_used = value<double>(file, entry.second, key);
      else if (key == "life_limit")
        tool.life_limit = value<double>(file, entry.second, key);
      else if (key == "life_unit")
        tool.life_unit = life_unit_of(file, entry.second, key);
      else
        throw std::runtime_error(machine::at(file, entry.first) + "unknown key '" + key + "'");
    }
    if (const auto error = check_tool(tool); !error.empty())
      throw std::runtime_error(machine::at(file, node) + error);
    if (!tools.emplace(tool.number, tool).second)
      throw std::runtime_error(machine::at(file, node) + "tool " + std::to_string(tool.number) +
                               " is given twice");
  }
  return tools;
}

std::string write_tools(const Tools& tools, std::uint64_t revision) {
  std::ostringstream out;
  out.precision(17);
  out << "revision: " << revision << "\ntools:\n";
  for (const auto& [number, tool] : tools) {
    out << "  - {number: " << number << ", length: " << tool.length << ", length_wear: " << tool.length_wear
        << ", radius: " << tool.radius << ", radius_wear: " << tool.radius_wear
        << ", name: " << machine::scalar_text(tool.name);
    // A version before 0.4 reads the table as long as these are not used.
    if (!tool.type.empty()) out << ", type: " << machine::scalar_text(tool.type);
    if (tool.life_used != 0) out << ", life_used: " << tool.life_used;
    if (tool.life_limit != 0) out << ", life_limit: " << tool.life_limit;
    if (tool.life_unit == idl::parameters::LifeUnit::PIECES) out << ", life_unit: " << pieces;
    out << "}\n";
  }
  return out.str();
}

Offsets read_offsets(const std::string& text, const std::string& file, std::uint64_t& revision) {
  Offsets offsets;
  for (const auto& node : list_of(text, file, "offsets", revision)) {
    if (!node.IsMap())
      throw std::runtime_error(machine::at(file, node) + "expected {channel, offset, X, ...}");
    idl::parameters::WorkOffset offset;
    offset.index = 255;
    offset.values.assign(9, 0.0);
    for (const auto& entry : node) {
      const auto key = machine::scalar(file, entry.first);
      const auto axis = key.size() == 1 ? axis_letters.find(key[0]) : std::string_view::npos;
      if (axis != std::string_view::npos) {
        offset.values[axis] = value<double>(file, entry.second, key);
      } else if (key == "channel") {
        offset.channel = value<std::uint16_t>(file, entry.second, key);
      } else if (key == "offset") {
        const auto code = value<std::string>(file, entry.second, key);
        std::uint8_t index = 0;
        while (index < work_offset_count && work_offset_code(index) != code) ++index;
        if (index == work_offset_count)
          throw std::runtime_error(machine::at(file, entry.second) + "'" + code +
                                   "' is not G54 .. G59, G54.1P1 .. G54.1P48, EXT or G54.4P1 .. G54.4P7");
        offset.index = index;
      } else {
        throw std::runtime_error(machine::at(file, entry.first) + "unknown key '" + key + "'");
      }
    }
    if (offset.index == 255) throw std::runtime_error(machine::at(file, node) + "'offset' is missing");
    if (const auto error = check_offset(offset); !error.empty())
      throw std::runtime_error(machine::at(file, node) + error);
    if (!offsets.emplace(std::pair(offset.channel, offset.index), offset).second)
      throw std::runtime_error(machine::at(file, node) + "the offset is given twice");
  }
  return offsets;
}

std::string write_offsets(const Offsets& offsets, std::uint64_t revision) {
  std::ostringstream out;
  out.precision(17);
  out << "revision: " << revision << "\noffsets:\n";
  for (const auto& [key, offset] : offsets) {
    out << "  - {channel: " << offset.channel << ", offset: " << work_offset_code(offset.index);
    for (std::size_t i = 0; i < 9; ++i) out << ", " << axis_letters[i] << ": " << offset.values[i];
    out << "}\n";
  }
  return out.str();
}

}  // namespace trunnion::tool_tables
