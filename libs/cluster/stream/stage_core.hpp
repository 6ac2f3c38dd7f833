// SPDX-License-Identifier: Apache-2.0
// What a stage of the stream is, without DDS: a deterministic function of its batches, its parameters and its
// state.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/parameters.hpp"
#include "stream/feedback_window.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::stream {

using StateValues = std::vector<double>;

/// The computation of one stage for one channel. Implementations hold no state of the stream outside
/// save()/load().
template <class In>
class StageCore {
 public:
  virtual ~StageCore() = default;
  /// New parameters; called between batches only. Throws std::runtime_error when they make no sense.
  virtual void configure(const machine::Parameters& parameters, std::uint16_t channel) = 0;
  /// Fills axes and setpoints of `out` from `in`; everything else is copied by the caller. False: feedback it
  /// needs is not here yet (nothing was changed).
  virtual bool process(const In& in, const FeedbackWindow& feedback, idl::stream::AxisBatch& out) = 0;
  virtual void load(std::span<const double> state) = 0;
  virtual void save(StateValues& state) const = 0;
};

/// The state of `stage` in a list of states, or null.
inline const idl::stream::StageState* find_state(const std::vector<idl::stream::StageState>& states,
                                                 Stage stage) {
  for (const auto& state : states)
    if (state.stage == stage) return &state;
  return nullptr;
}

inline idl::stream::StageState& state_of(std::vector<idl::stream::StageState>& states, Stage stage) {
  for (auto& state : states)
    if (state.stage == stage) return state;
  states.push_back({stage, 0, {}});
  return states.back();
}

}  // namespace trunnion::stream
