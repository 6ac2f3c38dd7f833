// SPDX-License-Identifier: Apache-2.0
// The registers that the programs in Structured Text use, into the cells of their memory and back: twice for
// each task of each scan, so without a decision for each register.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "memory.hpp"
#include "plc/machine/register_area.hpp"

namespace trunnion::plc {

class RegisterTransfer {
 public:
  RegisterTransfer() = default;
  explicit RegisterTransfer(std::span<const st::UsedRegister> used);

  /// All that are used, with their signs extended to 64 bits.
  void load(const Registers& registers, std::span<std::uint64_t> memory) const;
  /// Those that are written; a value saturates at the limits of its register.
  void store(std::span<const std::uint64_t> memory, Registers& registers) const;

 private:
  struct Place {
    std::uint32_t cell;
    std::uint16_t index;
  };
  using Places = std::array<std::vector<Place>, st::areas.size()>;
  Places used_, written_;
};

}  // namespace trunnion::plc
