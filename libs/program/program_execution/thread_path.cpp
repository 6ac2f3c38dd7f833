// SPDX-License-Identifier: Apache-2.0
#include "program_execution/thread_path.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::program_execution {
namespace {

/// Revolutions by which the parts of a leg may be longer than the leg: rounding.
constexpr double no_turn = 1e-9;
/// The fraction of a leg before whose end the tool is, or beyond which it does not come.
constexpr double nearly_done = 1 - 1e-9;

double farthest_way(const AxisValues& from, const AxisValues& to) {
  double farthest = 0;
  for (std::size_t axis = 0; axis < from.size(); ++axis)
    farthest = std::max(farthest, std::abs(to[axis] - from[axis]));
  return farthest;
}

/// The lead at the end of `way` mm.
double last_lead(double lead, double change, double way) {
  return std::sqrt(std::max(0.0, lead * lead + 2 * change * way));
}

/// From 0 to 1 over x = 0 .. 1 in two parabolas, its integral, and the integral of it times x.
double share(double x) { return x < 0.5 ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x); }
double share_integral(double x) {
  const double u = 1 - x;
  return x < 0.5 ? 2 * x * x * x / 3 : x - 0.5 + 2 * u * u * u / 3;
}
double share_moment(double x) {
  const double u = 1 - x;
  return x < 0.5 ? x * x * x * x / 2 : 17.0 / 48 - u * (1 - u * (0.5 + u * (2.0 / 3 - u / 2)));
}
/// A smooth way from 0 to 1 and its velocity, both with no velocity at the ends.
double correction(double x) { return x * x * x * (10 - x * (15 - 6 * x)); }
double correction_velocity(double x) { return 30 * x * x * (1 - x) * (1 - x); }

}  // namespace

ThreadLeg leg_of(const language::Command& thread) {
  ThreadLeg leg;
  leg.target = thread.target;
  leg.lead = thread.value;
  leg.lead_change = thread.lead_change;
  leg.start_angle = thread.start_angle;
  leg.program = thread.program;
  leg.sequence = thread.sequence;
  leg.line = thread.line;
  return leg;
}

language::Command thread_line(language::Command thread, const AxisValues& from) {
  const double farthest = farthest_way(from, thread.target);
  double square = 0;
  for (std::size_t axis = 0; axis < from.size(); ++axis)
    square += (thread.target[axis] - from[axis]) * (thread.target[axis] - from[axis]);
  const double ratio = farthest > 0 ? std::sqrt(square) / farthest : 1;
  const double mean = (thread.value + last_lead(thread.value, thread.lead_change, farthest)) / 2;
  thread.kind = language::CommandKind::line;
  thread.number = 0;
  thread.modal.feed_mode = language::FeedMode::per_minute;
  thread.modal.feed = mean * ratio * thread.modal.spindle_speed;
  return thread;
}

ThreadPath::Fault ThreadPath::build(const AxisValues& start, std::span<const ThreadLeg> legs, double speed,
                                    bool clockwise, const motion::Limits& limits) {
  origin_ = 0;
  whole_ = true;
  highest_share_ = speed_margin;
  clockwise_ = clockwise;
  const double rate = speed_margin * speed / 60;  // rev/s
  for (std::size_t axis = 0; axis < start.size(); ++axis) {
    acceleration_[axis] = limits.axes[axis].acceleration / (rate * rate);
    jerk_[axis] = limits.axes[axis].jerk / (rate * rate * rate);
  }
  pieces_.clear();
  nodes_.clear();
  end_ = start;
  double begin = 0;
  for (const ThreadLeg& leg : legs) {
    Piece piece;
    piece.leg = leg;
    piece.start = end_;
    piece.begin = begin;
    const double way = farthest_way(end_, leg.target);
    const double last = last_lead(leg.lead, leg.lead_change, way);
    for (std::size_t axis = 0; axis < start.size() && way > 0; ++axis) {
      piece.direction[axis] = (leg.target[axis] - end_[axis]) / way;
      const double fastest = std::abs(piece.direction[axis]) * std::max(leg.lead, last) * speed / 60;
      if (fastest > 0) highest_share_ = std::min(highest_share_, limits.axes[axis].velocity / fastest);
    }
    piece.revolutions = 2 * way / (leg.lead + last);
    begin += piece.revolutions;
    end_ = leg.target;
    pieces_.push_back(piece);
  }
  for (std::size_t i = 0; i <= pieces_.size(); ++i) {
    const Piece* before = i > 0 ? &pieces_[i - 1] : nullptr;
    const Piece* behind = i < pieces_.size() ? &pieces_[i] : nullptr;
    nodes_.push_back(node_between(before, behind, behind != nullptr ? behind->begin : begin));
    faulty_leg_ = std::min(i, pieces_.size() - 1);
    if (nodes_.back().half < 0) return Fault::acceleration;
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    faulty_leg_ = i;
    if (nodes_[i].half + nodes_[i + 1].half > pieces_[i].revolutions + no_turn) return Fault::too_short;
  }
  return Fault::none;
}

ThreadPath::Node ThreadPath::node_between(const Piece* before, const Piece* behind, double place) const {
  Node node;
  node.place = place;
  for (std::size_t axis = 0; axis < node.step.size(); ++axis) {
    if (behind != nullptr) {
      node.step[axis] += behind->direction[axis] * behind->lead(place);
      node.slope[axis] += behind->direction[axis] * behind->leg.lead_change;
    }
    if (before != nullptr) {
      node.step[axis] -= before->direction[axis] * before->lead(place);
      node.slope[axis] -= before->direction[axis] * before->leg.lead_change;
    }
  }
  node.half = half_of(node, before, behind);
  return node;
}

// With the half length h the acceleration is at most |step| / h + |change of lead| + 0.4 |slope|, and the
// jerk |step| / h^2 + 2 |slope| / h.
double ThreadPath::half_of(const Node& node, const Piece* before, const Piece* behind) const {
  double half = 0;
  for (std::size_t axis = 0; axis < node.step.size(); ++axis) {
    const double change = std::abs(node.step[axis]), slope = std::abs(node.slope[axis]);
    if (change == 0 && slope == 0) continue;
    double leads = 0;
    for (const Piece* piece : {before, behind})
      if (piece != nullptr)
        leads = std::max(leads, std::abs(piece->direction[axis] * piece->leg.lead_change));
    const double left = acceleration_[axis] - leads - 0.4 * slope;
    if (!(left > 0)) return -1;
    half = std::max(half, change / left);
    half = std::max(half, (slope + std::sqrt(slope * slope + jerk_[axis] * change)) / jerk_[axis]);
  }
  return half;
}

double ThreadPath::first_origin(double angle, double ahead) const {
  const double sense = clockwise_ ? 1 : -1;
  const double mark = pieces_.front().leg.start_angle / 360;
  return sense * (std::ceil(sense * angle + ahead + nodes_.front().half - mark) + mark);
}

ThreadPlace ThreadPath::at(double angle) const {
  const double now = turned(angle);
  ThreadPlace out;
  if (now <= -nodes_.front().half) {
    out.position = start();
    return out;
  }
  out.leg = pieces_.size() - 1;
  if (now >= nodes_.back().place + nodes_.back().half) {
    out.position = end_;
    out.fraction = whole_ ? 1 : nearly_done;
    return out;
  }
  while (out.leg > 0 && now < pieces_[out.leg].begin) --out.leg;
  const Piece& here = pieces_[out.leg];
  out.fraction = here.revolutions > 0 ? std::clamp((now - here.begin) / here.revolutions, 0.0, nearly_done)
                                      : nearly_done;
  // The pitch line before the node that acts here, if one does, and what the node adds.
  std::size_t i = out.leg;
  if (now > nodes_[i + 1].place - nodes_[i + 1].half) ++i;
  const Node& node = nodes_[i];
  const bool changes = node.half > 0 && std::abs(now - node.place) < node.half;
  const Piece* line = changes ? (i > 0 ? &pieces_[i - 1] : nullptr) : &here;
  out.position = line != nullptr ? line->start : start();
  if (line != nullptr) {
    for (std::size_t axis = 0; axis < out.position.size(); ++axis) {
      out.position[axis] += line->direction[axis] * line->distance(now);
      out.velocity[axis] += line->direction[axis] * line->lead(now);
    }
  }
  if (!changes) return out;
  const double h = node.half, t = now - node.place, x = (t + h) / (2 * h);
  for (std::size_t axis = 0; axis < out.position.size(); ++axis) {
    const double change = node.step[axis], slope = node.slope[axis];
    out.position[axis] += 2 * h * change * share_integral(x) +
                          2 * h * h * slope * (2 * share_moment(x) - share_integral(x)) +
                          slope * h * h / 12 * correction(x);
    out.velocity[axis] += (change + slope * t) * share(x) + slope * h / 24 * correction_velocity(x);
  }
  return out;
}

// The place where the velocity changes to 0 is brought forward; the pitch line ends there.
void ThreadPath::brake_from(double angle) {
  const double now = turned(angle);
  if (now <= -nodes_.front().half) {
    pieces_.resize(1);
    nodes_.resize(2);
    nodes_[1] = nodes_[0] = Node{now, 0, {}, {}};
    pieces_[0].begin = now;
    pieces_[0].revolutions = 0;
    end_ = start();
    whole_ = false;
    return;
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    const double from = std::max(now, nodes_[i].place + nodes_[i].half);
    const double last = piece.begin + piece.revolutions;
    if (from > nodes_[i + 1].place - nodes_[i + 1].half) continue;
    double place = from;
    Node stop;
    for (int pass = 0; pass < 3; ++pass) {  // the lead at the place decides how far away it is
      stop = node_between(&piece, nullptr, place);
      place = from + stop.half;
    }
    if (stop.half < 0 || !(place < last)) continue;
    stop = node_between(&piece, nullptr, place);
    end_ = piece.start;
    for (std::size_t axis = 0; axis < end_.size(); ++axis)
      end_[axis] += piece.direction[axis] * piece.distance(place);
    piece.revolutions = place - piece.begin;
    pieces_.resize(i + 1);
    nodes_.resize(i + 2);
    nodes_.back() = stop;
    nodes_.back().half = std::min(stop.half, place - from);
    whole_ = false;
    return;
  }
}

double ThreadPath::length_of_run_in() const {
  return pieces_.front().distance(pieces_.front().begin + nodes_.front().half);
}

double ThreadPath::length_of_run_out() const {
  const Piece& piece = pieces_.back();
  const double place = nodes_.back().place;
  return piece.distance(place) - piece.distance(place - nodes_.back().half);
}

}  // namespace trunnion::program_execution
