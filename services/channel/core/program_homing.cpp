// SPDX-License-Identifier: Apache-2.0
#include "program_homing.hpp"

#include <array>

#include "canonical/axes.hpp"

namespace trunnion::channel {
namespace {

constexpr std::array<std::size_t, 9> order = {canonical::X, canonical::Y, canonical::Z,
                                              canonical::U, canonical::V, canonical::W,
                                              canonical::A, canonical::B, canonical::C};

constexpr bool contains(std::uint32_t axes, std::size_t axis) { return ((axes >> axis) & 1u) != 0; }

}  // namespace

void ProgramHoming::begin(std::uint32_t sequence, std::uint32_t axes) {
  if (sequence == sequence_) return;
  sequence_ = sequence;
  left_ = axes;
  done_ = 0;
}

std::optional<std::size_t> ProgramHoming::next() const {
  for (const auto axis : order)
    if (contains(left_, axis)) return axis;
  return std::nullopt;
}

void ProgramHoming::pass(std::size_t axis) {
  left_ &= ~(1u << axis);
  done_ |= 1u << axis;
}

std::string ProgramHoming::letters(std::uint32_t axes) {
  std::string text;
  for (const auto axis : order)
    if (contains(axes, axis))
      text += (text.empty() ? "" : ", ") + std::string(1, canonical::axis_letters[axis]);
  return text;
}

}  // namespace trunnion::channel
