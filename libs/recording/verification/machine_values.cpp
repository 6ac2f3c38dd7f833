// SPDX-License-Identifier: Apache-2.0
#include "verification/machine_values.hpp"

#include <optional>
#include <set>

#include "bus/codec.hpp"
#include "contracts/types.hpp"
#include "text/quantity.hpp"

namespace trunnion::verification {
namespace {

using ParameterValues = std::map<std::uint32_t, machine::ParameterValue>;

machine::ParameterValue default_value(std::uint32_t number) {
  return {machine::Catalogue::instance().default_of(number), ""};
}

machine::ParameterValue value_in(const ParameterValues& values, std::uint32_t number) {
  const auto found = values.find(number);
  return found != values.end() ? found->second : default_value(number);
}

std::string quantity_in(const ParameterValues& values, std::uint32_t number) {
  constexpr int digits = 9;
  const auto value = value_in(values, number);
  const auto* definition = machine::Catalogue::instance().find(number);
  if (definition != nullptr && definition->type == machine::ParameterType::text)
    return "'" + value.text + "'";
  return text::quantity(value.value, machine::unit_of(number, values), digits);
}

std::optional<ParameterValues> newest_values(const StoredRecording& recording) {
  std::optional<ParameterValues> values;
  idl::parameters::ParameterSet set;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "parameter_set" && bus::decode(message.cdr, set))
      values = machine::parameters_of(set).values;
  return values;
}

}  // namespace

std::string parameters_apart(const StoredRecording& recording, const ParameterValues& delivered) {
  const auto recorded = newest_values(recording);
  if (!recorded) return "";
  std::set<std::uint32_t> numbers;
  for (const auto* values : {&*recorded, &delivered})
    for (const auto& entry : *values) numbers.insert(entry.first);
  std::erase_if(numbers, [&](std::uint32_t number) {
    return value_in(*recorded, number) == value_in(delivered, number);
  });
  if (numbers.empty()) return "";
  const auto first = *numbers.begin();
  const auto* definition = machine::Catalogue::instance().find(first);
  return std::to_string(numbers.size()) +
         (numbers.size() == 1 ? " parameter differs, " : " parameters differ, the first is ") +
         machine::number_text(first) + (definition == nullptr ? "" : " (" + definition->name + ")") + ": " +
         quantity_in(*recorded, first) + " recorded, " + quantity_in(delivered, first) + " there";
}

void use_parameters(StoredRecording& recording, const ParameterValues& delivered) {
  idl::parameters::ParameterSet set;
  for (auto& message : recording.messages) {
    if (message.topic->handle != "parameter_set" || !bus::decode(message.cdr, set)) continue;
    set.values.clear();
    set.pending.clear();
    for (const auto& [number, value] : delivered)
      if (value != default_value(number)) set.values.push_back({number, value.value, value.text});
    bus::encode(set, message.cdr);
  }
}

}  // namespace trunnion::verification
