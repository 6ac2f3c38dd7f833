// Writes down the rounds of a running PLC while somebody asks for them.
#pragma once

#include "plc_core.hpp"
#include "round.hpp"

namespace trunnion::plc {

/// Costs nothing while nobody asks. Between begin_round() and end_round() every call that changes the core is
/// told, in its order; a reset may also be told before.
class RoundRecorder {
 public:
  bool on() const { return generation_ != 0; }

  /// `generation` is what was asked for, 0 for nothing. A new one begins with the core as it is now, whose
  /// parameters have `revision`; the round to be written first is then in first_round().
  bool begin_round(std::uint32_t generation, const PlcCore& core, std::uint64_t revision);
  const Round& first_round() const { return round_; }

  void told(StepKind kind, std::uint64_t value = 0);
  template <bus::Struct T>
  void told(StepKind kind, const T& sample) {
    if (!on()) return;
    told(kind);
    bus::encode(sample, steps_.back().sample);
  }
  /// Keeps of the frame what the PLC looks at.
  void told(const idl::stream::FeedbackFrame& frame);

  /// What became of the core. `done` are the functions it has finished in the round.
  const Round& end_round(const PlcCore& core, const std::vector<idl::plc::AuxiliaryDone>& done);

 private:
  std::uint32_t generation_ = 0;
  std::uint64_t number_ = 0;
  std::vector<Step> steps_;
  Registers before_;
  Round round_;
};

}  // namespace trunnion::plc
