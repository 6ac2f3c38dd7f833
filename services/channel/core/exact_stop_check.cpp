// SPDX-License-Identifier: Apache-2.0
#include "exact_stop_check.hpp"

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::channel {

void ExactStopCheck::configure(const machine::Parameters& p, const machine::ChannelAxes& axes,
                               const std::vector<int>& columns) {
  lead_ = static_cast<std::uint64_t>(p.integer(parameter::stream_lead));
  const double time = p.get(parameter::exact_stop_check_time) / 1000;  // s
  const double cycle = p.get(parameter::interpolation_cycle) * 1e-6;
  // The time counts from when the first following error of the stop can be known.
  cycles_ = time > 0 ? static_cast<int>(std::ceil(time / cycle)) + static_cast<int>(lead_) + 1 : 0;
  axes_.clear();
  for (std::size_t i = 0; i < axes.number.size() && i < columns.size(); ++i) {
    if (columns[i] < 0) continue;
    const auto number = axes.number[i];
    const bool linear = p.integer(parameter::axis_type, number) == machine::axis_type_linear;
    axes_.push_back({number, static_cast<std::size_t>(columns[i]),
                     p.get(parameter::exact_stop_window, number), linear ? "mm" : "deg"});
  }
  rows_.assign(cycles_ > 0 ? rows : 0, {});
  checking_ = false;
}

void ExactStopCheck::on_feedback(const idl::stream::Feedback& feedback) {
  if (rows_.empty()) return;
  const std::size_t width = feedback.axis_count;
  for (std::size_t i = 0; i < feedback.count; ++i) {
    if ((i + 1) * width > std::min(feedback.actual.size(), feedback.commanded.size())) break;
    Row row{feedback.first + i, true, 0, 0};
    for (std::size_t a = 0; a < axes_.size() && row.in_position; ++a) {
      if (axes_[a].column >= width) continue;
      const std::size_t at = i * width + axes_[a].column;
      row.error = feedback.commanded[at] - feedback.actual[at];
      row.in_position = std::abs(row.error) <= axes_[a].window;
      row.axis = a;
    }
    rows_[row.cycle % rows] = row;
  }
}

bool ExactStopCheck::step(motion::Trajectory& trajectory, std::uint64_t cycle) {
  const int left = trajectory.position_check_left();
  if (left == 0) {
    checking_ = false;
    return true;
  }
  if (!checking_) since_ = cycle;
  checking_ = true;
  if (cycle < since_ + lead_ + 1) return true;
  const auto known = cycle - lead_ - 1;
  const Row& row = rows_[known % rows];
  if (row.cycle == known && row.in_position) {
    trajectory.end_position_check();
    checking_ = false;
    return true;
  }
  if (left > 1) return true;
  trajectory.restart_position_check();  // for when the operator starts again
  checking_ = false;
  failure_ = "exact stop not reached";
  if (row.cycle == known) {
    const Axis& axis = axes_[row.axis];
    failure_ = "axis " + std::to_string(axis.number) + " is " +
               text::quantity(std::abs(row.error), axis.unit, 3) + " from its exact stop, window " +
               text::quantity(axis.window, axis.unit, 3) + " (parameter " +
               machine::number_text(parameter::exact_stop_window.number(axis.number)) +
               "): check the servo, reset and start again";
  }
  return false;
}

}  // namespace trunnion::channel
