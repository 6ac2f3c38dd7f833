// SPDX-License-Identifier: Apache-2.0
// The rows of the feedback: setpoints with the encoder positions of the same cycle. A setpoint is executed
// once the hardware has reported its row, which hardware with a queue does some periods after it was handed
// over.
#pragma once

#include <cstdint>
#include <vector>

#include "drive_hardware.hpp"

namespace trunnion::drive {

class ExecutedRows final : public EncoderRowSink {
 public:
  /// The setpoints of `cycle`, mm or deg, are handed over with row `number`. Cycles come in their order.
  void handed_over(std::uint64_t cycle, std::uint64_t number, const std::vector<double>& setpoints);
  void skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) override;
  void encoder_row(const EncoderRow& row) override;

  /// Cycles handed over of which the hardware has reported no row yet.
  std::uint64_t pending() const { return pending_.size(); }
  /// Number of the newest row that has come back.
  std::uint64_t in_force() const { return in_force_; }
  /// Cycles that fill() will report.
  std::uint32_t count() const { return count_; }
  /// Moves the rows into `out` and forgets them; `next` is the cycle that is handed over next.
  void fill(idl::stream::Feedback& out, std::uint64_t next);

  /// No field, every period has a row: in_force_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("pending", self.pending_);
    visit("pending_setpoints", self.pending_setpoints_);
    visit("first", self.first_);
    visit("count", self.count_);
    visit("commanded", self.commanded_);
    visit("actual", self.actual_);
    visit("spindle_angle", self.spindle_angle_);
    visit("waiting_edges", self.waiting_edges_);
    visit("skips", self.skips_);
  }

  /// What one Feedback can carry; further edges are a bouncing contact and dropped.
  static constexpr std::size_t most_skip_edges = 16;

 private:
  struct Pending {
    std::uint64_t cycle, number;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("cycle", self.cycle), visit("number", self.number);
    }
  };
  void report_skip_edges(const Pending& executed);

  std::vector<Pending> pending_;
  std::vector<double> pending_setpoints_;  // a row for each of pending_
  std::uint64_t first_ = 0, in_force_ = 0;
  std::uint32_t count_ = 0;
  std::vector<double> commanded_, actual_, spindle_angle_;
  // Edges that wait for the first cycle behind them; `cycle` is the number of a row. Those with their cycle.
  std::vector<idl::stream::SkipEdge> waiting_edges_, skips_;
};

}  // namespace trunnion::drive
