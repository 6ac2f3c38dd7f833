// SPDX-License-Identifier: Apache-2.0
// The spindle and coolant functions a program has commanded so far.
#pragma once

#include <cstdint>
#include <vector>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::program_execution {

using idl::channel::AuxiliaryKind;

/// One M, S or T of the handshake with the PLC.
struct AuxiliaryFunction {
  AuxiliaryKind kind = AuxiliaryKind::M;
  std::uint32_t code = 0;  ///< M or T number
  double value = 0;        ///< S in 1/min, or m/min with G96
};

/// Takes every command of a program in its sequence and keeps the state they add up to. M codes of no group
/// have no state that could be restored; they are counted, so that the operator can be told.
class AuxiliaryMemory {
 public:
  void clear() { *this = {}; }
  void pass(const language::Command& command);

  /// The functions that bring the machine to this state, in the sequence in which they must be given: speed,
  /// spindle, mist coolant, flood coolant, or coolant off. What no command has changed is left as it is.
  std::vector<AuxiliaryFunction> functions() const;
  /// The same, of those groups only that `other` has changed.
  std::vector<AuxiliaryFunction> functions_changed_by(const AuxiliaryMemory& other) const;

  /// M codes without a state that were passed: they are not repeated.
  std::uint32_t not_repeated() const { return not_repeated_; }

 private:
  std::vector<AuxiliaryFunction> functions(bool speed, bool spindle, bool coolant) const;
  bool has_speed_ = false, has_spindle_ = false, has_coolant_ = false;
  bool mist_ = false, flood_ = false;
  double speed_ = 0;
  std::uint32_t spindle_ = 5;
  std::uint32_t not_repeated_ = 0;
};

}  // namespace trunnion::program_execution
