// SPDX-License-Identifier: Apache-2.0
// What an expression gives: a constant, or a place in the memory of the machine.
#pragma once

#include <span>
#include <string>

#include "plc/semantics/type.hpp"

namespace trunnion::st {

struct Variable;

/// Where a variable or an intermediate result is.
struct Place {
  enum class Base { none, frame, absolute, indirect, pointer };
  Base base = Base::none;
  std::int32_t offset = 0;  ///< cells: in the frame, in memory, or behind the address in `cell`
  std::int32_t cell = 0;    ///< frame cell with the address, or the pointer; of that `offset` is bytes
  int bit = -1, width = 0;  ///< of a partial access: first bit and bits
  std::uint16_t form = 0;   ///< of a register whose cell has another form than the type; see Op::narrow
  bool writable = false;
  std::string refusal;            ///< why it is not writable, as the end of a sentence
  const Type* pointed = nullptr;  ///< behind a pointer: of what it reads and writes
};

struct Value {
  const Type* type = nullptr;
  bool is_constant = false;
  std::int64_t integer = 0;  ///< of integers, bit strings, times, enumerations; ULINT by its bits
  bool large = false;        ///< a literal above the largest LINT, by its bits
  double real = 0;
  std::string text;  ///< of strings; of a real literal its digits, "" when computed
  Place place;
  Variable* variable = nullptr;  ///< the variable itself, not a part of it
  std::int32_t limits = -1;      ///< of ARRAY[*]: the first of the cells of the frame with its limits

  bool is_error() const { return type->kind == Kind::error; }
  bool is_literal() const { return type->kind == Kind::integer_literal || type->kind == Kind::real_literal; }
};

Value constant_integer(const Type* type, std::int64_t value);
Value constant_real(const Type* type, double value);
/// The type of literals of the kind `type` that only the machine chooses between: `expected`, that of what
/// takes the value, if it has all of them.
const Type* literal_type(const Type& type, std::span<const Value> values, const Type* expected);
/// The cell of a constant as a value of the elementary type, to which it converts.
std::uint64_t constant_cell(const Value& value, const Type& to);

}  // namespace trunnion::st
