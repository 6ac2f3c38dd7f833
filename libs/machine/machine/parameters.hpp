// SPDX-License-Identifier: Apache-2.0
// The parameter catalogue and a set of values: numbers, names, limits and activation (design: "Parameters").
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "machine/parameter_key.hpp"

namespace YAML {
class Node;
}

namespace trunnion::machine {

enum class Activation { save, reset, restart };
enum class ParameterType { integer, real, text };

/// One line of catalogue.yaml; several consecutive numbers share it when `count` is above 1.
struct Definition {
  std::string name;
  std::string unit;
  std::string help;
  std::string access;
  ParameterType type = ParameterType::real;
  Activation activation = Activation::reset;
  double minimum = 0, maximum = 0;
  std::vector<double> defaults;  ///< one, or one for each of count
  std::uint32_t base = 0;        ///< number of the class's unit 0
  std::uint32_t offset = 0;
  std::uint32_t count = 1;
  std::uint32_t units = 1;

  std::uint32_t number(std::uint32_t unit_number = 0, std::uint32_t index = 0) const {
    return base + unit_number * 1000 + offset + index;
  }
  double default_at(std::uint32_t index) const {
    return defaults.empty() ? 0 : defaults.size() == 1 ? defaults[0] : defaults[index];
  }
};

const char* to_string(Activation activation);
const char* to_string(ParameterType type);

/// Six digits, as on the parameter screen.
std::string number_text(std::uint32_t number);

/// The catalogue that is compiled in from libs/machine/machine/catalogue.yaml.
class Catalogue {
 public:
  static const Catalogue& instance();
  /// Throws std::runtime_error with line:column.
  static Catalogue parse(const std::string& yaml);

  const std::vector<Definition>& definitions() const { return definitions_; }
  /// Null when there is no such parameter.
  const Definition* find(std::uint32_t number) const;
  double default_of(std::uint32_t number) const;
  /// Empty when `value` may be stored, else one line that names the parameter and its limits, in `unit` when
  /// that is given (see unit_of()).
  std::string check(std::uint32_t number, double value, const std::string& text,
                    const std::string& unit = "") const;

 private:
  std::vector<Definition> definitions_;
};

struct ParameterValue {
  double value = 0;
  std::string text;
  bool operator==(const ParameterValue&) const = default;
};

/// The catalogue's unit of parameter `number` of a machine with these values: of "mm|deg" the one its axis is
/// measured in.
std::string unit_of(std::uint32_t number, const std::map<std::uint32_t, ParameterValue>& values);

/// Values that differ from the defaults, by number, with access by the constants of
/// machine/parameter_constants.hpp. `unit` is the number of the channel or axis.
class Parameters {
 public:
  double get(const NumericParameter& parameter, std::uint32_t unit = 0, std::uint32_t index = 0) const;
  int integer(const IntegerParameter& parameter, std::uint32_t unit = 0, std::uint32_t index = 0) const;
  std::string text(const TextParameter& parameter, std::uint32_t unit = 0, std::uint32_t index = 0) const;
  double at(std::uint32_t number) const;

  std::map<std::uint32_t, ParameterValue> values;
  std::uint64_t revision = 0;
};

/// Those of an active set as the parameters service publishes it (ParameterSet of idl/parameters.idl, which
/// this library does not know).
template <class Set>
Parameters parameters_of(const Set& set) {
  Parameters parameters;
  parameters.revision = set.revision;
  for (const auto& value : set.values) parameters.values[value.number] = {value.value, value.text};
  return parameters;
}

/// `number: value` lines (numbers quoted, six digits) of a map; nothing of an empty node. Values that the
/// catalogue refuses are an error when `strict`, else left out. Throws std::runtime_error with
/// file:line:column.
std::map<std::uint32_t, ParameterValue> read_parameter_values(const YAML::Node& map, const std::string& file,
                                                              bool strict);
/// All of `text` that can be understood, and everything that cannot.
struct ParameterText {
  std::map<std::uint32_t, ParameterValue> values;
  std::map<std::uint32_t, std::string> places;  ///< "file:line:column: error: " of each value
  std::vector<std::string> errors;              ///< with file:line:column
};
/// Never throws for what is in the text.
ParameterText check_parameter_text(const std::string& text, const std::string& file);
/// Strictly, from a text that is said to be that of `file`, and from the file.
std::map<std::uint32_t, ParameterValue> read_parameter_text(const std::string& text, const std::string& file);
std::map<std::uint32_t, ParameterValue> read_parameter_file(const std::string& path);
std::string write_parameter_text(const std::map<std::uint32_t, ParameterValue>& values);

}  // namespace trunnion::machine
