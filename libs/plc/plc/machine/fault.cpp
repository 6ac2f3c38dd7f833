// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/fault.hpp"

namespace trunnion::st {

std::string text_of(const Fault& fault) {
  const auto limits = [&] {
    return std::to_string(fault.value) + " is outside " + std::to_string(fault.low) + " .. " +
           std::to_string(fault.high);
  };
  switch (fault.kind) {
    case FaultKind::none:
      return "";
    case FaultKind::division:
      return "division by zero";
    case FaultKind::index:
      return "index " + limits() + " of the array";
    case FaultKind::range:
      return "value " + limits() + " of the type";
    case FaultKind::budget:
      return "more than " + std::to_string(fault.value) + " statements in one run";
    case FaultKind::reference:
      return "a reference to no variable";
    case FaultKind::assertion:
      return "the assertion is not met";
    case FaultKind::pointer:
      return "a pointer to byte " + std::to_string(fault.value) + " of a variable with the bytes " +
             std::to_string(fault.low) + " .. " + std::to_string(fault.high);
    case FaultKind::pointed_type:
      return "a pointer to a variable of another type";
  }
  return "";
}

}  // namespace trunnion::st
