// SPDX-License-Identifier: Apache-2.0
#include "machine/parameters.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>

#include "machine/parameter_constants.hpp"
#include "machine/yaml.hpp"
#include "text/utf8.hpp"

namespace trunnion::machine {

extern const char* const catalogue_text;

const char* to_string(Activation activation) {
  switch (activation) {
    case Activation::save:
      return "save";
    case Activation::reset:
      return "reset";
    case Activation::restart:
      return "restart";
  }
  return "";
}

const char* to_string(ParameterType type) {
  switch (type) {
    case ParameterType::integer:
      return "integer";
    case ParameterType::real:
      return "real";
    case ParameterType::text:
      return "text";
  }
  return "";
}

std::string number_text(std::uint32_t number) {
  char out[16];
  std::snprintf(out, sizeof out, "%06u", number);
  return out;
}

const Catalogue& Catalogue::instance() {
  static const Catalogue catalogue = parse(catalogue_text);
  return catalogue;
}

Catalogue Catalogue::parse(const std::string& yaml) {
  Catalogue result;
  const auto document = parse_yaml(yaml, "catalogue.yaml");
  const auto classes = document["classes"];
  std::set<std::string> names;
  for (const auto& node : document["parameters"]) {
    Definition d;
    const auto text = [&](const char* key) {
      return node[key] ? node[key].as<std::string>() : std::string();
    };
    d.name = text("name"), d.unit = text("unit"), d.help = text("help"), d.access = text("access");
    const auto group = classes[text("class")];
    if (!group)
      throw std::runtime_error(at("catalogue.yaml", node) + "unknown class '" + text("class") + "'");
    d.base = group["base"].as<std::uint32_t>();
    d.units = group["units"].as<std::uint32_t>();
    d.offset = node["offset"].as<std::uint32_t>();
    if (node["count"]) d.count = node["count"].as<std::uint32_t>();
    const auto type = text("type"), activation = text("activation");
    d.type = type == "integer" ? ParameterType::integer
             : type == "text"  ? ParameterType::text
                               : ParameterType::real;
    d.activation = activation == "save"      ? Activation::save
                   : activation == "restart" ? Activation::restart
                                             : Activation::reset;
    if (d.type != ParameterType::text) {
      d.minimum = node["min"].as<double>();
      d.maximum = node["max"].as<double>();
      if (node["default"].IsSequence())
        d.defaults = node["default"].as<std::vector<double>>();
      else
        d.defaults = {node["default"].as<double>()};
      for (const double value : d.defaults)
        if (!(value >= d.minimum && value <= d.maximum))
          throw std::runtime_error(at("catalogue.yaml", node) + "default of " + d.name +
                                   " is outside its limits");
    }
    if (!names.insert(d.name).second)
      throw std::runtime_error(at("catalogue.yaml", node) + "'" + d.name + "' is defined twice");
    result.definitions_.push_back(std::move(d));
  }
  return result;
}

const Definition* Catalogue::find(std::uint32_t number) const {
  for (const auto& d : definitions_) {
    if (number < d.base || number >= d.base + (d.units > 1 ? d.units * 1000 : 10000)) continue;
    const std::uint32_t offset = d.units > 1 ? (number - d.base) % 1000 : number - d.base;
    if (offset >= d.offset && offset < d.offset + d.count) return &d;
  }
  return nullptr;
}

double Catalogue::default_of(std::uint32_t number) const {
  const auto* d = find(number);
  if (d == nullptr) return 0;
  const std::uint32_t offset = d->units > 1 ? (number - d->base) % 1000 : number - d->base;
  return d->default_at(offset - d->offset);
}

std::string Catalogue::check(std::uint32_t number, double value, const std::string& text,
                             const std::string& unit) const {
  const auto* d = find(number);
  if (d == nullptr) return "parameter " + number_text(number) + " does not exist";
  const auto who = "parameter " + number_text(number) + " (" + d->name + ")";
  if (d->type == ParameterType::text) {
    if (text.size() > 64) return who + ": text of " + std::to_string(text.size()) + " bytes, at most 64";
    return text::valid_utf8_prefix(text) == text.size() ? "" : who + ": the text is not UTF-8";
  }
  if (!text.empty()) return who + ": expected a number, got '" + text + "'";
  if (!(value >= d->minimum && value <= d->maximum)) {
    std::ostringstream limits;
    limits << std::setprecision(15) << who << ": " << value << " is outside " << d->minimum << " .. "
           << d->maximum;
    if (!d->unit.empty()) limits << " " << (unit.empty() ? d->unit : unit);
    return limits.str();
  }
  if (d->type == ParameterType::integer && value != std::floor(value)) {
    std::ostringstream whole;
    whole << who << ": " << value << " is not a whole number";
    return whole.str();
  }
  return "";
}

double Parameters::at(std::uint32_t number) const {
  const auto found = values.find(number);
  return found != values.end() ? found->second.value : Catalogue::instance().default_of(number);
}

double Parameters::get(const NumericParameter& parameter, std::uint32_t unit, std::uint32_t index) const {
  return at(parameter.number(unit, index));
}

int Parameters::integer(const IntegerParameter& parameter, std::uint32_t unit, std::uint32_t index) const {
  return static_cast<int>(get(parameter, unit, index));
}

std::string unit_of(std::uint32_t number, const std::map<std::uint32_t, ParameterValue>& values) {
  const auto& catalogue = Catalogue::instance();
  const auto* d = catalogue.find(number);
  if (d == nullptr) return "";
  const auto bar = d->unit.find('|');
  if (bar == std::string::npos) return d->unit;
  const auto type_number = parameter::axis_type.number((number - d->base) / 1000);
  const auto found = values.find(type_number);
  const double type = found != values.end() ? found->second.value : catalogue.default_of(type_number);
  constexpr double linear = 1;
  return type == linear ? d->unit.substr(0, bar) : d->unit.substr(bar + 1);
}

std::string Parameters::text(const TextParameter& parameter, std::uint32_t unit, std::uint32_t index) const {
  const auto found = values.find(parameter.number(unit, index));
  return found != values.end() ? found->second.text : "";
}

namespace {

/// Makes the value of a parameter from what is in the file. Empty, or why the catalogue refuses it.
std::string take(const Definition* definition, const std::string& key, const std::string& text,
                 ParameterValue& value) {
  if (definition == nullptr) return "parameter " + key + " does not exist";
  if (definition->type == ParameterType::text)
    value.text = text;
  else if (!YAML::convert<double>::decode(YAML::Node(text), value.value))
    return "parameter " + key + " (" + definition->name + "): '" + text + "' is not a number";
  return Catalogue::instance().check(static_cast<std::uint32_t>(std::stoul(key)), value.value, value.text);
}

/// `refused` is called for a value that the catalogue refuses, `failed` for what is no line of a parameter.
template <class Refused, class Failed>
ParameterText read(const YAML::Node& map, const std::string& file, Refused&& refused, Failed&& failed) {
  ParameterText result;
  if (!map || map.IsNull()) return result;
  if (!map.IsMap()) {
    failed(at(file, map) + "expected lines of 'number: value'");
    return result;
  }
  for (const auto& entry : map) {
    if (!entry.first.IsScalar() || !entry.second.IsScalar()) {
      failed(at(file, entry.first.IsScalar() ? entry.second : entry.first) + "expected one value");
      continue;
    }
    const auto& key = entry.first.Scalar();
    if (key.size() != 6 || key.find_first_not_of("0123456789") != std::string::npos) {
      failed(at(file, entry.first) + "'" + key + "' is not a parameter number of six digits");
      continue;
    }
    const auto number = static_cast<std::uint32_t>(std::stoul(key));
    const auto* definition = Catalogue::instance().find(number);
    ParameterValue value;
    if (const auto error = take(definition, key, entry.second.Scalar(), value); !error.empty()) {
      refused(at(file, definition == nullptr ? entry.first : entry.second) + error);
      continue;
    }
    if (result.values.emplace(number, value).second)
      result.places.emplace(number, at(file, entry.second));
    else
      failed(at(file, entry.first) + "parameter " + key + " is given twice");
  }
  return result;
}

}  // namespace

std::map<std::uint32_t, ParameterValue> read_parameter_values(const YAML::Node& map, const std::string& file,
                                                              bool strict) {
  const auto fail = [](const std::string& error) { throw std::runtime_error(error); };
  const auto refuse = [&](const std::string& error) {
    if (strict) fail(error);
  };
  return read(map, file, refuse, fail).values;
}

ParameterText check_parameter_text(const std::string& text, const std::string& file) {
  std::vector<std::string> errors;
  const auto note = [&](const std::string& error) { errors.push_back(error); };
  ParameterText result;
  try {
    result = read(parse_yaml(text, file), file, note, note);
  } catch (const std::runtime_error& e) {
    note(e.what());
  }
  result.errors = std::move(errors);
  return result;
}

std::map<std::uint32_t, ParameterValue> read_parameter_text(const std::string& text,
                                                            const std::string& file) {
  return read_parameter_values(parse_yaml(text, file), file, true);
}

std::map<std::uint32_t, ParameterValue> read_parameter_file(const std::string& path) {
  return read_parameter_text(read_text(path), path);
}

std::string write_parameter_text(const std::map<std::uint32_t, ParameterValue>& values) {
  std::ostringstream out;
  out.precision(17);
  for (const auto& [number, value] : values) {
    const auto* definition = Catalogue::instance().find(number);
    if (definition == nullptr) continue;
    out << '"' << number_text(number) << "\": ";
    if (definition->type == ParameterType::text)
      out << scalar_text(value.text);
    else
      out << value.value;
    out << "  # " << definition->name << (definition->unit.empty() ? "" : ", " + unit_of(number, values))
        << "\n";
  }
  return out.str();
}

}  // namespace trunnion::machine
