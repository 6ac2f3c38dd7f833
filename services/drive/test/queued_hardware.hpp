// SPDX-License-Identifier: Apache-2.0
// Hardware with a queue of rows, as a real one has: what is handed over comes into force some periods later.
#pragma once

#include <deque>

#include "drive_hardware.hpp"

namespace trunnion::drive::testing {

/// Axes without any error; what they do is in the public members.
class QueuedHardware : public DriveHardware {
 public:
  explicit QueuedHardware(std::size_t queue) : queue_(queue) {}

  void configure(const machine::Parameters&, const std::vector<machine::AxisInfo>& axes,
                 const std::vector<machine::AxisInfo>& spindles, double) override {
    position.resize(axes.size());
    spindles_ = spindles.size();
    fault.resize(axes.size());
  }
  void restore(std::span<const double>, std::span<const std::uint8_t>) override {}
  void status(DriveStatus& out) const override {
    out.axes.resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
      out.axes[i].position = out.axes[i].hold_position = position[i];
      out.axes[i].fault = fault[i];
    }
    out.spindles.resize(spindles_);
  }
  bool enabled() const override { return on; }
  void reset_faults() override { ++resets; }
  void set_reference(std::size_t, double) override {}
  void exchange(const SetpointRow& row, DriveStatus& out, EncoderRowSink& rows) override {
    newest = row;
    rows_.push_back(row);
    if (rows_.size() > queue_) {
      for (const auto& edge : edges) rows.skip_edge(rows_.front().number, edge);
      edges.clear();
      rows.encoder_row({rows_.front().number, position, {}});
      for (std::size_t i = 0; i < position.size() && rows_.front().controlled; ++i)
        position[i] = rows_.front().axes[i].position;
      rows_.pop_front();
    }
    status(out);
  }
  std::uint64_t read(DriveStatus&, EncoderRowSink&) override { return std::exchange(starved, 0); }

  bool on = true;
  std::uint64_t starved = 0;
  std::vector<idl::stream::SkipEdge> edges;  // that come before the next row comes into force
  int resets = 0;
  std::vector<double> position;
  std::vector<bool> fault;
  SetpointRow newest;

 private:
  std::size_t queue_, spindles_ = 0;
  std::deque<SetpointRow> rows_;
};

}  // namespace trunnion::drive::testing
