// SPDX-License-Identifier: Apache-2.0
// The instructions of the register machine that runs compiled Structured Text.
#pragma once

#include <cstdint>

namespace trunnion::st {

/// Memory is an array of cells of 64 bits. A cell holds one elementary value: integers, bit strings, BOOL and
/// enumerations with their sign or zeros extended to 64 bits, TIME and dates in ns, REAL and LREAL as their
/// bits. The operands a, b, c are cells of the frame of the running routine unless their kind says otherwise.
///
/// Kinds: w cell written, r cell read, i number, t place in the code, g address in memory, p routine,
/// d entry of the table of ranges, x entry of the table of assertions, o entry of the table of what pointers
/// reach, - unused. `n` is described per row.
// clang-format off
#define TRUNNION_ST_INSTRUCTIONS(X)                                                                     \
  X(statement, -, -, -)        /* counts one statement */                                              \
  X(move, w, r, -)                                                                                     \
  X(constant, w, i, i)         /* a = c * 2^32 + b */                                                  \
  X(load, w, g, -)             /* a = memory[b] */                                                     \
  X(save, r, g, -)             /* memory[b] = a */                                                     \
  X(load_at, w, r, i)          /* a = memory[b + c] */                                                 \
  X(save_at, r, r, i)          /* memory[b + c] = a */                                                 \
  X(address, w, i, -)          /* a = address of frame cell b */                                       \
  X(copy_block, r, r, i)       /* memory[a ..] = memory[b ..], c cells */                              \
  X(add, w, r, r) X(subtract, w, r, r) X(multiply, w, r, r) X(negate, w, r, -)                         \
  X(divide, w, r, r) X(divide_u, w, r, r) X(modulo, w, r, r) X(modulo_u, w, r, r)                      \
  X(narrow, w, r, -)           /* n: bits, plus 128 when signed */                                     \
  X(and_, w, r, r) X(or_, w, r, r) X(xor_, w, r, r) X(invert, w, r, -) X(not_, w, r, -)                \
  X(shift_left, w, r, r) X(shift_right, w, r, r)      /* n: bits of the type */                        \
  X(rotate_left, w, r, r) X(rotate_right, w, r, r)    /* n: bits of the type */                        \
  X(equal, w, r, r) X(not_equal, w, r, r) X(less, w, r, r) X(less_equal, w, r, r)                      \
  X(less_u, w, r, r) X(less_equal_u, w, r, r)                                                          \
  X(add_f, w, r, r) X(subtract_f, w, r, r) X(multiply_f, w, r, r) X(divide_f, w, r, r)                 \
  X(negate_f, w, r, -) X(equal_f, w, r, r) X(less_f, w, r, r) X(less_equal_f, w, r, r)                 \
  X(add_d, w, r, r) X(subtract_d, w, r, r) X(multiply_d, w, r, r) X(divide_d, w, r, r)                 \
  X(negate_d, w, r, -) X(equal_d, w, r, r) X(less_d, w, r, r) X(less_equal_d, w, r, r)                 \
  X(int_to_f, w, r, -) X(uint_to_f, w, r, -) X(int_to_d, w, r, -) X(uint_to_d, w, r, -)                \
  X(f_to_d, w, r, -) X(d_to_f, w, r, -)                                                                \
  X(d_round, w, r, -) X(d_truncate, w, r, -)   /* n: as narrow; saturates, NaN gives 0 */              \
  X(math, w, r, r)             /* n: MathFunction of LREAL */                                          \
  X(math_f, w, r, r)           /* n: MathFunction of REAL */                                           \
  X(bit_get, w, r, -)          /* a = bit n of b */                                                    \
  X(bit_put, w, r, -)          /* bit n of a = b */                                                    \
  X(field_get, w, r, i)        /* a = c bits of b from bit n */                                        \
  X(field_put, w, r, i)        /* c bits of a from bit n = b */                                        \
  X(jump, t, -, -)             /* forward only */                                                      \
  X(jump_if, t, r, -) X(jump_if_not, t, r, -) /* forward only */                                       \
  X(loop, t, -, -)             /* anywhere; counts one statement */                                    \
  X(call, p, g, -)             /* routine a with its frame at address b */                             \
  X(call_at, p, r, -)          /* routine a with its frame at the address in cell b */                 \
  X(return_, -, -, -)                                                                                  \
  X(check_index, w, r, d)      /* a = (b - low) * stride; a fault outside low .. high */               \
  X(check_range, r, d, -)      /* a fault outside low .. high */                                       \
  X(now, w, -, -)              /* ns for which the PLC has run */                                      \
  X(string_make, r, r, i)      /* n: StringFunction; a: address of the result, c: its length limit */  \
  X(string_query, w, r, -)     /* n: StringFunction; b: first of its arguments */                      \
  X(assert_, r, x, -)          /* a fault when a is 0 */                                               \
  X(from_bcd, w, r, -)         /* a = value of the 16 decimal digits of b */                           \
  X(to_bcd, w, r, -)           /* a = the last 16 decimal digits of b */                               \
  X(is_bcd, w, r, -)           /* a = every digit of b is below 10 */                                  \
  X(swap_bytes, w, r, -)       /* n: as narrow; the bytes of b in reverse order */                     \
  X(check_limits, w, r, r)     /* a = b - c; a fault outside c .. the cell behind c */                 \
  X(point, w, r, o)            /* a = pointer to the variable at the address in b, NULL without one */ \
  X(point_move, w, r, r)       /* a = pointer b moved by c bytes, of c the low 32 bits with sign */     \
  X(point_number, w, r, -)     /* a = the number of pointer b, by which pointers are compared */       \
  X(point_load, w, r, o)       /* a = value at pointer b */                                            \
  X(point_save, r, r, o)       /* value at pointer b = a; counts one statement */                      \
  X(point_cells, w, r, o)      /* a = address of the value at pointer b, of the same elements */
// clang-format on

enum class Op : std::uint16_t {
#define TRUNNION_ST_ENUMERATOR(name, a, b, c) name,
  TRUNNION_ST_INSTRUCTIONS(TRUNNION_ST_ENUMERATOR)
#undef TRUNNION_ST_ENUMERATOR
};

struct Instruction {
  Op op = Op::statement;
  std::uint16_t n = 0;
  std::int32_t a = 0, b = 0, c = 0;
  bool operator==(const Instruction&) const = default;
};

enum class MathFunction : std::uint16_t {
  abs,
  sqrt,
  ln,
  log,
  exp,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  power,
  trunc,
  floor,
  ceil,
  count
};

/// Arguments are consecutive cells; of a string its address.
enum class StringFunction : std::uint16_t {
  // string_make
  copy,
  concat,
  left,
  right,
  mid,
  insert,
  erase,
  replace,
  to_wide,     ///< any bytes to characters of WSTRING
  from_int,    ///< value
  from_uint,   ///< value
  from_real,   ///< bits of REAL
  from_lreal,  ///< bits of LREAL
  from_time,   ///< ns
  from_bool,
  // string_query
  length,
  find,
  compare,
  to_int,
  to_real,
  to_lreal,
  to_bool,
  count
};
/// Number of arguments.
int arguments(StringFunction function);
inline bool makes_string(StringFunction function) { return function < StringFunction::length; }

inline constexpr int longest_string = 1000;  ///< bytes
/// Characters of WSTRING, which are kept in UTF-8, each of at most three bytes.
inline constexpr int longest_wide_string = longest_string / 3;
/// With a StringFunction in `n`: lengths and positions count characters.
inline constexpr std::uint16_t wide_flag = 0x100;
/// Cells of a string: its length, then its bytes.
constexpr std::uint32_t string_cells(std::uint32_t length) { return 1 + (length + 7) / 8; }

constexpr std::uint16_t string_code(StringFunction function, bool wide) {
  return static_cast<std::uint16_t>(static_cast<std::uint16_t>(function) | (wide ? wide_flag : 0));
}

const char* name_of(Op op);

}  // namespace trunnion::st
