// SPDX-License-Identifier: Apache-2.0
// Records the rounds of a running PLC while a reader requests them.
#pragma once

#include "plc_core.hpp"
#include "round.hpp"

namespace trunnion::plc {

/// Costs nothing without a request. Between begin_round() and end_round() every call that changes the core is
/// recorded, in its command; a reset may also be recorded before.
class RoundRecorder {
 public:
  bool on() const { return generation_ != 0; }

  /// `generation` is the requested one, 0 for none. A new one starts with the present core, whose parameters
  /// have `revision`; the round to be written first is then in first_round().
  bool begin_round(std::uint32_t generation, const PlcCore& core, std::uint64_t revision);
  const Round& first_round() const { return round_; }

  void record(StepKind kind, std::uint64_t value = 0);
  template <bus::Struct T>
  void record(StepKind kind, const T& sample) {
    if (!on()) return;
    record(kind);
    bus::encode(sample, steps_.back().sample);
  }
  /// Keeps the part of the feedback that the PLC reads.
  void record(const idl::stream::Feedback& feedback);

  /// The state of the core after the round. `done` are the functions finished in it.
  const Round& end_round(const PlcCore& core, const std::vector<idl::plc::AuxiliaryDone>& done);

 private:
  std::uint32_t generation_ = 0;
  std::uint64_t number_ = 0;
  std::vector<Step> steps_;
  Registers before_;
  Round round_;
};

}  // namespace trunnion::plc
