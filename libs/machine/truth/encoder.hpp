// SPDX-License-Identifier: Apache-2.0
// What an encoder reads of a position: sign, resolution, interpolation error, missing pulses, reference
// marks.
#pragma once

#include <array>
#include <optional>

#include "truth/drive_truth.hpp"

namespace trunnion::truth {

/// Error of a 1 Vpp signal with faults, by the position: what the arc tangent of both signals gives, less the
/// position. mm or deg.
double interpolation_error(const EncoderTruth& encoder, double position);

/// The marks of a distance-coded scale. Mark 2 j is at first + j spacing, mark 2 j + 1 at first + (j + 1/2)
/// spacing + j increment, j = 1, 2 .. : the gap from mark 2 j to the next is spacing / 2 + j increment, to
/// the one before spacing / 2 - (j - 1) increment, so every gap is there once.
double distance_coded_mark(const EncoderTruth& encoder, long number);
/// Position of the upper one of two neighbouring marks by their distance; nothing when there is no such gap.
std::optional<double> decode_gap(const EncoderTruth& encoder, double distance);

class Encoder {
 public:
  void configure(const EncoderTruth& encoder) {
    truth_ = encoder;
    free_from_ = free_to_ = 0;
  }
  /// Switched on at `position`. An absolute encoder reads it; the others begin at zero.
  void start(double position);
  /// The axis has moved to `position`; the reading follows, and marks are latched.
  void move(double position);

  /// mm or deg.
  double reading() const { return reading_; }
  /// Position of the axis less reading(): of an absolute encoder zero, of a distance-coded one after two
  /// neighbouring marks, of an incremental one never: its index marks do not differ.
  std::optional<double> reference() const;
  /// Reading at the newest mark, and how many were passed.
  double mark_latch() const { return latches_[0]; }
  std::uint64_t marks() const { return marks_; }

  /// No field, configure() sets it: truth_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("position", self.position_), visit("reading", self.reading_), visit("origin", self.origin_);
    visit("lost", self.lost_), visit("latches", self.latches_), visit("marks", self.marks_);
    visit("reference", self.reference_), visit("referenced", self.referenced_);
  }

 private:
  double read(double position) const;
  void pass_marks(double from, double to);
  void latch(double mark);
  bool between_marks(double position) const { return position > free_from_ && position < free_to_; }
  void find_free_interval(double position);

  EncoderTruth truth_;
  double position_ = 0, reading_ = 0, origin_ = 0, lost_ = 0;
  std::array<double, 2> latches_{};  // newest first, readings
  std::uint64_t marks_ = 0;          // passed since the start
  double reference_ = 0;
  bool referenced_ = false;
  double free_from_ = 0, free_to_ = 0;  // no fields: a place without marks, which follows from truth_
};

}  // namespace trunnion::truth
