// SPDX-License-Identifier: Apache-2.0
// The data types of IEC 61131-3:2013, 6.4, and which values convert to which by themselves.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::st {

enum class Kind : std::uint8_t {
  boolean,
  byte,
  word,
  dword,
  lword,
  sint,
  int_,
  dint,
  lint,
  usint,
  uint_,
  udint,
  ulint,
  real,
  lreal,
  time,
  ltime,
  date,
  tod,
  dt,
  string,
  enumeration,
  array,
  structure,
  block,
  interface_,       ///< one cell: the place of an instance and which block it is of; see null_reference
  reference,        ///< one cell: the address of a variable of the type `element`
  pointer,          ///< one cell: POINTER TO `element`, see machine/pointer.hpp
  null_,            ///< NULL
  integer_literal,  ///< takes the type of what it meets
  real_literal,
  none,   ///< result of a function without one
  error,  ///< reported already
};

struct Type;

struct Field {
  std::string name, text;  ///< in capitals, as written
  const Type* type = nullptr;
  std::uint32_t offset = 0;  ///< cells
};

struct Enumerator {
  std::string name, text;
  std::int64_t value = 0;
};

struct Dimension {
  std::int64_t low = 0, high = 0;
};

struct Block;  // a function block with its parameters
struct Interface;

/// NULL: an address that no memory has, so that its use is a fault.
inline constexpr std::uint64_t null_reference = std::uint64_t{1} << 63;
/// Bits of the address in a value of an interface; the number of the block is above it.
inline constexpr int address_bits = 32;

struct Type {
  Kind kind = Kind::error;
  std::string name;  ///< as messages show it
  std::uint32_t cells = 1;
  bool ranged = false;  ///< a subrange of an integer type
  std::int64_t low = 0, high = 0;
  std::uint32_t length = 0;           ///< of a string, bytes; of WSTRING characters
  bool wide = false;                  ///< WSTRING
  std::vector<Dimension> dimensions;  ///< of an array
  bool open = false;                  ///< ARRAY[*]: the limits are those of the caller's array
  const Type* element = nullptr;
  std::vector<Field> fields;  ///< of a structure
  std::vector<Enumerator> enumerators;
  std::string space;  ///< of an enumeration: the namespace of its values, in capitals
  const Block* block = nullptr;
  Interface* interface = nullptr;
  std::vector<std::uint64_t> initial;  ///< the cells of a variable without initial value

  const Field* field(std::string_view upper) const;
  /// Also by the whole name, with the namespace.
  const Enumerator* enumerator(std::string_view upper) const;
};

/// The elementary types by name, in capitals; nothing for others.
const Type* elementary(std::string_view upper);
const Type* elementary(Kind kind);

bool is_signed(Kind kind);
bool is_integer(Kind kind);   ///< SINT .. ULINT
bool is_real(Kind kind);      ///< REAL, LREAL
bool is_bits(Kind kind);      ///< BOOL .. LWORD
bool is_duration(Kind kind);  ///< TIME, LTIME
bool is_date(Kind kind);      ///< DATE, TOD, DT
bool is_elementary(Kind kind);
bool is_reference(Kind kind);  ///< REF_TO, POINTER TO, of an interface, NULL
bool is_one_cell(Kind kind);   ///< elementary or a reference
/// Bits of an integer, bit string or enumeration.
int bits(Kind kind);
/// SIZEOF: what a variable has for pointers, not the cells of the machine.
std::uint64_t bytes_of(const Type& type);
/// Of arrays the type of their elements, which are no arrays.
const Type& innermost(const Type& type);
/// Without regard to initial values, but to limits.
bool same_limited_type(const Type& a, const Type& b);
/// Pointers to other types reach its bytes: a number, a bit string, a STRING.
bool has_bytes(const Type& type);
/// `n` of Op::narrow: bits and sign.
std::uint16_t cell_form(Kind kind);
/// Whether a literal integer is a value of the type; `negative` is its sign.
bool fits(const Type& type, std::int64_t value, bool is_large_unsigned = false);
/// "-128 .. 127"
std::string limits_text(const Type& type);

/// Whether VAR_IN_OUT of the type `parameter` takes a variable of the type `value`.
bool fits_parameter(const Type& value, const Type& parameter);
/// Without regard to subranges.
bool same_type(const Type& a, const Type& b);
/// Whether a value converts implicitly, without loss (figure 12 of the standard).
bool widens(const Type& from, const Type& to);
/// The smallest type to which both convert implicitly; nullptr when there is none.
const Type* common_type(const Type& a, const Type& b);

}  // namespace trunnion::st
