// SPDX-License-Identifier: Apache-2.0
#include "motion/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "motion/join_policy.hpp"
#include "motion/programmed_move.hpp"

namespace trunnion::motion {
namespace {

using canonical::axis_count;
using canonical::Command;
using canonical::CommandKind;

// Blocks kept behind the oldest that may be moved on, since roundings reach back.
constexpr std::uint64_t blocks_behind = 2 * BlendedPath::most_joins + 8;
// A path at rest is started again beyond this length, mm or degrees: its coordinate becomes too coarse.
constexpr double longest_path = 1e5;
// Moves shorter than this share of the tolerance are joined to the next one.
constexpr double merge_share = 0.05;

ModeLimits effective(const Limits& limits, double cycle) {
  ModeLimits modes;
  for (std::size_t k = 0; k < path_modes; ++k) {
    Limits& mode = modes[k] = limits;
    if (k > 0) static_cast<PathMode&>(mode) = limits.modes[k - 1];
    const int cycles = std::clamp(mode.smoothing_cycles, 1, max_smoothing_cycles);
    for (AxisLimits& axis : mode.axes) axis.jerk = std::min(axis.jerk, axis.acceleration / (cycles * cycle));
  }
  return modes;
}

// The pieces of a curve deviate from it by half of the tolerance of arcs. The joins between them have the
// rest, also where corners are exact.
double inside_curve(const BlendRules& rules, const Limits& limits) {
  const double pieces = limits.arc_tolerance / 2;
  return std::max(rules.contour_tolerance - pieces, pieces);
}

}  // namespace

Trajectory::Trajectory(const Limits& limits, const geometry::Chain* chain, double cycle_seconds)
    : cycle_(cycle_seconds),
      limits_(effective(limits, cycle_seconds)),
      chain_(chain),
      speed_(cycle_seconds),
      back_(cycle_seconds),
      planned_(cycle_seconds),
      interpolation_(cycle_seconds) {
  start({}, canonical::Transformation::none, 0);
}

void Trajectory::start(const AxisValues& position, canonical::Transformation transformation,
                       double tool_length) {
  active_chain_ = transformation == canonical::Transformation::rtcp ? chain_ : nullptr;
  tool_length_ = tool_length;
  end_ = joined_ = position;
  interpolation_.start(position);
  position_check_ = 0;
  restart_path();
}

void Trajectory::set_limits(const Limits& limits) { limits_ = effective(limits, cycle_); }

void Trajectory::restart_path() {
  compressor_.clear();
  path_.clear();
  builder_.start(limits_, active_chain_, tool_length_);
  speed_.clear();
  planned_.clear();
  pending_.reset();
  interpolation_.drop_tail();
  stop_next_ = exact_next_ = true;
  curve_continues_ = false;
  aborting_ = retrace_wanted_ = retracing_ = false;
}

std::uint64_t Trajectory::current_block() const {
  const CellRing& cells = moving().cells();
  return cells.size() > 0 ? cells[moving().current_cell()].block : path_.oldest();
}

double Trajectory::current_s() const { return retracing_ ? -back_.state().s : speed_.state().s; }

bool Trajectory::can_accept() const {
  if (aborting_) return false;
  const std::uint64_t ahead = path_.size() - current_block() + compressor_.size();
  return path_.size() == 0 ||
         ahead + Compressor::most_pieces + 3 + history + blocks_behind < BlendedPath::capacity;
}

bool Trajectory::push(const Command& command) { return push_move(command, 0); }

bool Trajectory::push_from(const Command& command, double fraction) {
  return fraction >= 0 && fraction <= 1 && push_move(command, fraction);
}

// A move far below the tolerance is merged with the next one: so short a segment has no usable direction.
bool Trajectory::joins_to_last(const PathSegment& segment) const {
  if (segment.is_arc() || (path_.size() == 0 && compressor_.empty())) return false;
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double travel = std::abs(segment.target()[i] - segment.start()[i]);
    double& part = canonical::is_rotary(i) ? rotary : linear;
    part = std::max(part, travel);
  }
  return linear <= merge_share * rules_.contour_tolerance &&
         rotary <= merge_share * rules_.orientation_tolerance;
}

BlendRules Trajectory::rules_of(const Command& command) const {
  const PathMode& mode = limits_[command.modal.smoothing];
  const double own = command.modal.path_tolerance;
  return {std::max(0.0, own > 0 ? own : mode.contour_tolerance), std::max(0.0, mode.orientation_tolerance)};
}

// Another machining mode, or other tolerances, begin at a standstill.
void Trajectory::change_mode(const Command& command) {
  const BlendRules rules = rules_of(command);
  if (command.modal.smoothing == mode_ && rules == rules_) return;
  flush();
  stop_next_ = exact_next_ = true;
  mode_ = command.modal.smoothing;
  rules_ = rules;
}

bool Trajectory::push_move(const Command& command, double fraction) {
  if (!can_accept()) return false;
  const auto move =
      programmed_move(command, end_, fraction, limits_[mode_], active_chain_ != nullptr, cycle_);
  if (!move) return false;
  PathBlock block;
  block.line = command.line;
  block.sequence = command.sequence;
  block.fraction_offset = fraction;
  block.path = move->path;
  const bool fresh = at_rest();
  if (command.kind == CommandKind::dwell) {
    if (fresh && path_.end() > longest_path) restart_path();
    flush();
    block.mode = mode_;
    block.rules = rules_;
    block.wait_cycles = move->wait_cycles;
    stop_next_ = exact_next_ = true;
    append(block);
    stop_next_ = exact_next_ = true;
    return true;
  }
  block.rapid = command.kind == CommandKind::rapid;
  block.feed = move->feed;
  const double length = block.path.length();
  if (length > 0) {
    if (fresh && path_.end() > longest_path) restart_path();
    change_mode(command);
    block.mode = mode_;
    block.rules = rules_;
    if (curve_continues_) block.rules.contour_tolerance = inside_curve(rules_, limits_[mode_]);
    curve_continues_ = command.chord;
    if (pending_ && block.path.is_arc()) flush();
    if (pending_) block.path = PathSegment::line(joined_, command.target);
    end_ = command.target;
    if (!(block.path.length() > 0)) {
      pending_.reset();  // the moves led back to where they began
    } else if (!stop_next_ && joins_to_last(block.path)) {
      pending_ = block;
    } else {
      pending_.reset();
      append(block);
    }
  }
  if (command.modal.path_control == canonical::PathControl::exact_stop) {
    flush();
    stop_next_ = exact_next_ = true;
    if (position_check_ > 0 && length > 0) push_position_check(command);
  }
  return true;
}

// A wait of its own behind the move, as of a dwell, on which the whole command is done.
void Trajectory::push_position_check(const Command& command) {
  PathBlock check;
  check.line = command.line;
  check.sequence = command.sequence;
  check.fraction_offset = 1;
  check.path = PathSegment::line(end_, end_);
  check.mode = mode_;
  check.rules = rules_;
  check.wait_cycles = position_check_;
  check.position_check = true;
  append(check);
  stop_next_ = exact_next_ = true;
}

void Trajectory::flush() {
  if (!pending_) return;
  PathBlock block = *pending_;
  pending_.reset();
  append(block);
}

void Trajectory::append(PathBlock block) {
  block.stop = stop_next_;
  block.overlap = !exact_next_;
  joined_ = block.path.target();
  compressor_.push(block, limits_[block.mode].smooth_corner_angle);
  stop_next_ = exact_next_ = false;
  speed_.set_finished(false);
  take_blocks();
}

void Trajectory::take_blocks() {
  while (const PathBlock* ready = compressor_.take()) {
    PathBlock block = *ready;
    path_.rate_join(block);
    block.stop =
        block.stop || path_.size() == 0 || stops_at_join(path_[path_.size() - 1], block, limits_[block.mode]);
    block.overlap = block.overlap && block.stop && block.rules.contour_tolerance > 0;
    path_.push(block);
  }
  plan();
}

void Trajectory::plan() {
  path_.update(speed_.finished(), compressor_.smooth_ahead());
  builder_.extend(path_, speed_.cells(), speed_.oldest_needed());
  speed_.extended();
}

void Trajectory::plan_back() {
  const std::uint64_t oldest = path_.oldest() > 0 ? path_.oldest() + blocks_behind : 0;
  back_complete_ = back_builder_.extend_back(path_, back_.cells(), back_.oldest_needed(), oldest);
  back_.set_finished(back_complete_);
  back_.extended();
}

// At a standstill: the other stage continues from here.
void Trajectory::reverse() {
  const std::uint64_t block = current_block();
  const double s = current_s();
  planned_.clear();
  retracing_ = !retracing_;
  if (retracing_) {
    back_builder_.start(limits_, active_chain_, tool_length_);
    back_builder_.resume(block, s);
    back_.clear();
    back_complete_ = false;
    plan_back();
  } else {
    const bool finished = speed_.finished();
    builder_.resume(block, s);
    speed_.clear();
    speed_.set_finished(finished);
    plan();
  }
}

void Trajectory::finish() {
  if (path_.size() == 0 && compressor_.empty()) return;
  flush();
  compressor_.end_section();
  speed_.set_finished(true);
  stop_next_ = exact_next_ = true;
  take_blocks();
}

void Trajectory::abort() {
  if (!at_rest()) aborting_ = true;
}

bool Trajectory::at_rest() const {
  return compressor_.empty() && (path_.size() == 0 || (!retracing_ && !retrace_wanted_ && done()));
}

bool Trajectory::done() const {
  return path_.size() == 0 || (speed_.finished() && !pending_ && builder_.next_block() == path_.size() &&
                               speed_.at_end() && !interpolation_.overlapping());
}

Setpoint Trajectory::step(double feed_override, double rapid_override, bool hold) {
  // When the ring is full and no block is settled, its content becomes a path of its own.
  if (path_.size() > 0 && !can_accept() && !aborting_ && path_.settled_blocks() == 0) finish();
  if (builder_.next_block() < path_.settled_blocks()) plan();
  interpolation_.pass_cycle();
  if (path_.size() == 0) retrace_wanted_ = retracing_ = false;
  bool turning = retrace_wanted_ != retracing_;
  if (turning && !interpolation_.overlapping() && moving().at_standstill() && !aborting_) {
    reverse();
    turning = false;
  }
  if (retracing_ && !back_complete_) plan_back();
  SpeedStage& stage = retracing_ ? back_ : speed_;
  stage.allow_overlap(!interpolation_.overlapping() && !aborting_ && !turning);
  const Overrides overrides{feed_override, rapid_override, hold || aborting_ || turning};
  if (retracing_ || !planned_.step(speed_, overrides)) {
    stage.step(overrides);
    if (!retracing_ && !interpolation_.overlapping()) planned_.begin(speed_, overrides);
  }
  if (const auto tail = stage.take_tail()) interpolation_.begin_tail(*tail, stage.cells()[tail->cell].block);

  const bool moves = stage.cells().size() > 0;
  Setpoint setpoint = moves ? interpolation_.follow(path_, {current_block(), current_s(), stage.state().v,
                                                            stage.started(), stage.waiting()})
                            : interpolation_.stay();
  if (aborting_ && (!moves || (stage.at_standstill() && !interpolation_.overlapping()))) {
    restart_path();
    end_ = joined_ = setpoint.position;
    setpoint.distance_to_go = {};
  }
  setpoint.at_rest = at_rest();
  return setpoint;
}

}  // namespace trunnion::motion
