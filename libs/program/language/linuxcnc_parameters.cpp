// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_parameters.hpp"

namespace trunnion::language {
namespace {

constexpr auto predefined_keys = [] {
  std::array<NameKey, predefined_parameters.size()> keys{};
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = name_key(predefined_parameters[i].name);
  return keys;
}();

}  // namespace

const PredefinedParameter* predefined_parameter(NameKey name) {
  for (std::size_t i = 0; i < predefined_keys.size(); ++i)
    if (predefined_keys[i] == name) return &predefined_parameters[i];
  return nullptr;
}

const NumberedParameter* numbered_parameter(std::uint32_t number) {
  for (const NumberedParameter& row : numbered_parameters)
    if (number >= row.first && number <= row.last) return &row;
  return nullptr;
}

}  // namespace trunnion::language
