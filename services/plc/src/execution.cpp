// SPDX-License-Identifier: Apache-2.0
#include "execution.hpp"

#include <algorithm>
#include <limits>

namespace trunnion::plc {

using il::deepest_nesting, il::Op, il::Operand;
namespace {

std::int32_t saturate(std::int64_t value) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, std::numeric_limits<std::int32_t>::min(),
                                                            std::numeric_limits<std::int32_t>::max()));
}

/// Every operator that takes the current result and a value. Division by zero gives zero.
std::int32_t combine(Op op, std::int32_t left, std::int32_t right) {
  const std::int64_t a = left, b = right;
  switch (op) {
    case Op::and_:
      return left & right;
    case Op::and_not:
      return left & (right ^ 1);
    case Op::or_:
      return left | right;
    case Op::or_not:
      return left | (right ^ 1);
    case Op::xor_:
      return left ^ right;
    case Op::xor_not:
      return left ^ right ^ 1;
    case Op::add:
      return saturate(a + b);
    case Op::subtract:
      return saturate(a - b);
    case Op::multiply:
      return saturate(a * b);
    case Op::divide:
      return b == 0 ? 0 : saturate(a / b);
    case Op::greater:
      return a > b;
    case Op::greater_equal:
      return a >= b;
    case Op::equal:
      return a == b;
    case Op::not_equal:
      return a != b;
    case Op::less_equal:
      return a <= b;
    case Op::less:
      return a < b;
    default:
      return left;
  }
}

bool on_delay(Timer& timer, bool input, std::int32_t preset, std::uint64_t now) {
  if (!input) {
    timer = {};
    return false;
  }
  if (timer.input == 0) {
    timer.end = now + static_cast<std::uint64_t>(std::max(preset, 0));
    timer.running = 1;
    timer.input = 1;
  }
  if (timer.running != 0 && now >= timer.end) {
    timer.running = 0;
    timer.output = 1;
  }
  return timer.output != 0;
}

bool off_delay(Timer& timer, bool input, std::int32_t preset, std::uint64_t now) {
  if (input) {
    timer.input = timer.output = 1;
    timer.running = 0;
    return true;
  }
  if (timer.input != 0) {
    timer.end = now + static_cast<std::uint64_t>(std::max(preset, 0));
    timer.running = 1;
    timer.input = 0;
  }
  if (timer.running != 0 && now >= timer.end) timer.running = timer.output = 0;
  return timer.output != 0;
}

}  // namespace

std::uint64_t execute(const il::Program& program, Registers& registers, Blocks& blocks, std::uint64_t now) {
  struct Frame {
    Op op;
    std::int32_t result;
  };
  std::array<Frame, deepest_nesting> stack;
  std::size_t depth = 0;
  std::uint64_t executed = 0;
  std::int32_t result = 0;
  const auto value = [&](const Operand& operand) {
    return operand.is_constant ? operand.constant : load(registers, operand.address);
  };
  const auto count = program.instructions.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& in = program.instructions[i];
    ++executed;
    if (in.opens) {
      stack[depth++] = {in.op, result};
      continue;
    }
    switch (in.op) {
      case Op::load:
        result = value(in.operand);
        break;
      case Op::load_not:
        result = value(in.operand) ^ 1;
        break;
      case Op::store:
        store(registers, in.operand.address, result);
        break;
      case Op::store_not:
        store(registers, in.operand.address, result ^ 1);
        break;
      case Op::set:
        if (result != 0) store(registers, in.operand.address, 1);
        break;
      case Op::reset:
        if (result != 0) store(registers, in.operand.address, 0);
        break;
      case Op::invert:
        result ^= 1;
        break;
      case Op::close:
        --depth;
        result = combine(stack[depth].op, stack[depth].result, result);
        break;
      case Op::timer_on:
        result = on_delay(blocks.timers[in.instance], result != 0, value(in.operand), now);
        break;
      case Op::timer_off:
        result = off_delay(blocks.timers[in.instance], result != 0, value(in.operand), now);
        break;
      case Op::count_up: {
        auto& counter = blocks.counters[in.instance];
        if (result != 0 && counter.input == 0 && counter.value < std::numeric_limits<std::int32_t>::max())
          ++counter.value;
        counter.input = result != 0;
        result = counter.value >= value(in.operand);
        break;
      }
      case Op::count_reset:
        if (result != 0) blocks.counters[in.instance].value = 0;
        break;
      case Op::rising:
      case Op::falling: {
        auto& last = blocks.edges[in.instance];
        const bool edge = in.op == Op::rising ? result != 0 && last == 0 : result == 0 && last != 0;
        last = result != 0;
        result = edge;
        break;
      }
      case Op::move:
        if (result != 0) store(registers, in.second.address, value(in.operand));
        break;
      case Op::jump:
        i = in.target - std::size_t{1};
        break;
      case Op::jump_if:
        if (result != 0) i = in.target - std::size_t{1};
        break;
      case Op::jump_if_not:
        if (result == 0) i = in.target - std::size_t{1};
        break;
      default:
        result = combine(in.op, result, value(in.operand));
        break;
    }
  }
  return executed;
}

std::optional<std::uint64_t> next_timer_end(const Blocks& blocks, std::uint64_t now) {
  std::optional<std::uint64_t> end;
  for (const auto& timer : blocks.timers)
    if (timer.running != 0 && timer.end > now && (!end || timer.end < *end)) end = timer.end;
  return end;
}

bool timer_due(const Blocks& blocks, std::uint64_t now) {
  return std::any_of(blocks.timers.begin(), blocks.timers.end(),
                     [now](const Timer& timer) { return timer.running != 0 && timer.end <= now; });
}

}  // namespace trunnion::plc
