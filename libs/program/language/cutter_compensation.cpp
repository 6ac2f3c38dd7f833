// SPDX-License-Identifier: Apache-2.0
#include "language/cutter_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::language {
namespace {

constexpr double tangent = 1e-6;  // sine of a corner that is none
/// How much nearer than its radius the tool may come to a contour nearby, mm: words are rounded to a
/// micrometre, and what that makes of a smooth contour is no interference.
constexpr double touching = 0.002;
/// Corners below this (rad) whose offsets do not meet are closed straight: the ends of an arc may be off its
/// circle by rounding of the words.
constexpr double rounding_corner = 0.005;
/// Within this of a reversal (rad) the curvature of the moves decides which side of each other they are on:
/// it outweighs the angle, which may come from the rounding of words.
constexpr double reversal = 0.05;
constexpr double radians = std::numbers::pi / 180;

/// Angle of the corner in (-pi, pi], positive to the left.
double change_of_direction(Vector2 from, Vector2 to) { return std::atan2(cross(from, to), dot(from, to)); }

/// Where the walk turns back on itself: true when the tool on the `left` (negative: right) is between the two
/// moves. Seen from the corner they separate by the angle between them and by their curvatures, which is
/// judged as far away as both moves reach, at most a radius of an arc.
bool turns_back_inside(const PlanarPiece& before, const PlanarPiece& after, double corner, double left) {
  const double angle = corner - std::copysign(std::numbers::pi, corner);
  double reach = std::min(before.length(), after.length());
  for (const PlanarPiece* piece : {&before, &after}) {
    if (piece->arc) reach = std::min(reach, 1 / std::abs(piece->curvature()));
  }
  const double to_the_left = angle + 0.5 * reach * (before.curvature() + after.curvature());
  return (left > 0 ? to_the_left : -to_the_left) < -tangent;
}

// From `from` to `to` round the outside of a corner, rad: the left offset goes round a right corner,
// clockwise. Where the contour turns back it may be a little more than half a turn.
double turn_around(Vector2 from, Vector2 to, double left) {
  const double sense = left > 0 ? -1 : 1;
  const double angle = sense * change_of_direction(from, to);
  return sense * (angle < -std::numbers::pi / 2 ? angle + 2 * std::numbers::pi : std::abs(angle));
}

}  // namespace

void CutterCompensation::reset() {
  side_ = CutterSide::off;
  offset_ = finished_ = has_last_move_ = false;
  first_ = count_ = 0;
  past_count_ = 0;
}

void CutterCompensation::configure(const CutterSettings& settings) {
  settings_ = settings;
  settings_.check_blocks = std::min<unsigned>(settings.check_blocks, past_.size());
}

void CutterCompensation::request(CutterSide side, double radius, Plane plane, const AxisValues& at) {
  if (!active()) {
    tool_ = at;
    plane_ = plane;
    axes_ = plane_axes(plane);
    has_last_move_ = false;
    past_count_ = 0;
  }
  finished_ = false;
  wall_ = {};
  side_ = side;
  radius_ = radius;
}

void CutterCompensation::set_in_plane(AxisValues& p, Vector2 to) const {
  p[axes_.first] = to.u;
  p[axes_.second] = to.v;
}

bool CutterCompensation::push() {
  if (count_ == capacity) return false;
  ++count_;
  Item& added = item(count_ - 1);
  added.moves_in_plane = added.leads = added.end_known = added.around = false;
  added.behind_lead = added.before_lead = added.smooth_start = added.smooth_end = false;
  added.left = 0;
  return true;
}

Command* CutterCompensation::add_at_rest() { return push() ? &item(count_ - 1).command : nullptr; }

std::size_t CutterCompensation::move_after(std::size_t i) const {
  for (++i; i < count_; ++i) {
    if (item(i).moves_in_plane) return i;
  }
  return count_;
}

AlarmNumber CutterCompensation::add(const Command& move, const AxisValues& start, bool flipped) {
  if (!push()) return AlarmNumber::compensation_look_ahead;
  Item& added = item(count_ - 1);
  added.command = move;
  const bool arc = move.kind == CommandKind::arc;
  added.contour = planar_piece(move, start, axes_);
  if (!arc && length(added.contour.end - added.contour.start) < no_distance) return AlarmNumber::none;

  added.moves_in_plane = true;
  const bool on = side_ != CutterSide::off;
  const bool left = (side_ == CutterSide::left) != flipped;
  added.leads = on != offset_;
  added.left = on && !added.leads ? (left ? radius_ : -radius_) : 0;
  if (added.leads && arc) return AlarmNumber::compensation_start;
  if (arc && added.left != 0) {
    const double inwards = added.contour.sweep > 0 ? added.left : -added.left;
    const double radius = std::min(length(added.contour.start - added.contour.centre),
                                   length(added.contour.end - added.contour.centre));
    if (inwards >= radius - no_distance) return AlarmNumber::compensation_radius;
  }
  offset_ = on;
  const std::size_t slot = (first_ + count_ - 1) % capacity;
  AlarmNumber alarm = AlarmNumber::none;
  if (has_last_move_) {
    Item& before = items_[last_move_];
    added.behind_lead = before.leads;
    before.before_lead = added.leads;
    alarm = settle_corner(before, added);
  } else {
    // It leads in, or is a plain move behind a way out: both begin where the program is.
    added.tool_start = in_plane(start);
  }
  has_last_move_ = on;
  last_move_ = slot;
  if (!on) {
    added.tool_end = added.contour.end;
    added.end_known = true;
  }
  return alarm;
}

AlarmNumber CutterCompensation::settle_corner(Item& before, Item& after) {
  before.end_known = true;
  if (before.leads) {
    before.tool_end = after.leads ? before.contour.end : after.contour.left_of_start(after.left);
    after.tool_start = before.tool_end;
    return check_direction(before);
  }
  before.tool_end = before.contour.left_of_end(before.left);
  if (after.leads) {
    if (length(wall_) > 0) {
      PlanarPiece wall;
      wall.start = before.contour.end;
      wall.end = wall.start + wall_;
      const Meeting meeting = meet(before.contour, before.left, wall, before.left);
      if (meeting.found) before.tool_end = meeting.point;
    }
    after.tool_start = before.tool_end;
    return check_direction(before);
  }
  after.tool_start = after.contour.left_of_start(after.left);
  const double corner =
      change_of_direction(before.contour.tangent_at_end(), after.contour.tangent_at_start());
  const bool same_side = (before.left > 0) == (after.left > 0) && before.left != 0 && after.left != 0;
  const bool straight_on = std::abs(std::sin(corner)) < tangent && std::cos(corner) > 0;
  before.smooth_end = after.smooth_start = std::abs(corner) < rounding_corner;
  if (straight_on && before.left == after.left) {
    after.tool_start = before.tool_end;
    return check_direction(before);
  }
  const bool turns_back = std::numbers::pi - std::abs(corner) < reversal;
  const bool inside = turns_back ? turns_back_inside(before.contour, after.contour, corner, after.left)
                                 : (corner > 0) == (after.left > 0) && !straight_on;
  if (same_side && inside) {
    const Meeting meeting = meet(before.contour, before.left, after.contour, after.left);
    if (meeting.found && (meeting.shortens || !turns_back)) {
      const Vector2 square = before.tool_end;
      before.tool_end = after.tool_start = meeting.point;
      if (check_direction(before) == AlarmNumber::none) return AlarmNumber::none;
      before.tool_end = square;
      after.tool_start = after.contour.left_of_start(after.left);
    }
    if (std::abs(corner) > rounding_corner) return AlarmNumber::compensation_unresolved;
    return check_direction(before);
  }
  after.around = same_side && before.left == after.left;
  return check_direction(before);
}

// The offset of a move runs as the move does; a tool too large for it would have to go backwards.
AlarmNumber CutterCompensation::check_direction(const Item& item) const {
  if (item.leads) return AlarmNumber::none;
  if (!item.contour.arc) {
    const double along = dot(item.tool_end - item.tool_start, item.contour.tangent_at_start());
    return along < -no_distance ? AlarmNumber::compensation_unresolved : AlarmNumber::none;
  }
  const bool backwards = tool_piece(item).sweep * item.contour.sweep < 0;
  return backwards ? AlarmNumber::compensation_unresolved : AlarmNumber::none;
}

PlanarPiece CutterCompensation::tool_piece(const Item& item) const {
  PlanarPiece piece = item.contour;
  piece.start = item.tool_start;
  piece.end = item.tool_end;
  if (!piece.arc) return piece;
  const PlanarPiece& c = item.contour;
  // What the corners cut off, as small signed angles, so that several turns stay several turns.
  const double at_start = change_of_direction(c.start - c.centre, piece.start - c.centre);
  const double at_end = change_of_direction(piece.end - c.centre, c.end - c.centre);
  piece.sweep = c.sweep - at_start - at_end;
  return piece;
}

PlanarPiece CutterCompensation::around_piece(const Item& item) const {
  PlanarPiece piece;
  piece.arc = true;
  piece.centre = item.contour.start;
  piece.start = in_plane(tool_);
  piece.end = item.tool_start;
  piece.sweep = turn_around(piece.start - piece.centre, piece.end - piece.centre, item.left);
  return piece;
}

bool CutterCompensation::clear_of(const Item& item, const PlanarPiece& contour, double left) const {
  if (item.leads || left == 0 || (left > 0) != (item.left > 0)) return true;
  double deviation = touching;
  for (const PlanarPiece* piece : {&item.contour, &contour}) {
    if (piece->arc) {
      deviation += std::abs(length(piece->start - piece->centre) - length(piece->end - piece->centre));
    }
  }
  const double least = std::min(std::abs(item.left), std::abs(left)) - deviation;
  if (distance(tool_piece(item), contour) < least) return false;
  return !item.around || distance(around_piece(item), contour) >= least;
}

double CutterCompensation::guarded(const Item& item) {
  const bool approach = item.behind_lead && item.smooth_end;
  const bool departure = item.before_lead && item.smooth_start;
  return item.leads || (item.contour.arc && (approach || departure)) ? 0 : item.left;
}

AlarmNumber CutterCompensation::check_interference(std::size_t i) {
  const Item& tool = item(i);
  const std::size_t behind = std::min<std::size_t>(settings_.check_blocks, past_count_);
  for (std::size_t k = 0; k < behind; ++k) {
    const Past& past = past_[past_count_ - 1 - k];
    if (clear_of(tool, past.contour, past.left)) continue;
    interference_ = {tool.command.line, past.line};
    return AlarmNumber::compensation_interference;
  }
  unsigned ahead = 0;
  for (std::size_t k = move_after(i); k < count_ && ahead < settings_.check_blocks; k = move_after(k)) {
    ++ahead;
    if (clear_of(tool, item(k).contour, guarded(item(k)))) continue;
    interference_ = {tool.command.line, item(k).command.line};
    return AlarmNumber::compensation_interference;
  }
  return AlarmNumber::none;
}

void CutterCompensation::remember(const Item& item) {
  if (past_count_ == past_.size()) {
    std::move(past_.begin() + 1, past_.end(), past_.begin());
    --past_count_;
  }
  // Leading moves are remembered as no contour, so that what is before them counts less and less.
  past_[past_count_++] = {item.contour, guarded(item), item.command.line};
}

AlarmNumber CutterCompensation::finish() {
  if (has_last_move_) {
    Item& last = items_[last_move_];
    last.tool_end = last.leads ? last.contour.end : last.contour.left_of_end(last.left);
    last.end_known = true;
    has_last_move_ = false;
    if (const AlarmNumber alarm = check_direction(last); alarm != AlarmNumber::none) return alarm;
  }
  finished_ = true;
  return AlarmNumber::none;
}

AlarmNumber CutterCompensation::pop(Command& command, bool& popped) {
  popped = false;
  if (count_ == 0) return AlarmNumber::none;
  Item& front = item(0);
  if (!front.moves_in_plane) {
    command = front.command;
    if (command.kind == CommandKind::rapid || command.kind == CommandKind::line) {
      set_in_plane(command.target, in_plane(tool_));
      tool_ = command.target;
    } else if (command.kind != CommandKind::table) {
      command.target = tool_;
    }
    first_ = (first_ + 1) % capacity;
    --count_;
    popped = true;
    return AlarmNumber::none;
  }
  if (!front.end_known) return AlarmNumber::none;
  if (settings_.interference_check && !front.leads) {
    unsigned ahead = 0;
    for (std::size_t k = move_after(0); k < count_; k = move_after(k)) ++ahead;
    const bool ends = !offset_ || finished_;  // nothing comes that could still be near
    // One more than is checked: it tells whether the last of them leads off the contour.
    if (ahead <= settings_.check_blocks && !ends) return AlarmNumber::none;
    if (const AlarmNumber alarm = check_interference(0); alarm != AlarmNumber::none) return alarm;
  }
  popped = true;
  if (give_join(front, command)) return AlarmNumber::none;
  give_move(front, command);
  remember(front);
  const double moved = length(in_plane(command.target) - in_plane(tool_));
  bool other_axes = false;
  for (std::size_t i = 0; i < axis_count; ++i) {
    other_axes |=
        i != axes_.first && i != axes_.second && std::abs(command.target[i] - tool_[i]) > no_distance;
  }
  tool_ = command.target;
  first_ = (first_ + 1) % capacity;
  --count_;
  // A move that the corners have eaten up whole is none.
  const bool whole_turn = command.kind == CommandKind::arc && command.arc.sweep > 1;
  if (moved < no_distance && !other_axes && !whole_turn) return pop(command, popped);
  return AlarmNumber::none;
}

// The way from where the move before ended to where this one begins.
bool CutterCompensation::give_join(const Item& next, Command& command) {
  const Vector2 from = in_plane(tool_);
  if (length(next.tool_start - from) < no_distance) {
    join_step_ = 0;
    return false;
  }
  command = next.command;
  command.target = tool_;
  command.arc = {};
  command.kind = next.command.kind == CommandKind::rapid ? CommandKind::rapid : CommandKind::line;
  Vector2 to = next.tool_start;
  if (next.around) {
    const PlanarPiece around = around_piece(next);
    if (command.kind == CommandKind::line) {
      command.kind = CommandKind::arc;
      command.arc.plane = plane_;
      command.arc.clockwise = around.sweep < 0;
      command.arc.centre = {tool_[X], tool_[Y], tool_[Z]};
      command.arc.centre[axes_.first] = around.centre.u;
      command.arc.centre[axes_.second] = around.centre.v;
      command.arc.sweep = std::abs(around.sweep) / radians;
    } else {
      // The corners of a polygon around the arc, at most a quarter turn each, then its end.
      if (join_step_ == 0) join_from_ = from - around.centre;
      const double whole = std::abs(turn_around(join_from_, next.tool_start - around.centre, next.left));
      const double quarters = std::max(1.0, std::ceil(whole / (std::numbers::pi / 2) - 1e-9));
      if (join_step_ < quarters) {
        const double part = std::copysign(whole / quarters, around.sweep);
        const double angle = part * (join_step_ + 0.5);
        const double out = 1 / std::cos(part / 2);
        to = around.centre + out * (std::cos(angle) * join_from_ + std::sin(angle) * left_of(join_from_));
      }
      ++join_step_;
    }
  }
  set_in_plane(command.target, to);
  tool_ = command.target;
  return true;
}

void CutterCompensation::give_move(const Item& item, Command& command) {
  command = item.command;
  set_in_plane(command.target, item.tool_end);
  if (!item.contour.arc) return;
  const PlanarPiece tool = tool_piece(item);
  command.arc.sweep = std::abs(tool.sweep) / radians;
  command.arc.centre[axes_.normal] = tool_[axes_.normal];
  const double radius = length(item.contour.start - item.contour.centre);
  const double tool_radius = length(tool.start - tool.centre);
  if (settings_.feed_at_contour && command.modal.feed_mode != FeedMode::inverse_time) {
    command.modal.feed *= tool_radius / radius;
  }
}

}  // namespace trunnion::language
