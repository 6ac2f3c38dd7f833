// SPDX-License-Identifier: Apache-2.0
// Where programs read and write variables and registers.
#pragma once

#include <string>
#include <vector>

#include "plc/semantics/value.hpp"
#include "plc/syntax/diagnostics.hpp"

namespace trunnion::st {

struct Pou;

/// A name of a variable or register in a body.
struct Reference {
  Position at;
  const Pou* pou = nullptr;  ///< whose body it is
  const Variable* variable =
      nullptr;                ///< of VAR_EXTERNAL the global one; none: a register without declaration
  std::string member;         ///< of a structure or function block, in capitals, without indices: A.B
  std::string register_text;  ///< %X0.3, of a register and of a variable at one
  bool reads = false, writes = false;
  bool calls = false;  ///< a function block; its variables are read and written
  // What is written in memory; `count` 0: variables of a frame, which one task has alone.
  std::uint32_t first = 0, count = 0;
  std::uint64_t mask = 0;  ///< bits of each cell
};

inline Reference writing() {
  Reference access;
  access.writes = true;
  return access;
}

}  // namespace trunnion::st
