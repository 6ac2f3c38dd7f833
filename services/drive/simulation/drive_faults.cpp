// SPDX-License-Identifier: Apache-2.0
#include "drive_faults.hpp"

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {
namespace {

constexpr double at_rest = 0.01;            // mm/s or deg/s: the brake of the motor holds it
constexpr std::uint32_t longest = 20000;    // periods after which the brakes act in any case
constexpr std::uint32_t rest_periods = 20;  // an axis that reverses is not at rest

const char* text_of(truth::DriveFaultKind kind) {
  static constexpr const char* texts[] = {
      "emergency alarm: power module",     "emergency alarm: over-current",
      "emergency alarm: bus over-voltage", "general alarm: following error",
      "general alarm: over-speed",         "general alarm: overload",
      "general alarm: locked rotor",       "general alarm: bus communication"};
  return texts[static_cast<std::size_t>(kind)];
}

}  // namespace

void DriveFaults::configure(const machine::Parameters& p, const std::vector<machine::AxisInfo>& axes,
                            const std::vector<const truth::DriveTruth*>& truths) {
  axes_.resize(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes_[i].fault = truths[i] != nullptr ? truths[i]->fault : std::nullopt;
    axes_[i].coasts = p.integer(parameter::fault_stop, axes[i].number) == 0;
  }
  before_.resize(axes.size()), faulty_.resize(axes.size()), partner_.resize(axes.size());
  ways_.resize(axes.size(), RunOut::none);
}

void DriveFaults::before(const std::vector<SimulatedAxis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) before_[i] = axes[i].load();
}

void DriveFaults::after(const std::vector<SimulatedAxis>& axes, const std::vector<GantryLink>& links) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!axes_[i].fault || any_) continue;
    const double at = axes_[i].fault->at;
    if ((before_[i] < at) != (axes[i].load() < at)) stop(i, links);
  }
}

void DriveFaults::stop(std::size_t column, const std::vector<GantryLink>& links) {
  any_ = true;
  periods_ = 0;
  const bool emergency = truth::is_emergency(axes_[column].fault->kind);
  std::fill(ways_.begin(), ways_.end(), RunOut::brakes);
  faulty_[column] = 1;
  ways_[column] = way(column, emergency);
  const auto join = [&](std::size_t partner) {
    if (partner == column) return;
    partner_[partner] = 1;
    ways_[partner] = way(partner, emergency);
  };
  for (const auto& link : links) {
    if (!link.has(column)) continue;
    for (const auto& slave : link.slaves()) {
      const auto s = static_cast<std::size_t>(slave.pair.slave_column);
      if (slave.common_stop && (column == s || column == link.master())) join(link.master()), join(s);
    }
  }
}

bool DriveFaults::running() const {
  return any_ && std::any_of(ways_.begin(), ways_.end(), [](RunOut way) { return way != RunOut::none; });
}

void DriveFaults::settle(const std::vector<SimulatedAxis>& axes) {
  ++periods_;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if ((periods_ > rest_periods && std::abs(axes[i].velocity()) < at_rest) || periods_ > longest)
      ways_[i] = RunOut::none;
}

void DriveFaults::reset() {
  if (!any_ || running()) return;
  any_ = false;
  std::fill(faulty_.begin(), faulty_.end(), std::uint8_t{0});
  std::fill(partner_.begin(), partner_.end(), std::uint8_t{0});
}

void DriveFaults::status(std::vector<AxisStatus>& out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].enabled = !any_;
    out[i].fault = faulty_[i] != 0;
    out[i].fault_text = out[i].fault ? text_of(axes_[i].fault->kind) : "";
    out[i].partner_fault = partner_[i] != 0;
  }
}

}  // namespace trunnion::drive
