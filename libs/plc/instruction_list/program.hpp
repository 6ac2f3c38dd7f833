// SPDX-License-Identifier: Apache-2.0
// A compiled instruction list.
#pragma once

#include <string>
#include <vector>

#include "plc/machine/register_area.hpp"

namespace trunnion::il {

using Address = st::RegisterAddress;

/// Timers, counters and edges of all tasks together.
inline constexpr std::size_t timer_count = 256, counter_count = 256, edge_count = 512;

enum class Op : std::uint8_t {
  load,
  load_not,
  store,
  store_not,
  set,
  reset,
  invert,
  and_,
  and_not,
  or_,
  or_not,
  xor_,
  xor_not,
  add,
  subtract,
  multiply,
  divide,
  greater,
  greater_equal,
  equal,
  not_equal,
  less_equal,
  less,
  close,
  timer_on,
  timer_off,
  count_up,
  count_reset,
  rising,
  falling,
  move,
  jump,
  jump_if,
  jump_if_not,
};

struct Operand {
  bool is_constant = false;
  std::int32_t constant = 0;
  Address address;
};

struct Instruction {
  Op op = Op::load;
  bool opens = false;          ///< "(": the operator waits for the result up to the matching close
  std::uint16_t instance = 0;  ///< of a timer, counter or edge
  std::uint32_t target = 0;    ///< of a jump, always ahead
  Operand operand, second;     ///< `second` is the target of a move
};

inline constexpr int deepest_nesting = 16;

/// One place at which a register is used.
struct RegisterUse {
  Address address;
  std::string name;  ///< that VAR gives it; empty: by address or interface name
  int line = 1, column = 1;
  bool reads = false, writes = false;
};

struct Program {
  std::vector<Instruction> instructions;
  std::vector<Address> retained;  ///< of VAR RETAIN
  std::vector<RegisterUse> uses;  ///< in the order of the source
};

}  // namespace trunnion::il
