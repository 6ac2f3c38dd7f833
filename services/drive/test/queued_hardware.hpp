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
    beside.resize(axes.size());
    in_force_.resize(axes.size());
    velocity_.resize(axes.size());
    spindle.resize(spindles.size());
    fault.resize(axes.size());
  }
  void restore(std::span<const double>, std::span<const std::uint8_t>) override {}
  void status(DriveStatus& out) const override {
    out.axes.resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
      out.axes[i].position = out.axes[i].hold_position = position[i];
      out.axes[i].fault = fault[i];
      out.axes[i].following_error = controlled_ ? in_force_[i] - position[i] : 0;
      out.axes[i].velocity = velocity_[i];
    }
    out.spindles = spindle;
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
      controlled_ = rows_.front().controlled;
      for (std::size_t i = 0; i < position.size() && controlled_; ++i) {
        in_force_[i] = rows_.front().axes[i].position;
        const double before = position[i];
        if (!encoders_lost) position[i] = in_force_[i] + beside[i];
        velocity_[i] = (position[i] - before) / 0.001;
      }
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
  std::vector<double> beside;  // mm by which an axis is ahead of the row in force
  bool encoders_lost = false;  // the positions stay as they are
  std::vector<bool> fault;
  std::vector<SpindleStatus> spindle;  // as they turn, whatever they are told
  SetpointRow newest;

 private:
  std::size_t queue_;
  std::deque<SetpointRow> rows_;
  std::vector<double> in_force_, velocity_;
  bool controlled_ = false;
};

}  // namespace trunnion::drive::testing
