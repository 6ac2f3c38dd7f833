// SPDX-License-Identifier: Apache-2.0
// The spindle and coolant functions a program has commanded so far.
#pragma once

#include <cstdint>
#include <vector>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::program_execution {

using idl::channel::AuxiliaryKind;

/// One M, S, T, or order for a spindle or signal (E), of the handshake with the PLC.
struct AuxiliaryFunction {
  AuxiliaryKind kind = AuxiliaryKind::M;
  std::uint32_t code = 0;  ///< M or T number; of E as Command::number of kinds spindle_order and read
  double value = 0;        ///< S in 1/min, or m/min with G96; with has_value the angle of M19 in deg
  bool has_value = false;  ///< of M and E
  bool surface = false;    ///< of S: `value` is a surface speed (G96)
  double limit = 0;        ///< 1/min, of a surface speed; 0 = none
  double radius = 0;       ///< mm, of a surface speed: the axes are as far from the centre of the spindle
};

/// Takes every command of a program in its sequence and keeps the state they add up to. M codes of no group
/// have no state that could be restored; they are counted with the orders for spindles and the signals to the
/// PLC, so that the operator can be told.
class AuxiliaryMemory {
 public:
  void clear() { *this = {}; }
  void pass(const language::Command& command);

  /// A surface speed has the limit of the program and no radius. The functions that bring the machine to this
  /// state, in the sequence in which they must be given: speed, spindle, mist coolant, flood coolant, or
  /// coolant off. What no command has changed is left as it is.
  std::vector<AuxiliaryFunction> functions() const;
  /// The same, of those groups only that `other` has changed.
  std::vector<AuxiliaryFunction> functions_changed_by(const AuxiliaryMemory& other) const;

  /// M codes without a state, orders and signals that were passed: they are not repeated.
  std::uint32_t not_repeated() const { return not_repeated_; }

 private:
  std::vector<AuxiliaryFunction> functions(bool speed, bool spindle, bool coolant) const;
  bool has_speed_ = false, has_spindle_ = false, has_coolant_ = false;
  bool mist_ = false, flood_ = false;
  double speed_ = 0;
  bool surface_ = false;
  double limit_ = 0;
  std::uint32_t spindle_ = 5;
  double angle_ = 0;  // deg, of M19
  bool has_angle_ = false;
  std::uint32_t not_repeated_ = 0;
};

}  // namespace trunnion::program_execution
