// SPDX-License-Identifier: Apache-2.0
// What the constants of parameters (machine/parameter_constants.hpp) are made of.
#pragma once

#include <cstdint>

namespace trunnion::machine {

/// A parameter, or several with consecutive numbers, of every unit of its class.
struct ParameterKey {
  constexpr ParameterKey(std::uint32_t first_number, const char* catalogue_name)
      : first(first_number), name(catalogue_name) {}

  /// Of unit `unit` (channel, axis; 0 where the class has one unit), the `index`th of those with this name.
  constexpr std::uint32_t number(std::uint32_t unit = 0, std::uint32_t index = 0) const {
    return first + unit * 1000 + index;
  }

  std::uint32_t first;  ///< number of unit 0, index 0
  const char* name;     ///< in catalogue.yaml
};

struct NumericParameter : ParameterKey {
  using ParameterKey::ParameterKey;
};
struct IntegerParameter : NumericParameter {
  using NumericParameter::NumericParameter;
};
struct RealParameter : NumericParameter {
  using NumericParameter::NumericParameter;
};
struct TextParameter : ParameterKey {
  using ParameterKey::ParameterKey;
};

}  // namespace trunnion::machine
