// SPDX-License-Identifier: Apache-2.0
// A thread (G33, G34) while it is cut: the angle that the spindle will have in a cycle, from the feedback,
// and the place of the tool that belongs to it. What it computes for a cycle depends on the numbers of cycles
// alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "program_execution/thread_path.hpp"

namespace trunnion::channel {

using language::AxisValues;
using program_execution::ThreadLeg;
using program_execution::ThreadPath;
using program_execution::ThreadPlace;

/// The spindle that a thread follows, and the stream.
struct ThreadSpindle {
  std::size_t column = 0;  ///< in the feedback
  double speed = 0;        ///< S, 1/min
  bool clockwise = true;
  double cycle_seconds = 0.001;
  std::uint64_t lead = 32;  ///< cycle n uses rows of the feedback up to n - lead - 1
  std::uint32_t batch = 4;  ///< cycles that are computed at a time
};

/// What is written of one cycle.
struct ThreadCycle {
  AxisValues position{};
  std::optional<double> angle;  ///< of the spindle, rev; nothing before it is followed
  std::size_t leg = 0;
  double fraction = 0;  ///< of the leg
  double speed = 0;     ///< of the tool, mm/s
  bool at_rest = false;
};

class ThreadRun {
 public:
  /// The legs are being read, at rest.
  void collect() { phase_ = Phase::collecting; }
  void end();
  bool active() const { return phase_ != Phase::none; }
  bool collecting() const { return phase_ == Phase::collecting; }
  /// From the first cycle at rest before it to the last one.
  bool cutting() const { return phase_ == Phase::waiting || phase_ == Phase::following; }
  bool following() const { return phase_ == Phase::following; }
  /// The tool has come to rest at its end, or where it broke off.
  bool ended() const { return ended_; }
  /// It was broken off: why.
  const std::string& broken() const { return broken_; }
  /// While it waits for the spindle: for what.
  std::string waits_for() const;

  /// As ThreadPath::build(); without a fault it then waits for the spindle.
  ThreadPath::Fault begin(const AxisValues& start, std::span<const ThreadLeg> legs,
                          const motion::Limits& limits, const ThreadSpindle& spindle);
  const ThreadPath& path() const { return path_; }
  const AxisValues& position() const { return position_; }

  void on_feedback(const idl::stream::Feedback& feedback);
  /// The stream starts in `cycle`: rows before it were executed at another time.
  void stream_starts(std::uint64_t cycle) { first_ = cycle; }
  /// The batch that begins with `cycle` is the first in which the tool may follow, unless `stays`.
  void begin_batch(std::uint64_t cycle, bool stays);
  /// The cycles of a batch one after the other. `abandoned`: the tool leaves the pitch line as soon as it
  /// can; `held`: it does not begin.
  ThreadCycle step(std::uint64_t cycle, bool abandoned, bool held);

 private:
  enum class Phase : std::uint8_t { none, collecting, waiting, following };
  struct Row {
    std::uint64_t cycle = ~0ull;
    double angle = 0;
    bool homed = false;  // angles count from the index mark
  };
  struct Prediction {
    double angle = 0, rate = 0;  // rev, rev per cycle
  };
  static constexpr std::size_t rows = 2048, fitted = 16;

  /// Of the angle in `cycle`; nothing while too few rows of this stream can be known.
  std::optional<Prediction> predict(std::uint64_t cycle) const;
  /// All rows of the prediction for `cycle` count from the index mark.
  bool homed(std::uint64_t cycle) const;
  /// At a speed for which the path was made.
  bool at_speed(const Prediction& prediction) const;
  /// 1/min, positive in the direction of S.
  double speed_of(const Prediction& prediction) const;
  void supervise(std::uint64_t cycle, const Prediction& prediction);
  void await_mark(std::uint64_t cycle, const Prediction& prediction);
  void break_off(std::string why);
  std::uint64_t cycles(double seconds) const;

  Phase phase_ = Phase::none;
  ThreadPath path_;
  ThreadSpindle spindle_;
  AxisValues position_{};
  double angle_ = 0;  // of the newest cycle
  std::vector<Row> rows_ = std::vector<Row>(rows);
  std::uint64_t first_ = 0;
  std::uint64_t standing_ = 0, wrong_ = 0;  // cycles in a row
  std::uint64_t unmarked_ = 0;              // cycles at the start without the index mark
  double turned_ = 0;                       // rev in them
  std::optional<Prediction> newest_;
  bool ended_ = false, braked_ = false;
  std::string broken_;
};

}  // namespace trunnion::channel
