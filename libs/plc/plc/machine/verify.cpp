// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/verify.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace trunnion::st {
namespace {

struct Kinds {
  char a, b, c;
};
constexpr std::array kinds = std::to_array<Kinds>({
#define TRUNNION_ST_KINDS(name, a, b, c) {*#a, *#b, *#c},
    TRUNNION_ST_INSTRUCTIONS(TRUNNION_ST_KINDS)
#undef TRUNNION_ST_KINDS
});

class Verifier {
 public:
  explicit Verifier(const ByteCode& code) : code_(code) {}

  std::string run() {
    if (code_.initial.size() < image_cells || code_.initial.size() > most_cells)
      return "the memory has " + std::to_string(code_.initial.size()) + " cells";
    for (std::size_t r = 0; r < code_.routines.size(); ++r)
      if (auto problem = routine(r); !problem.empty()) return problem;
    for (const auto& entry : code_.entries)
      if (entry.routine >= code_.routines.size() || !fits(entry.base, code_.routines[entry.routine].frame))
        return "entry " + entry.name + " is outside the memory";
    for (const auto timer : code_.timers)
      if (!fits(timer, 2)) return "a timer is outside the memory";
    for (const auto& cells : code_.retained)
      if (!fits(cells.first, cells.count)) return "a retained variable is outside the memory";
    for (const auto& used : code_.registers)
      if (static_cast<std::size_t>(used.area) >= areas.size() || used.index >= info(used.area).count)
        return "a register is outside the image";
    for (const auto& range : code_.ranges)
      if (range.stride < 0 || range.stride > most_cells || range.low > range.high)
        return "a range has the limits " + std::to_string(range.low) + " .. " + std::to_string(range.high);
    return pointed();
  }

 private:
  bool fits(std::uint64_t first, std::uint64_t count) const { return first + count <= code_.initial.size(); }

  /// Pointers to the same element may take its cells for those of theirs.
  std::string pointed() const {
    if (code_.pointed.size() > most_pointed) return "there are too many variables of pointers";
    std::map<std::uint32_t, Pointed> elements;
    for (auto entry : code_.pointed) {
      const bool good =
          entry.count > 0 && element_fits(entry) && std::uint64_t{entry.count} * entry.cells <= most_cells;
      entry.count = 1;
      if (!good || elements.emplace(entry.element, entry).first->second != entry)
        return "a variable of pointers has wrong elements";
    }
    return "";
  }

  static bool element_fits(const Pointed& entry) {
    if (entry.cells == 0 || entry.cells > most_cells || entry.bytes == 0 ||
        entry.bytes > std::uint64_t{8} * entry.cells)
      return false;
    const auto bits = entry.form & 127u;
    switch (entry.view) {
      case Pointed::View::none:
        return true;
      case Pointed::View::number:
        return entry.cells == 1 && entry.form < 256 && width(bits) && entry.bytes == (bits + 7) / 8;
      case Pointed::View::string:
        return entry.bytes - 1 <= 8 * (entry.cells - 1) && entry.bytes - 1 <= std::uint32_t{longest_string};
    }
    return false;
  }

  std::string routine(std::size_t number) const {
    const auto& r = code_.routines[number];
    const auto name = "routine " + std::to_string(number);
    if (r.entry >= r.end || r.end > code_.code.size() || r.frame > most_cells)
      return name + " is outside the code";
    // What follows the last instruction is another routine's.
    const auto last = code_.code[r.end - 1].op;
    if (last != Op::return_ && last != Op::loop) return name + " has no end";
    for (auto i = r.entry; i < r.end; ++i)
      if (!good(code_.code[i], i, r, number))
        return "instruction " + std::to_string(i) + " of " + name + " has a wrong operand";
    return "";
  }

  bool good(const Instruction& in, std::uint32_t at, const Routine& r, std::size_t number) const {
    if (static_cast<std::size_t>(in.op) >= kinds.size()) return false;
    const auto& k = kinds[static_cast<std::size_t>(in.op)];
    return operand(k.a, in.a, in, at, r, number) && operand(k.b, in.b, in, at, r, number) &&
           operand(k.c, in.c, in, at, r, number) && number_n(in, r);
  }

  bool operand(char kind, std::int32_t value, const Instruction& in, std::uint32_t at, const Routine& r,
               std::size_t number) const {
    const auto u = static_cast<std::uint32_t>(value);
    switch (kind) {
      case 'w':
      case 'r':
        return u < r.frame;
      case 't':
        return u >= r.entry && u < r.end && (in.op == Op::loop || u > at);
      case 'g':
        return in.op == Op::call ? in.a >= 0 && static_cast<std::uint32_t>(in.a) < code_.routines.size() &&
                                       fits(u, code_.routines[static_cast<std::uint32_t>(in.a)].frame)
                                 : fits(u, 1);
      case 'p':
        return u < number;
      case 'd':
        return u < code_.ranges.size();
      case 'x':
        return u < code_.assertions.size() &&
               static_cast<std::uint32_t>(code_.assertions[u].actual) < r.frame &&
               static_cast<std::uint32_t>(code_.assertions[u].expected) < r.frame;
      case 'o':
        return u < code_.pointed.size();
      default:
        return true;
    }
  }

  static bool width(unsigned bits) {
    return bits == 1 || bits == 8 || bits == 16 || bits == 32 || bits == 64;
  }

  bool number_n(const Instruction& in, const Routine& r) const {
    switch (in.op) {
      case Op::point_load:
      case Op::point_save:
        return code_.pointed[static_cast<std::uint32_t>(in.c)].cells == 1;
      case Op::narrow:
      case Op::d_round:
      case Op::d_truncate:
        return in.n < 256 && width(in.n & 127u);
      case Op::swap_bytes:
        return in.n < 256 && width(in.n & 127u) && (in.n & 127u) >= 8;
      case Op::shift_left:
      case Op::shift_right:
      case Op::rotate_left:
      case Op::rotate_right:
        return width(in.n);
      case Op::bit_get:
      case Op::bit_put:
        return in.n < 64;
      case Op::field_get:
      case Op::field_put:
        return in.c > 0 && in.c < 64 && in.n + in.c <= 64;
      case Op::math:
      case Op::math_f:
        return in.n < static_cast<unsigned>(MathFunction::count);
      case Op::copy_block:
        return in.c >= 0 && static_cast<std::uint32_t>(in.c) <= most_cells;
      case Op::load_at:
      case Op::save_at:
        return in.c >= 0;
      case Op::check_limits:
        return static_cast<std::uint32_t>(in.c) + 1 < r.frame;
      case Op::address:
        return in.b >= 0 && static_cast<std::uint32_t>(in.b) < r.frame;
      case Op::string_make:
      case Op::string_query: {
        const bool wide = (in.n & wide_flag) != 0;
        const auto number = static_cast<std::uint16_t>(in.n & ~wide_flag);
        if (number >= static_cast<unsigned>(StringFunction::count)) return false;
        const auto function = static_cast<StringFunction>(number);
        return makes_string(function) == (in.op == Op::string_make) &&
               static_cast<std::uint32_t>(in.b) + static_cast<std::uint32_t>(arguments(function)) <=
                   r.frame &&
               (in.op != Op::string_make ||
                (in.c >= 0 && in.c <= (wide ? longest_wide_string : longest_string)));
      }
      default:
        return true;
    }
  }

  const ByteCode& code_;
};

}  // namespace

std::string verify(const ByteCode& code) { return Verifier(code).run(); }

std::uint32_t deepest_calls(const ByteCode& code) {
  std::vector<std::uint32_t> depth(code.routines.size(), 1);
  for (std::size_t r = 0; r < depth.size(); ++r)
    for (auto i = code.routines[r].entry; i < code.routines[r].end; ++i)
      if (const auto& in = code.code[i]; in.op == Op::call || in.op == Op::call_at)
        depth[r] = std::max(depth[r], depth[static_cast<std::uint32_t>(in.a)] + 1);
  return depth.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
}

}  // namespace trunnion::st
