// SPDX-License-Identifier: Apache-2.0
#include "motion/compressor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trunnion::motion {
namespace {

using canonical::axis_count;

// Longer lines are lines, mm.
constexpr double longest_line = 5;
// Shorter runs have nothing to average, and the roundings of their corners overlap little.
constexpr std::uint64_t least_lines = 8;
// A window is full with this number of lines, or with this way, mm, in not too few lines.
constexpr std::uint64_t most_lines = 512, least_window = 16;
constexpr double window_way = 16;
// A join with a line this many times the tolerance by its jump of direction is a corner: its rounding hardly
// reaches the next joins, and the chords of a circle with such joins stray from it by half the tolerance.
constexpr double corner_size = 4;
// Or where the direction turns by this, degrees, over a way that the last decimals cannot turn: multiples of
// the tolerance, or a number of lines.
constexpr double corner_angle = 60, corner_share = 0.6, corner_way = 4;
constexpr std::uint64_t corner_lines = 16;
// The tube of a point: at most a share of the tolerance, less beside a corner, whose rounding takes the rest;
// at least what the last decimals make of it, and mm or degrees for a curve that is not a circle.
constexpr double most_tube = 0.9, end_tube = 0.3, grain_share = 0.8;
constexpr double linear_floor = 1e-4, rotary_floor = 5e-4, least_tube = 1e-12;
// Neighbours whose points count.
constexpr std::uint64_t tube_neighbours = 2;
// Of the tolerance, what a piece may take: beside a corner, and elsewhere.
constexpr double end_share = 0.5, piece_share = 0.95;
// Lines instead of a curve that does not keep its tolerance.
constexpr std::uint64_t abandoned_lines = 16;
// A piece is no shorter, mm: what lies beyond a knot by less belongs to the piece before.
constexpr double shortest_part = 1e-6;
// Where the parameter of the curve is not its length, the programmed speed is corrected in steps of this
// share, when it would be off by more than the other.
constexpr double feed_step = 1e-3, feed_error = 8e-4;
// Decimals make lines longer than the curve. Their length is measured over this many decimals, and at most
// this many lines to each side.
constexpr double length_grains = 60;
constexpr std::uint64_t length_lines = 24;
constexpr double shortest_curve = 0.3;  // of its lines
constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
double chord_of(double degrees) { return 2 * std::sin(degrees * (std::numbers::pi / 360)); }

double size3(const AxisValues& v) { return std::hypot(v[0], v[1], v[2]); }

bool is_short_line(const PathBlock& block) {
  const PathSegment& path = block.path;
  if (block.rapid || path.is_arc() || path.unit() != LengthUnit::millimetre) return false;
  if (!(path.length() > 0) || path.length() > longest_line || path.feed_scale() != 1) return false;
  const AxisValues slope = path.derivative(0);
  // The length has to be that of X Y Z, or the curve would have no direction.
  if (size3(slope) < 0.999) return false;
  bool turns = false;
  for (std::size_t i = 0; i < axis_count; ++i) turns = turns || (canonical::is_rotary(i) && slope[i] != 0);
  return block.rules.contour_tolerance > 0 && !(turns && !(block.rules.orientation_tolerance > 0));
}

double fraction_at(const PathBlock& block, double done) {
  return block.fraction_offset + (1 - block.fraction_offset) * done;
}

}  // namespace

Compressor::Compressor() : entries_(capacity) { window_.reserve(capacity + 1); }

void Compressor::clear() {
  decimals_.clear();
  front_ = next_ = decided_ = scanned_ = closed_ = plain_until_ = 0;
  open_ = left_line_ = false;
  span_ = spans_ = 0;
}

// A curve ends at the start of the block, or may do so.
Compressor::Break Compressor::join_of(std::uint64_t number) const {
  if (number == 0 || number == closed_) return Break::yes;
  const Entry &before = at(number - 1), &here = at(number);
  if (!before.short_line || !here.short_line || here.block.stop) return Break::yes;
  if (before.block.rules != here.block.rules) return Break::yes;
  const AxisValues a = before.block.path.derivative(0), b = here.block.path.derivative(0);
  AxisValues turn{};
  for (std::size_t i = 0; i < axis_count; ++i) turn[i] = b[i] - a[i];
  const double shorter = std::min(before.block.path.length(), here.block.path.length());
  if (weigh(turn, here.block.rules) * shorter > corner_size) return Break::yes;
  return size3(turn) > chord_of(corner_share * corner_angle) ? Break::open : Break::no;
}

// The direction over some way before the start of a block against that behind it. Not `known` when too little
// of the path is.
bool Compressor::turns_widely(std::uint64_t number, bool& known) const {
  const double way = corner_way * at(number).block.rules.contour_tolerance;
  double travelled = 0;
  std::uint64_t from = number, to = number;
  while (travelled < way && number - from < corner_lines && from > front_) {
    if (from < number && at(from).begins == Break::yes) break;
    --from;
    travelled += at(from).block.path.length();
  }
  known = true;
  travelled = 0;
  while (travelled < way && to - number < corner_lines) {
    if (to == next_) {
      known = closed_ == next_;
      break;
    }
    if (to > number && at(to).begins == Break::yes) break;
    travelled += at(to).block.path.length();
    ++to;
  }
  if (!known || to == number || from == number) return known;
  const AxisValues &a = at(from).block.path.start(), &b = at(number).block.path.start(),
                   &c = at(to - 1).block.path.target();
  AxisValues before{}, behind{};
  for (std::size_t i = 0; i < 3; ++i) {
    before[i] = b[i] - a[i];
    behind[i] = c[i] - b[i];
  }
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += before[i] * behind[i];
  return along < std::cos(corner_angle * (std::numbers::pi / 180)) * size3(before) * size3(behind);
}

// The length of a line as that of the curve: over a longer way, which the last decimals turn by less. False
// when too little of the path is known.
bool Compressor::measure_length(std::uint64_t number) {
  Entry& here = at(number);
  here.length = here.block.path.length();
  const double reach = 0.5 * length_grains * decimals_.about(number, here.block.rules).linear;
  std::uint64_t from = number, to = number;
  double before = 0, behind = 0;
  while (before < reach && number - from < length_lines && at(from).begins == Break::no) {
    --from;
    before += at(from).block.path.length();
  }
  while (behind < reach && to - number < length_lines) {
    if (to + 1 == next_ && closed_ != next_) return false;
    if (to + 1 == next_ || at(to + 1).begins == Break::yes) break;
    ++to;
    behind += at(to).block.path.length();
  }
  const AxisValues &a = at(from).block.path.start(), &b = at(to).block.path.target();
  const double way = before + here.length + behind;
  here.length *= std::max(shortest_curve, size3({b[0] - a[0], b[1] - a[1], b[2] - a[2]}) / way);
  return true;
}

// What the blocks known so far settle: where curves end, and how long lines are.
void Compressor::decide() {
  for (; decided_ < next_; ++decided_) {
    Entry& entry = at(decided_);
    if (!entry.short_line) continue;
    if (entry.begins == Break::open) {
      bool known = false;
      const bool turns = turns_widely(decided_, known);
      if (!known) return;
      entry.begins = turns ? Break::yes : Break::no;
    }
    entry.u = entry.begins == Break::yes ? 0 : at(decided_ - 1).u + at(decided_ - 1).length;
    if (!measure_length(decided_)) return;
  }
}

// How far the start of a line is from the line between its neighbours, at the same share of the way.
void Compressor::measure(std::uint64_t number) {
  Entry& here = at(number);
  here.linear = here.rotary = 0;
  if (here.begins == Break::yes) return;
  const PathSegment &before = at(number - 1).block.path, &behind = here.block.path;
  const double share = before.length() / (before.length() + behind.length());
  AxisValues off{};
  for (std::size_t i = 0; i < axis_count; ++i)
    off[i] = behind.start()[i] - before.start()[i] - share * (behind.target()[i] - before.start()[i]);
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < axis_count; ++i) (canonical::is_rotary(i) ? rotary : linear) += off[i] * off[i];
  here.linear = std::sqrt(linear);
  here.rotary = std::sqrt(rotary);
}

void Compressor::push(const PathBlock& block, double corner_angle) {
  Entry& entry = at(next_);
  entry.block = block;
  entry.short_line = is_short_line(block);
  decimals_.begin(next_);
  if (entry.short_line) {
    AxisValues change{};
    for (std::size_t i = 0; i < axis_count; ++i) change[i] = block.path.target()[i] - block.path.start()[i];
    decimals_.add(change);
    if (corner_angle < 180 && next_ > front_ && at(next_ - 1).short_line) {
      const AxisValues a = at(next_ - 1).block.path.derivative(0), b = block.path.derivative(0);
      if (size3({b[0] - a[0], b[1] - a[1], b[2] - a[2]}) > chord_of(corner_angle)) entry.block.stop = true;
    }
  }
  entry.begins = join_of(next_);
  measure(next_);
  ++next_;
  decide();
}

void Compressor::end_section() {
  closed_ = next_;
  decide();
}

// Where the curve from front_ on ends, as far as that is known.
std::uint64_t Compressor::find_end() {
  scanned_ = std::max(scanned_, front_ + 1);
  while (scanned_ < decided_ && at(scanned_).begins == Break::no) ++scanned_;
  if (scanned_ < decided_) return scanned_;
  return scanned_ == next_ && closed_ == next_ ? next_ : none;
}

std::uint64_t Compressor::full_at() const {
  if (decided_ <= front_ + 1) return none;
  const std::uint64_t last = decided_ - 1, lines = last - front_;
  const double way = at(last).u - (open_ ? at_ : at(front_).u);
  return lines >= most_lines || (lines >= least_window && way >= window_way) ? last : none;
}

Vertex Compressor::vertex(std::uint64_t number) const {
  Vertex vertex;
  if (number > front_) {
    const Entry& before = at(number - 1);
    vertex.at = before.block.path.target();
    vertex.u = before.u + before.length;
  } else {
    vertex.at = at(number).block.path.start();
    vertex.u = at(number).u;
  }
  const BlendRules& rules = at(front_).block.rules;
  const std::uint64_t lowest = number > tube_neighbours ? number - tube_neighbours : 0;
  for (std::uint64_t k = lowest; k < std::min(next_, number + tube_neighbours + 1); ++k) {
    vertex.linear = std::max(vertex.linear, at(k).linear);
    vertex.rotary = std::max(vertex.rotary, at(k).rotary);
  }
  const Grain grain = decimals_.about(number, rules);
  vertex.linear = std::max(vertex.linear, grain_share * grain.linear);
  vertex.rotary = std::max(vertex.rotary, grain_share * grain.rotary);
  const bool end = number < first_of_curve_ + 2 || (ends_ && number + 2 > last_);
  const double share = end ? end_tube : most_tube;
  vertex.linear = std::min(share * rules.contour_tolerance, vertex.linear + linear_floor);
  vertex.rotary =
      std::max(std::min(share * rules.orientation_tolerance, vertex.rotary + rotary_floor), least_tube);
  return vertex;
}

bool Compressor::fit() {
  const std::uint64_t end = find_end(), full = full_at();
  if (end == none && full == none) return false;
  ends_ = end != none;
  last_ = ends_ ? end : full;
  if (!open_) {
    open_ = true;
    spline_.clear();
    first_of_curve_ = front_;
    feed_factor_ = 1;
    at_ = at(front_).u;
  }
  window_.clear();
  for (std::uint64_t k = front_; k <= last_; ++k) window_.push_back(vertex(k));
  spline_.fit(window_, ends_);
  span_ = 0;
  spans_ = spline_.size();
  return true;
}

// The next piece of the curve: the part of a line's command that lies on one span.
const PathBlock* Compressor::piece() {
  const Entry& entry = at(front_);
  const PathSegment& line = entry.block.path;
  const CurveSpan span = spline_[span_];
  const double span_end = span.u + span.length, line_end = entry.u + entry.length;
  const bool whole = span_end >= line_end - shortest_part;  // up to the end of the line
  const double end = whole ? line_end : span_end, length = end - at_;
  const Cubic curve = shifted(span.curve, at_ - span.u);
  const bool first = front_ == first_of_curve_ && at_ == entry.u;

  AxisValues start = line.start(), slope{};
  for (std::size_t i = 0; i < axis_count; ++i) {
    slope[i] = (line.target()[i] - line.start()[i]) / entry.length;
    start[i] += (at_ - entry.u) * slope[i];
  }
  const CurveDeviation off = deviation_bound(curve, start, slope, length);
  const BlendRules& rules = entry.block.rules;
  const double strayed = std::max(off.linear / rules.contour_tolerance,
                                  off.rotary > 0 ? off.rotary / rules.orientation_tolerance : 0.0);
  const bool at_end = front_ == first_of_curve_ || (ends_ && front_ + 1 == last_);
  if (!(strayed <= (at_end ? end_share : piece_share))) return abandon(first);

  const PathBlock& source = entry.block;
  if (first) {
    ready_ = source;
  } else {
    ready_ = source;
    ready_.stop = false;
    ready_.wait_cycles = 0;
    ready_.smooth = true;
  }
  const bool meets = whole && ends_ && front_ + 1 == last_;
  ready_.path = PathSegment::curve(curve, length, line.target(), meets);
  ready_.strayed = strayed;
  ready_.line_length = line.length();
  ready_.fraction_offset = fraction_at(source, (at_ - entry.u) / entry.length);
  ready_.fraction_end = whole ? 1 : fraction_at(source, (end - entry.u) / entry.length);
  feed_factor_ = feed_factor(ready_.path);
  ready_.feed = source.feed * feed_factor_;
  at_ = end;
  if (whole) ++front_;
  if (span_end <= end + shortest_part) ++span_;
  if (span_ == spans_ && ends_) open_ = false;
  return &ready_;
}

double Compressor::feed_factor(const PathSegment& path) const {
  const double length = path.length();
  const double rate =
      (size3(path.derivative(0)) + 4 * size3(path.derivative(length / 2)) + size3(path.derivative(length))) /
      6;
  if (std::abs(rate * feed_factor_ - 1) <= feed_error) return feed_factor_;
  return feed_step * std::round(1 / (feed_step * std::max(rate, shortest_curve)));
}

// The curve is left where the last piece ended, and motion stops there: what is executed by now is no corner.
// Lines follow.
const PathBlock* Compressor::abandon(bool first) {
  open_ = false;
  span_ = spans_ = 0;
  plain_until_ = std::min(last_, front_ + abandoned_lines);
  if (!first) {
    left_line_ = true;
    at(front_).block.stop = true;
    at(front_).block.overlap = false;
    left_at_ = ready_.path.position(ready_.path.length());
  }
  return plain();
}

const PathBlock* Compressor::plain() {
  Entry& entry = at(front_++);
  if (!left_line_) return &entry.block;
  left_line_ = false;
  const double done = (at_ - entry.u) / entry.length, strayed = ready_.strayed;
  ready_ = entry.block;
  ready_.path = PathSegment::line(left_at_, entry.block.path.target());
  ready_.fraction_offset = fraction_at(entry.block, done);
  ready_.strayed = strayed;
  return &ready_;
}

const PathBlock* Compressor::take() {
  while (true) {
    if (span_ < spans_) return piece();
    if (front_ == next_) return nullptr;
    if (front_ < plain_until_ || !at(front_).short_line) return plain();
    if (!open_) {
      const std::uint64_t end = find_end();
      if (end != none && end - front_ < least_lines) {
        plain_until_ = end;
        continue;
      }
    }
    if (!fit()) return nullptr;
  }
}

}  // namespace trunnion::motion
