// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "plc/machine/arithmetic.hpp"
#include "plc/machine/pointer.hpp"
#include "plc/machine/strings.hpp"
#include "plc/machine/verify.hpp"

namespace trunnion::st {

const char* name_of(Op op) {
  static constexpr std::array names = std::to_array<const char*>({
#define TRUNNION_ST_NAME(name, a, b, c) #name,
      TRUNNION_ST_INSTRUCTIONS(TRUNNION_ST_NAME)
#undef TRUNNION_ST_NAME
  });
  return names[static_cast<std::size_t>(op)];
}

Machine::Machine(std::shared_ptr<const ByteCode> code) : code_(std::move(code)) {
  if (const auto problem = verify(*code_); !problem.empty())
    throw std::invalid_argument("byte code: " + problem);
  callers_.resize(deepest_calls(*code_) + 1);
  reset();
}

void Machine::reset() { memory_ = code_->initial; }

// The limits of frames, places in the code and tables were verified; what depends on values is checked here.
Fault Machine::run(std::size_t entry, std::int64_t now, std::int64_t budget) {
  return execute(entry, now, budget, 0, nullptr);
}

Fault Machine::run_part(std::size_t entry, std::int64_t now, std::int64_t budget, std::int64_t part,
                        Progress& progress) {
  // It may come from a file: what does not fit the code begins again.
  const auto is_place = [&](std::uint32_t instruction, std::uint32_t base) {
    const auto found = std::find_if(code_->routines.begin(), code_->routines.end(), [&](const Routine& r) {
      return instruction >= r.entry && instruction < r.end;
    });
    return found != code_->routines.end() && std::uint64_t{base} + found->frame <= memory_.size();
  };
  bool fits = progress.interrupted == 0 ||
              (is_place(progress.instruction, progress.base) && progress.depth < callers_.size() &&
               progress.depth <= Progress::most_callers);
  for (std::uint32_t i = 0; fits && i < progress.depth; ++i)
    fits = is_place(progress.callers[i].instruction, progress.callers[i].base);
  if (!fits) progress = {};
  const auto left = budget - static_cast<std::int64_t>(progress.statements);
  const auto now_at_most = std::clamp<std::int64_t>(part, 1, std::max<std::int64_t>(left, 1));
  auto fault = execute(entry, now, now_at_most, left - now_at_most, &progress);
  if (fault.kind == FaultKind::budget) fault.value = budget;
  if (fault.kind != FaultKind::none || progress.interrupted == 0) {
    progress = {};
    return fault;
  }
  progress.statements += static_cast<std::uint64_t>(statements_);
  if (static_cast<std::int64_t>(progress.statements) < budget) return fault;
  fault = {FaultKind::budget, progress.instruction, budget, 0, 0};
  progress = {};
  return fault;
}

// After `budget` statements it is interrupted where that is possible; `reserve` more are an error.
Fault Machine::execute(std::size_t entry, std::int64_t now, std::int64_t budget, std::int64_t reserve,
                       Progress* progress) {
  const Instruction* const code = code_->code.data();
  const Routine* const routines = code_->routines.data();
  std::uint64_t* const memory = memory_.data();
  const std::uint64_t size = memory_.size();
  std::uint32_t base = code_->entries[entry].base;
  std::uint64_t* m = memory + base;
  std::uint32_t pc = routines[code_->entries[entry].routine].entry;
  std::size_t depth = 0;
  std::int64_t left = budget;
  Fault fault;
  const auto stop = [&](FaultKind kind, std::int64_t value = 0, std::int64_t low = 0, std::int64_t high = 0) {
    fault = {kind, pc, value, low, high};
  };
  if (progress != nullptr && progress->interrupted != 0) {
    pc = progress->instruction, base = progress->base, depth = progress->depth;
    m = memory + base;
    std::copy_n(progress->callers.begin(), depth, callers_.begin());
    progress->interrupted = 0;
  }
  // Before the statement at `pc`, which has not run.
  const auto interrupt = [&] {
    if (progress == nullptr || depth > Progress::most_callers) return false;
    progress->interrupted = 1;
    progress->instruction = pc, progress->base = base, progress->depth = static_cast<std::uint32_t>(depth);
    progress->callers = {};
    std::copy_n(callers_.begin(), depth, progress->callers.begin());
    statements_ = budget - (left + 1);
    last_frame_ = base;
    return true;
  };
  for (;; ++pc) {
    const Instruction& in = code[pc];
    switch (in.op) {
      case Op::statement:
        if (--left < 0) {
          if (interrupt()) return fault;
          if (left < -reserve) stop(FaultKind::budget, budget + reserve);
        }
        break;
      case Op::move:
        m[in.a] = m[in.b];
        continue;
      case Op::constant:
        m[in.a] = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(in.c)) << 32) |
                  static_cast<std::uint32_t>(in.b);
        continue;
      case Op::load:
        m[in.a] = memory[in.b];
        continue;
      case Op::save:
        memory[in.b] = m[in.a];
        continue;
      case Op::load_at: {
        const auto address = m[in.b] + static_cast<std::uint64_t>(in.c);
        if (address < size) {
          m[in.a] = memory[address];
          continue;
        }
        stop(FaultKind::reference);
        break;
      }
      case Op::save_at: {
        const auto address = m[in.b] + static_cast<std::uint64_t>(in.c);
        if (address < size) {
          memory[address] = m[in.a];
          continue;
        }
        stop(FaultKind::reference);
        break;
      }
      case Op::address:
        m[in.a] = base + static_cast<std::uint32_t>(in.b);
        continue;
      case Op::copy_block: {
        const auto to = m[in.a], from = m[in.b], count = static_cast<std::uint64_t>(in.c);
        left -= in.c / 16;
        if (count <= size && to <= size - count && from <= size - count)
          std::memmove(memory + to, memory + from, count * sizeof(std::uint64_t));
        else
          stop(FaultKind::reference);
        break;
      }
      case Op::add:
        m[in.a] = m[in.b] + m[in.c];
        continue;
      case Op::subtract:
        m[in.a] = m[in.b] - m[in.c];
        continue;
      case Op::multiply:
        m[in.a] = m[in.b] * m[in.c];
        continue;
      case Op::negate:
        m[in.a] = 0 - m[in.b];
        continue;
      case Op::divide:
        if (m[in.c] == 0)
          stop(FaultKind::division);
        else if (m[in.c] == ~std::uint64_t{0})
          m[in.a] = 0 - m[in.b];
        else
          m[in.a] = static_cast<std::uint64_t>(as_signed(m[in.b]) / as_signed(m[in.c]));
        break;
      case Op::divide_u:
        if (m[in.c] == 0)
          stop(FaultKind::division);
        else
          m[in.a] = m[in.b] / m[in.c];
        break;
      case Op::modulo:
        m[in.a] = m[in.c] == 0 || m[in.c] == ~std::uint64_t{0}
                      ? 0
                      : static_cast<std::uint64_t>(as_signed(m[in.b]) % as_signed(m[in.c]));
        continue;
      case Op::modulo_u:
        m[in.a] = m[in.c] == 0 ? 0 : m[in.b] % m[in.c];
        continue;
      case Op::narrow:
        m[in.a] = narrowed(m[in.b], in.n);
        continue;
      case Op::and_:
        m[in.a] = m[in.b] & m[in.c];
        continue;
      case Op::or_:
        m[in.a] = m[in.b] | m[in.c];
        continue;
      case Op::xor_:
        m[in.a] = m[in.b] ^ m[in.c];
        continue;
      case Op::invert:
        m[in.a] = ~m[in.b];
        continue;
      case Op::not_:
        m[in.a] = m[in.b] == 0;
        continue;
      case Op::shift_left:
        m[in.a] = shifted_left(m[in.b], m[in.c], in.n);
        continue;
      case Op::shift_right:
        m[in.a] = shifted_right(m[in.b], m[in.c], in.n);
        continue;
      case Op::rotate_left:
        m[in.a] = rotated_left(m[in.b], m[in.c], in.n);
        continue;
      case Op::rotate_right:
        m[in.a] = rotated_left(m[in.b], in.n - m[in.c] % in.n, in.n);
        continue;
      case Op::equal:
        m[in.a] = m[in.b] == m[in.c];
        continue;
      case Op::not_equal:
        m[in.a] = m[in.b] != m[in.c];
        continue;
      case Op::less:
        m[in.a] = as_signed(m[in.b]) < as_signed(m[in.c]);
        continue;
      case Op::less_equal:
        m[in.a] = as_signed(m[in.b]) <= as_signed(m[in.c]);
        continue;
      case Op::less_u:
        m[in.a] = m[in.b] < m[in.c];
        continue;
      case Op::less_equal_u:
        m[in.a] = m[in.b] <= m[in.c];
        continue;
      case Op::add_f:
        m[in.a] = cell_of(as_float(m[in.b]) + as_float(m[in.c]));
        continue;
      case Op::subtract_f:
        m[in.a] = cell_of(as_float(m[in.b]) - as_float(m[in.c]));
        continue;
      case Op::multiply_f:
        m[in.a] = cell_of(as_float(m[in.b]) * as_float(m[in.c]));
        continue;
      case Op::divide_f:
        m[in.a] = cell_of(as_float(m[in.b]) / as_float(m[in.c]));
        continue;
      case Op::negate_f:
        m[in.a] = cell_of(-as_float(m[in.b]));
        continue;
      case Op::equal_f:
        m[in.a] = as_float(m[in.b]) == as_float(m[in.c]);
        continue;
      case Op::less_f:
        m[in.a] = as_float(m[in.b]) < as_float(m[in.c]);
        continue;
      case Op::less_equal_f:
        m[in.a] = as_float(m[in.b]) <= as_float(m[in.c]);
        continue;
      case Op::add_d:
        m[in.a] = cell_of(as_double(m[in.b]) + as_double(m[in.c]));
        continue;
      case Op::subtract_d:
        m[in.a] = cell_of(as_double(m[in.b]) - as_double(m[in.c]));
        continue;
      case Op::multiply_d:
        m[in.a] = cell_of(as_double(m[in.b]) * as_double(m[in.c]));
        continue;
      case Op::divide_d:
        m[in.a] = cell_of(as_double(m[in.b]) / as_double(m[in.c]));
        continue;
      case Op::negate_d:
        m[in.a] = cell_of(-as_double(m[in.b]));
        continue;
      case Op::equal_d:
        m[in.a] = as_double(m[in.b]) == as_double(m[in.c]);
        continue;
      case Op::less_d:
        m[in.a] = as_double(m[in.b]) < as_double(m[in.c]);
        continue;
      case Op::less_equal_d:
        m[in.a] = as_double(m[in.b]) <= as_double(m[in.c]);
        continue;
      case Op::int_to_f:
        m[in.a] = cell_of(static_cast<float>(as_signed(m[in.b])));
        continue;
      case Op::uint_to_f:
        m[in.a] = cell_of(static_cast<float>(m[in.b]));
        continue;
      case Op::int_to_d:
        m[in.a] = cell_of(static_cast<double>(as_signed(m[in.b])));
        continue;
      case Op::uint_to_d:
        m[in.a] = cell_of(static_cast<double>(m[in.b]));
        continue;
      case Op::f_to_d:
        m[in.a] = cell_of(static_cast<double>(as_float(m[in.b])));
        continue;
      case Op::d_to_f:
        m[in.a] = cell_of(static_cast<float>(as_double(m[in.b])));
        continue;
      case Op::d_round:
        m[in.a] = saturated(std::nearbyint(as_double(m[in.b])), in.n);
        continue;
      case Op::d_truncate:
        m[in.a] = saturated(std::trunc(as_double(m[in.b])), in.n);
        continue;
      case Op::math:
        m[in.a] = cell_of(computed(static_cast<MathFunction>(in.n), as_double(m[in.b]), as_double(m[in.c])));
        continue;
      case Op::math_f:
        m[in.a] = cell_of(computed(static_cast<MathFunction>(in.n), as_float(m[in.b]), as_float(m[in.c])));
        continue;
      case Op::bit_get:
        m[in.a] = (m[in.b] >> in.n) & 1u;
        continue;
      case Op::bit_put:
        m[in.a] = (m[in.a] & ~(std::uint64_t{1} << in.n)) | (std::uint64_t{m[in.b] != 0} << in.n);
        continue;
      case Op::field_get:
        m[in.a] = narrowed(m[in.b] >> in.n, static_cast<unsigned>(in.c));
        continue;
      case Op::field_put: {
        const auto mask = ((std::uint64_t{1} << in.c) - 1) << in.n;
        m[in.a] = (m[in.a] & ~mask) | ((m[in.b] << in.n) & mask);
        continue;
      }
      case Op::jump:
        pc = static_cast<std::uint32_t>(in.a) - 1;
        continue;
      case Op::jump_if:
        if (m[in.b] != 0) pc = static_cast<std::uint32_t>(in.a) - 1;
        continue;
      case Op::jump_if_not:
        if (m[in.b] == 0) pc = static_cast<std::uint32_t>(in.a) - 1;
        continue;
      case Op::loop:
        if (--left < 0 && interrupt()) return fault;
        if (left < -reserve)
          stop(FaultKind::budget, budget + reserve);
        else
          pc = static_cast<std::uint32_t>(in.a) - 1;
        break;
      case Op::call:
      case Op::call_at: {
        const auto& routine = routines[in.a];
        const auto frame = in.op == Op::call ? static_cast<std::uint64_t>(in.b) : m[in.b];
        if (routine.frame > size || frame > size - routine.frame) {
          stop(FaultKind::reference);
          break;
        }
        --left;
        callers_[depth++] = {pc, base};
        base = static_cast<std::uint32_t>(frame);
        m = memory + base;
        pc = routine.entry - 1;
        continue;
      }
      case Op::return_:
        if (depth == 0) {
          statements_ = budget - left;
          last_frame_ = base;
          return fault;
        }
        pc = callers_[--depth].instruction;
        base = callers_[depth].base;
        m = memory + base;
        continue;
      case Op::check_index: {
        const auto& range = code_->ranges[static_cast<std::uint32_t>(in.c)];
        const auto value = as_signed(m[in.b]);
        if (value >= range.low && value <= range.high) {
          m[in.a] =
              (m[in.b] - static_cast<std::uint64_t>(range.low)) * static_cast<std::uint64_t>(range.stride);
          continue;
        }
        stop(FaultKind::index, value, range.low, range.high);
        break;
      }
      case Op::check_limits: {
        const auto value = as_signed(m[in.b]), low = as_signed(m[in.c]), high = as_signed(m[in.c + 1]);
        if (value >= low && value <= high) {
          m[in.a] = m[in.b] - m[in.c];
          continue;
        }
        stop(FaultKind::index, value, low, high);
        break;
      }
      case Op::check_range: {
        const auto& range = code_->ranges[static_cast<std::uint32_t>(in.b)];
        const auto value = as_signed(m[in.a]);
        if (value >= range.low && value <= range.high) continue;
        stop(FaultKind::range, value, range.low, range.high);
        break;
      }
      case Op::now:
        m[in.a] = static_cast<std::uint64_t>(now);
        continue;
      case Op::from_bcd:
        m[in.a] = from_bcd(m[in.b]);
        continue;
      case Op::to_bcd:
        m[in.a] = to_bcd(m[in.b]);
        continue;
      case Op::is_bcd:
        m[in.a] = is_bcd(m[in.b]);
        continue;
      case Op::swap_bytes:
        m[in.a] = bytes_swapped(m[in.b], in.n);
        continue;
      case Op::string_make:
        left -= 4;
        if (!make_string(static_cast<StringFunction>(in.n & ~wide_flag), (in.n & wide_flag) != 0, memory_,
                         m[in.a], static_cast<std::uint32_t>(in.c), m + in.b))
          stop(FaultKind::reference);
        break;
      case Op::string_query:
        left -= 4;
        if (!query_string(static_cast<StringFunction>(in.n & ~wide_flag), (in.n & wide_flag) != 0, memory_,
                          m + in.b, m[in.a]))
          stop(FaultKind::reference);
        break;
      case Op::point:
        m[in.a] = pointer_cell(m[in.b], static_cast<std::uint32_t>(in.c));
        continue;
      case Op::point_move:
        m[in.a] = pointer_moved(m[in.b], m[in.c]);
        continue;
      case Op::point_number:
        m[in.a] = pointer_number(m[in.b]);
        continue;
      case Op::point_save:
        --left;
        [[fallthrough]];
      case Op::point_load:
      case Op::point_cells:
        if (const auto found = use_pointer(in, code_->pointed, memory_, m); found.kind != FaultKind::none)
          stop(found.kind, found.value, found.low, found.high);
        break;
      case Op::assert_:
        if (m[in.a] == 0) stop(FaultKind::assertion, in.b);
        break;
    }
    if (fault.kind != FaultKind::none) {
      statements_ = budget - left;
      last_frame_ = base;
      return fault;
    }
  }
}

std::optional<std::int64_t> Machine::next_timer_end(std::int64_t now) const {
  std::optional<std::int64_t> next;
  for (const auto timer : code_->timers) {
    const auto end = as_signed(memory_[timer]);
    if (memory_[timer + 1] != 0 && end > now && (!next || end < *next)) next = end;
  }
  return next;
}

bool Machine::timer_due(std::int64_t now) const {
  return std::any_of(code_->timers.begin(), code_->timers.end(), [&](std::uint32_t timer) {
    return memory_[timer + 1] != 0 && as_signed(memory_[timer]) <= now;
  });
}

}  // namespace trunnion::st
