// SPDX-License-Identifier: Apache-2.0
#include "plc/devices/device_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::st {
namespace {

using machine::YamlReader;

constexpr machine::Limits seconds{0.001, 3600}, place_count{2, 255}, position{-1e5, 1e5};
constexpr std::size_t most_devices = 256, most_positions = 64;
constexpr machine::Limits byte_value{0, 255};
constexpr const char* type_names =
    "actuator, switch, magazine, position_switch, key, rotary_switch, handwheel";

enum class KeyKind : std::uint8_t { read_bit, flag, time, count, input_bit, input_byte };

// A key of devices.yaml and the variable of the block that it sets.
struct Key {
  const char* name;
  const char* variable;
  KeyKind kind;
  bool required;
};

struct DeviceType {
  const char* name;
  const char* block;
  std::vector<Key> keys;
};

const std::vector<DeviceType>& device_types() {
  using enum KeyKind;
  static const std::vector<DeviceType> types{{"actuator",
                                              "SIM_ACTUATOR",
                                              {{"extend", "extend", read_bit, true},
                                               {"retract", "retract", read_bit, false},
                                               {"spring_return", "spring_return", flag, false},
                                               {"blocked", "blocked", read_bit, false},
                                               {"travel_s", "travel", time, true},
                                               {"extended", "extended", input_bit, false},
                                               {"retracted", "retracted", input_bit, false}}},
                                             {"switch",
                                              "SIM_SWITCH",
                                              {{"command", "command", read_bit, true},
                                               {"fault", "fault", read_bit, false},
                                               {"on_s", "on_time", time, false},
                                               {"off_s", "off_time", time, false},
                                               {"on", "on", input_bit, true}}},
                                             {"magazine",
                                              "SIM_MAGAZINE",
                                              {{"forward", "forward", read_bit, true},
                                               {"backward", "backward", read_bit, false},
                                               {"places", "places", count, true},
                                               {"step_s", "step", time, true},
                                               {"place", "place", input_byte, true},
                                               {"at_place", "at_place", input_bit, false}}}};
  return types;
}

// A bit or byte of X, Y, F, G or R, as written in lower or upper case.
std::optional<RegisterAddress> address_of(const std::string& text) {
  const char* problem = nullptr;
  auto address = parse_register(text, &problem);
  return address && address->area <= Area::r ? address : std::nullopt;
}

class DeviceReader {
 public:
  DeviceReader(const std::string& file, const RegisterNames& registers)
      : reader_(file), registers_(registers) {}

  SimulatedDevices read(const YAML::Node& root) {
    if (!root.IsMap() || root.size() > most_devices)
      reader_.fail(root, "expected 1 .. " + std::to_string(most_devices) + " devices by their names");
    std::string variables, calls;
    for (const auto& entry : root) {
      const auto name = reader_.text(entry.first);
      if (!is_name(name))
        reader_.fail(entry.first,
                     "'" + name + "' is no name of a device: letters, digits and single underscores");
      std::string key = name;
      std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::toupper(c); });
      if (!names_.insert(key).second) reader_.fail(entry.first, "'" + name + "' is there twice");
      device(name, entry.second, variables, calls);
    }
    if (!variables.empty()) variables = "VAR\n" + variables + "END_VAR\n";
    if (!calls.empty()) out_.program = "PROGRAM simulation\n" + variables + calls + "END_PROGRAM\n";
    return std::move(out_);
  }

 private:
  // An identifier of IEC 61131-3 that is no keyword: the devices get a prefix.
  static bool is_name(const std::string& text) {
    if (text.empty() || text.size() > 32 || std::isalpha(static_cast<unsigned char>(text[0])) == 0)
      return false;
    if (text.back() == '_' || text.find("__") != std::string::npos) return false;
    return std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_'); });
  }

  void device(const std::string& name, const YAML::Node& node, std::string& variables, std::string& calls) {
    YAML::Node values;
    std::string type;
    reader_.each(node, std::string("one of ") + type_names,
                 [&](const std::string& key, const YAML::Node& value) {
                   if (!is_panel(key) && key != "position_switch" &&
                       std::none_of(device_types().begin(), device_types().end(),
                                    [&](const auto& t) { return key == t.name; }))
                     return false;
                   if (!type.empty())
                     reader_.fail(value, "'" + type + "' is there already: one device, one type");
                   type = key;
                   values = value;
                   return true;
                 });
    if (type.empty()) reader_.fail(node, std::string("a type is missing: one of ") + type_names);
    if (type == "key") return key(values);
    if (type == "rotary_switch") return rotary_switch(values, calls);
    if (type == "handwheel") return handwheel(name, values, variables, calls);
    if (type == "position_switch") return position_switch(values);
    const auto& found = *std::find_if(device_types().begin(), device_types().end(),
                                      [&](const auto& t) { return type == t.name; });
    variables.append("  device_").append(name).append(" : ").append(found.block).append(";\n");
    calls.append("device_").append(name).append("(").append(arguments(found, values)).append(");\n");
  }

  std::string arguments(const DeviceType& type, const YAML::Node& values) {
    std::string keys, text;
    for (const auto& key : type.keys) keys.append(keys.empty() ? "" : ", ").append(key.name);
    std::set<std::string> seen;
    reader_.each(values, keys, [&](const std::string& name, const YAML::Node& value) {
      const auto key =
          std::find_if(type.keys.begin(), type.keys.end(), [&](const Key& k) { return name == k.name; });
      if (key == type.keys.end()) return false;
      seen.insert(name);
      text.append(text.empty() ? "" : ", ").append(key->variable);
      text.append(key->kind == KeyKind::input_bit || key->kind == KeyKind::input_byte ? " => " : " := ");
      text.append(argument(*key, value));
      return true;
    });
    for (const auto& key : type.keys)
      if (key.required && seen.count(key.name) == 0)
        reader_.fail(values, std::string("'").append(key.name).append("' is missing"));
    return text;
  }

  std::string argument(const Key& key, const YAML::Node& value) {
    switch (key.kind) {
      case KeyKind::read_bit:
        return read_bit(value);
      case KeyKind::flag:
        return reader_.choice<std::string>(value, {{"true", "TRUE"}, {"false", "FALSE"}});
      case KeyKind::time:
        return "T#" + std::to_string(std::lround(1000 * reader_.number(value, seconds))) + "ms";
      case KeyKind::count: {
        const double number = reader_.number(value, place_count);
        if (number != std::floor(number)) reader_.fail(value, "expected a whole number");
        return std::to_string(std::lround(number));
      }
      case KeyKind::input_bit:
        return "%" + input(value, true);
      case KeyKind::input_byte:
        return "%" + input(value, false);
    }
    return "";
  }

  std::string read_bit(const YAML::Node& node) {
    const auto text = reader_.text(node);
    if (const auto address = address_of(text); address && address->bit >= 0) return "%" + text;
    std::string name = text;
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    const auto found = registers_.find(name);
    if (found == registers_.end() || found->second.bit < 0)
      reader_.fail(node, "'" + text + "' is no bit: an address as Y16.0 or a name of docs/plc-registers.md");
    return text;
  }

  // An address of area X that nothing else writes.
  std::string input(const YAML::Node& node, bool bit) { return claim(node, reader_.text(node), bit); }

  std::string claim(const YAML::Node& node, const std::string& text, bool bit) {
    const auto address = address_of(text);
    if (!address || address->area != Area::x || (address->bit >= 0) != bit)
      reader_.fail(node, "'" + text + "' is no " + (bit ? "input bit as X16.0" : "input byte as X20") +
                             " (X0 .. X511)");
    std::uint16_t& written = written_[address->index];
    const auto bits = static_cast<std::uint16_t>(bit ? 1u << address->bit : 0xffu);
    if ((written & bits) != 0) reader_.fail(node, text + " is written by another device already");
    written = static_cast<std::uint16_t>(written | bits);
    return text;
  }

  void position_switch(const YAML::Node& values) {
    PositionSwitch found;
    YAML::Node on;
    bool low = false, high = false;
    reader_.each(values, "axis, from, to, on", [&](const std::string& key, const YAML::Node& value) {
      if (key == "axis") return found.axis = reader_.text(value), true;
      if (key == "from") return found.low = reader_.number(value, position), low = true;
      if (key == "to") return found.high = reader_.number(value, position), high = true;
      return key == "on" && (on = value, true);
    });
    if (found.axis.empty() || !low || !high || !on.IsDefined() || on.IsNull())
      reader_.fail(values, "a position switch has 'axis', 'from', 'to' and 'on'");
    if (found.low > found.high) reader_.fail(values, "'from' is above 'to'");
    found.input = *address_of(input(on, true));
    out_.switches.push_back(found);
  }

  static bool is_panel(const std::string& type) {
    return type == "key" || type == "rotary_switch" || type == "handwheel";
  }

  // Pressed by the page or a test: nothing of the machine moves it.
  void key(const YAML::Node& values) {
    bool has_input = false;
    reader_.each(values, "input, lamp", [&](const std::string& name, const YAML::Node& value) {
      if (name == "input") return input(value, true), has_input = true;
      return name == "lamp" && (read_bit(value), true);
    });
    if (!has_input) reader_.fail(values, "'input' is missing");
  }

  // The value of its position; of one that it does not have, the last.
  void rotary_switch(const YAML::Node& values, std::string& calls) {
    std::string position, value, cases;
    reader_.each(values, "position, values, value", [&](const std::string& name, const YAML::Node& node) {
      if (name == "position") return position = input(node, false), true;
      if (name == "value") return value = input(node, false), true;
      if (name != "values") return false;
      const auto numbers = reader_.numbers(node, most_positions, byte_value);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] != std::floor(numbers[i])) reader_.fail(node[i], "expected a whole number");
        cases.append("  ").append(std::to_string(i)).append(": %@ := ");
        cases.append(std::to_string(std::lround(numbers[i]))).append(";\n");
      }
      return true;
    });
    if (position.empty() || value.empty() || cases.empty())
      reader_.fail(values, "a rotary switch has 'position', 'values' and 'value'");
    for (auto at = cases.find('@'); at != std::string::npos; at = cases.find('@'))
      cases.replace(at, 1, value);
    calls.append("CASE %").append(position).append(" OF\n").append(cases).append("END_CASE;\n");
  }

  void handwheel(const std::string& name, const YAML::Node& values, std::string& variables,
                 std::string& calls) {
    std::string turned, low, high;
    reader_.each(values, "turned, counter", [&](const std::string& key, const YAML::Node& node) {
      if (key == "turned") return turned = input(node, false), true;
      if (key != "counter") return false;
      low = input(node, false);
      const auto next = address_of(low)->index + 1u;
      if (next >= info(Area::x).count)
        reader_.fail(node, "the counter has two bytes: the second one leaves area X");
      high = claim(node, "X" + std::to_string(next), false);
      return true;
    });
    if (turned.empty() || low.empty()) reader_.fail(values, "a handwheel has 'turned' and 'counter'");
    variables.append("  device_").append(name).append(" : SIM_HANDWHEEL;\n");
    calls.append("device_").append(name).append("(turned := %").append(turned).append(", low => %");
    calls.append(low).append(", high => %").append(high).append(");\n");
  }

  YamlReader reader_;
  const RegisterNames& registers_;
  std::set<std::string> names_;
  std::map<std::uint16_t, std::uint16_t> written_;  // bits of the bytes of area X
  SimulatedDevices out_;
};

}  // namespace

SimulatedDevices read_devices(const std::string& yaml, const std::string& file,
                              const RegisterNames& registers) {
  return DeviceReader(file, registers).read(machine::parse_yaml(yaml, file));
}

}  // namespace trunnion::st
