// SPDX-License-Identifier: Apache-2.0
#include "truth/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace trunnion::truth {

double interpolation_error(const EncoderTruth& e, double position) {
  if (e.signal_period <= 0) return 0;
  const double turns = position / e.signal_period;
  const double angle = 360 * (turns - std::floor(turns));
  const auto exact = geometry::sine_cosine(angle);
  const auto shifted = e.phase == 0 ? exact : geometry::sine_cosine(angle + e.phase);
  const double sine = (1 + e.amplitude) * shifted.sine + e.sine_offset;
  const double cosine = exact.cosine + e.cosine_offset;
  // The angle between the measured and the right pointer, so that there is no jump at a whole turn.
  const double difference = geometry::arc_tangent(sine * exact.cosine - cosine * exact.sine,
                                                  cosine * exact.cosine + sine * exact.sine);
  return difference / (2 * std::numbers::pi) * e.signal_period;
}

double distance_coded_mark(const EncoderTruth& e, long number) {
  const long pair = number / 2;
  const auto j = static_cast<double>(pair);
  return number % 2 == 0 ? e.first_mark + j * e.mark_spacing
                         : e.first_mark + (j + 0.5) * e.mark_spacing + j * e.mark_increment;
}

std::optional<double> decode_gap(const EncoderTruth& e, double distance) {
  const double increments = (distance - e.mark_spacing / 2) / e.mark_increment;
  const double nearest = std::round(increments);
  const double most = e.mark_spacing / 2 / e.mark_increment;
  // A gap that is not a whole number of increments has lost or false pulses in it.
  if (std::abs(increments - nearest) > 0.25 || nearest == 0 || std::abs(nearest) >= most) return std::nullopt;
  const auto j = static_cast<long>(std::abs(nearest));
  return distance_coded_mark(e, nearest > 0 ? 2 * j + 1 : 2 * j + 2);
}

double Encoder::read(double position) const {
  const double measured = position + interpolation_error(truth_, position);
  return (truth_.inverted ? -1 : 1) * std::round((measured - origin_) / truth_.resolution) *
         truth_.resolution;
}

void Encoder::start(double position) {
  position_ = position;
  origin_ = truth_.kind == EncoderKind::absolute ? 0 : position;
  lost_ = 0, marks_ = 0, latches_ = {}, referenced_ = false, reference_ = 0;
  reading_ = read(position);
}

std::optional<double> Encoder::reference() const {
  if (truth_.kind == EncoderKind::absolute) return 0;
  return referenced_ ? std::optional(reference_) : std::nullopt;
}

void Encoder::latch(double mark) {
  latches_[1] = latches_[0];
  latches_[0] = read(mark) + lost_;
  ++marks_;
  if (truth_.kind != EncoderKind::distance_coded || marks_ < 2) return;
  const double sign = truth_.inverted ? -1 : 1;
  const double gap = sign * (latches_[0] - latches_[1]);
  if (const auto upper = decode_gap(truth_, std::abs(gap))) {
    // The upper mark is the newest when the axis moves up.
    reference_ = sign * *upper - (gap > 0 ? latches_[0] : latches_[1]);
    referenced_ = true;
  }
}

void Encoder::pass_marks(double from, double to) {
  const double low = std::min(from, to), high = std::max(from, to);
  const bool up = to > from;
  const double half =
      truth_.kind == EncoderKind::distance_coded ? truth_.mark_spacing / 2 : truth_.mark_spacing;
  // Numbers of marks that may lie between; those of a distance-coded scale are later than regular ones.
  const double shift = truth_.kind == EncoderKind::distance_coded ? 1 : 0;
  const auto first = static_cast<long>(std::floor((low - truth_.first_mark) / half - shift));
  const auto last = static_cast<long>(std::floor((high - truth_.first_mark) / half));
  const auto visit = [&](long number) {
    if (truth_.kind == EncoderKind::distance_coded && number < 2) return;
    const double mark = truth_.kind == EncoderKind::distance_coded
                            ? distance_coded_mark(truth_, number)
                            : truth_.first_mark + static_cast<double>(number) * truth_.mark_spacing;
    if (mark > low && mark <= high) latch(mark);
  };
  if (up)
    for (long n = first; n <= last; ++n) visit(n);
  else
    for (long n = last; n >= first; --n) visit(n);
}

void Encoder::find_free_interval(double position) {
  // Of the cells of half a spacing (incremental: of one) each has the mark at its beginning and, of a
  // distance-coded scale, those which the increments have moved into it from the cell before.
  const bool coded = truth_.kind == EncoderKind::distance_coded;
  const double cell = coded ? truth_.mark_spacing / 2 : truth_.mark_spacing;
  const double number = std::floor((position - truth_.first_mark) / cell);
  free_from_ = truth_.first_mark + number * cell, free_to_ = free_from_ + cell;
  if (coded)
    for (const long n : {static_cast<long>(number) - 1, static_cast<long>(number)}) {
      const double mark = distance_coded_mark(truth_, n);
      if (mark <= position) free_from_ = std::max(free_from_, mark);
      if (mark > position) free_to_ = std::min(free_to_, mark);
    }
  // Beside a mark the exact comparison decides.
  constexpr double margin = 1e-6;  // mm or deg
  free_from_ += margin, free_to_ -= margin;
}

void Encoder::move(double position) {
  if (truth_.kind != EncoderKind::absolute && position != position_) {
    if (!between_marks(position_) || !between_marks(position)) {
      pass_marks(position_, position);
      find_free_interval(position);
    }
    if (truth_.lost_counts != 0 && (position_ < truth_.lost_at) != (position < truth_.lost_at))
      lost_ += (position > position_ ? -1.0 : 1.0) * (truth_.inverted ? -1 : 1) * truth_.lost_counts *
               truth_.resolution;
  }
  position_ = position;
  reading_ = read(position) + lost_;
}

}  // namespace trunnion::truth
