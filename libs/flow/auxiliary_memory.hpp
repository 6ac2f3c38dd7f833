// What a program has asked of spindle, coolant and tool changer so far.
#pragma once

#include <cstdint>
#include <vector>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::flow {

using idl::channel::AuxiliaryKind;

/// One M, S or T of the handshake with the PLC (idl/channel.idl, AuxiliaryRequest).
struct AuxiliaryOrder {
  AuxiliaryKind kind = AuxiliaryKind::M;
  std::uint32_t code = 0;  ///< M or T number
  double value = 0;        ///< S in 1/min, or m/min with G96
};

/// Takes every command of a program in its order and remembers the state they add up to. M codes of no group
/// have no state that could be re-established; they are counted, so that somebody can say so.
class AuxiliaryMemory {
 public:
  void clear() { *this = {}; }
  void pass(const language::Command& command);

  /// The orders that bring the machine to this state, in the order they must be given: speed, spindle, mist
  /// coolant, flood coolant, or coolant off. What no command has asked for is left as it is.
  std::vector<AuxiliaryOrder> orders() const;
  /// The same, of those groups only that `other` has touched.
  std::vector<AuxiliaryOrder> orders_touched_by(const AuxiliaryMemory& other) const;

  /// M codes without a state that were passed: they are not repeated.
  std::uint32_t not_repeated() const { return not_repeated_; }
  bool touched() const { return has_speed_ || has_spindle_ || has_coolant_; }

 private:
  std::vector<AuxiliaryOrder> orders(bool speed, bool spindle, bool coolant) const;
  bool has_speed_ = false, has_spindle_ = false, has_coolant_ = false;
  bool mist_ = false, flood_ = false;
  double speed_ = 0;
  std::uint32_t spindle_ = 5;
  std::uint32_t not_repeated_ = 0;
};

}  // namespace trunnion::flow
