#include "motion/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

using language::Command;
using language::CommandKind;

// Through a chain the rates of the axes change between their samples and within a smoothing window, which the
// corner rules see only to first order. The shares leave room for that.
constexpr double chained_velocity_share = 0.995;
constexpr double chained_acceleration_share = 0.95;
constexpr double longest_dwell_cycles = 1e9;

CornerRules make_rules(const Limits& limits, double cycle) {
  CornerRules rules;
  rules.limits = limits;
  rules.limits.smoothing_cycles = std::clamp(limits.smoothing_cycles, 1, max_smoothing_cycles);
  rules.window = rules.limits.smoothing_cycles * cycle;
  rules.reach_window = rules.window + cycle;
  rules.contour_window = rules.limits.smoothing_cycles > 1 ? (rules.limits.smoothing_cycles + 2) * cycle : 0;
  return rules;
}

bool is_finite(const AxisValues& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

Trajectory::Trajectory(const Limits& limits, const geometry::Chain* chain, double cycle_seconds)
    : cycle_(cycle_seconds),
      chain_(chain),
      rules_(make_rules(limits, cycle_seconds)),
      planner_(rules_, cycle_seconds),
      interpolator_(rules_.limits.smoothing_cycles) {
  start({}, language::Transformation::none, 0);
}

void Trajectory::start(const AxisValues& position, language::Transformation transformation,
                       double tool_length) {
  active_chain_ = transformation == language::Transformation::rtcp ? chain_ : nullptr;
  tool_length_ = tool_length;
  rules_.velocity_share = active_chain_ != nullptr ? chained_velocity_share : 1;
  rules_.acceleration_share = active_chain_ != nullptr ? chained_acceleration_share : 1;
  planner_.restart(rules_);
  interpolator_.reset(position);
  end_ = path_ = output_ = position;
  line_ = sequence_ = 0;
  fraction_ = 0;
  stop_next_ = false;
  settled_cycles_ = interpolator_.cycles();
}

bool Trajectory::push(const Command& command) { return push_move(command, 0); }

bool Trajectory::push_from(const Command& command, double fraction) {
  return fraction >= 0 && fraction <= 1 && push_move(command, fraction);
}

bool Trajectory::push_move(const Command& command, double fraction) {
  if (!can_accept()) return false;
  PlannedSegment segment;
  segment.line = command.line;
  segment.sequence = command.sequence;
  segment.fraction_offset = fraction;
  const bool fresh = at_rest();
  if (command.kind == CommandKind::dwell) {
    const double cycles = std::ceil(command.dwell_seconds * (1 - fraction) / cycle_ - 1e-9);
    if (!(cycles >= 0) || cycles > longest_dwell_cycles) return false;
    if (fresh) planner_.clear();
    segment.path = PathSegment::line(end_, end_);
    planner_.push(segment, true, static_cast<int>(cycles) + 1);
    settled_cycles_ = 0;
    return true;
  }
  if (!is_finite(command.target)) return false;
  if (command.kind == CommandKind::arc) {
    language::Arc arc = command.arc;
    if (!(arc.sweep >= 0) || !std::isfinite(arc.sweep)) return false;
    if (fraction > 0) arc.sweep = remaining_sweep(end_, command.target, arc, fraction);
    if (!std::all_of(arc.centre.begin(), arc.centre.end(), [](double v) { return std::isfinite(v); }))
      return false;
    segment.path =
        arc.sweep > 0 ? PathSegment::arc(end_, command.target, arc) : PathSegment::line(end_, command.target);
  } else if (command.kind == CommandKind::line || command.kind == CommandKind::rapid) {
    segment.path = PathSegment::line(end_, command.target);
  } else {
    return false;
  }
  segment.rapid = command.kind == CommandKind::rapid;
  const bool inverse = command.modal.feed_mode == language::FeedMode::inverse_time;
  // Inverse time is the feed of the whole command: what is left of it takes its share of the time.
  const double whole = fraction < 1 ? segment.path.length() / (1 - fraction) : segment.path.length();
  segment.feed = command.modal.feed / 60 * (inverse ? whole : 1);
  const double length = segment.path.length();
  if (!std::isfinite(length)) return false;
  if (length > 0 && !segment.rapid && !(segment.feed > 0 && std::isfinite(segment.feed))) return false;
  if (length > 0) {
    if (fresh) planner_.clear();
    segment.rates = sample_rates(segment.path, active_chain_, tool_length_);
    planner_.push(segment, stop_next_, 0);
    stop_next_ = false;
    settled_cycles_ = 0;
    end_ = command.target;
  }
  if (command.modal.path_control == language::PathControl::exact_stop) stop_next_ = true;
  return true;
}

bool Trajectory::at_rest() const { return planner_.done() && settled_cycles_ >= interpolator_.cycles(); }

Setpoint Trajectory::step(double feed_override, double rapid_override, bool hold) {
  planner_.step({feed_override, rapid_override, hold});
  Setpoint setpoint;
  if (!planner_.empty()) {
    const PlannedSegment& segment = planner_.current();
    if (planner_.started()) path_ = segment.path.position(planner_.travelled());
    line_ = segment.line;
    sequence_ = segment.sequence;
    const double length = segment.path.length();
    const double done = length > 0 ? planner_.travelled() / length : (planner_.waiting() ? 0 : 1);
    setpoint.fraction = segment.fraction_offset + (1 - segment.fraction_offset) * done;
    setpoint.rapid = segment.rapid;
    setpoint.dwelling = planner_.waiting();
    for (std::size_t i = 0; i < language::axis_count; ++i) {
      setpoint.distance_to_go[i] = segment.path.target()[i];
    }
  } else {
    end_ = path_;  // an abort drops the rest of the path
    setpoint.distance_to_go = path_;
    setpoint.fraction = fraction_;
  }
  fraction_ = setpoint.fraction;
  const AxisValues before = output_;
  output_ = interpolator_.step(path_);
  settled_cycles_ = planner_.done() ? std::min(settled_cycles_ + 1, interpolator_.cycles()) : 0;
  setpoint.position = output_;
  for (std::size_t i = 0; i < language::axis_count; ++i) setpoint.distance_to_go[i] -= output_[i];
  setpoint.line = line_;
  setpoint.sequence = sequence_;
  setpoint.feed = std::hypot(output_[0] - before[0], output_[1] - before[1], output_[2] - before[2]) / cycle_;
  setpoint.path_speed = planner_.speed();
  setpoint.at_rest = at_rest();
  return setpoint;
}

}  // namespace trunnion::motion
