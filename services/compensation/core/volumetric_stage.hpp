// SPDX-License-Identifier: Apache-2.0
// Volumetric compensation in the stream: the correction of every cycle, without steps.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "compensation/volumetric_compensation.hpp"
#include "machine/parameters.hpp"
#include "smooth_transition.hpp"

namespace trunnion::compensation {

/// The correction of the model is smooth in the positions. Where it steps - an axis turns round and its
/// tables differ by direction, another tool length, other parameters, a new start - the step is spread over
/// time constant 04c953.
class VolumetricStage {
 public:
  using Rows = std::array<double, volumetric::axis_count>;
  using Directions = std::array<int, volumetric::axis_count>;

  /// Keeps the state.
  void configure(std::optional<volumetric::VolumetricCompensation> compensation,
                 const machine::Parameters& parameters, std::uint16_t channel);
  bool enabled() const { return compensation_.has_value(); }

  /// What is added to X Y Z A B C U V W in this cycle, mm or deg. `directions`: of the last moves, before and
  /// with this cycle. `moved`: the setpoints begin where the machine is, with no correction (a new epoch).
  const Rows& step(const Rows& positions, const Directions& before, const Directions& now, double tool_length,
                   bool moved);

  /// tool length, revision, then correction and transition of each axis in `letters` (0 .. 8).
  static std::size_t state_count(std::span<const std::uint8_t> letters) {
    return 2 + letters.size() * (1 + SmoothTransition::state_count);
  }
  void load(std::span<const double> state, std::span<const std::uint8_t> letters);
  void save(std::vector<double>& state, std::span<const std::uint8_t> letters) const;
  void clear();

 private:
  Rows correction(const Rows& positions, const Directions& directions, double tool_length) const;

  std::optional<volumetric::VolumetricCompensation> compensation_;
  double share_ = 1, revision_ = 0;
  // State.
  double tool_length_ = 0, state_revision_ = -1;
  Rows correction_{}, added_{};
  std::array<SmoothTransition, volumetric::axis_count> transitions_;
};

}  // namespace trunnion::compensation
