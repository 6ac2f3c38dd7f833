// SPDX-License-Identifier: Apache-2.0
// Replaces runs of short lines by a smooth curve through, or evenly about, their points.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/blended_path.hpp"
#include "motion/decimals.hpp"
#include "motion/smoothing_spline.hpp"

namespace trunnion::motion {

/// Takes the blocks of a path and gives them back in the same sequence. Lines that follow each other without
/// a corner come back as pieces of one curve, each with the part of its command that it is. The curve begins
/// and ends at programmed points: where a block is no short line, at a stop, at a corner, and where the
/// tolerance changes. It stays within the tolerances of the polyline. What comes back depends on the sequence
/// of blocks and of end_section() alone. Nothing allocates after construction.
class Compressor {
 public:
  /// More blocks than ever wait, and more pieces than one push() adds to the path.
  static constexpr std::uint64_t capacity = 1024;
  static constexpr std::uint64_t most_pieces = SmoothingSpline::most_spans + capacity;

  Compressor();

  void clear();
  bool empty() const { return front_ == next_; }
  /// Blocks that wait.
  std::uint64_t size() const { return next_ - front_; }

  /// Appends a block that begins where the last one ended. Where the direction turns by more than
  /// `corner_angle` degrees, motion will stop. take() has to follow until it gives nothing.
  void push(const PathBlock& block, double corner_angle);
  /// A curve ends with the newest block.
  void end_section();
  /// The curve that the last block given back is a piece of goes on for at least this length, mm.
  double smooth_ahead() const { return open_ ? at(decided_ - 1).u - at_ : 0; }
  /// The next block of the path, valid until the next call; nullptr: more has to be known first.
  const PathBlock* take();

 private:
  enum class Break : std::uint8_t { no, yes, open };
  struct Entry {
    PathBlock block;
    double u = 0, length = 0;       // parameter of the curve at the start, and over the line
    double linear = 0, rotary = 0;  // distance of the start from the line between its neighbours
    bool short_line = false;
    Break begins = Break::yes;  // a curve ends at the start
  };

  Entry& at(std::uint64_t number) { return entries_[number % capacity]; }
  const Entry& at(std::uint64_t number) const { return entries_[number % capacity]; }
  Break join_of(std::uint64_t number) const;
  bool turns_widely(std::uint64_t number, bool& known) const;
  bool measure_length(std::uint64_t number);
  void decide();
  void measure(std::uint64_t number);
  std::uint64_t find_end();
  std::uint64_t full_at() const;
  Vertex vertex(std::uint64_t number) const;
  bool fit();
  double feed_factor(const PathSegment& path) const;
  const PathBlock* piece();
  const PathBlock* abandon(bool first);
  const PathBlock* plain();

  std::vector<Entry> entries_;  // ring
  Decimals decimals_;
  std::uint64_t front_ = 0, next_ = 0, decided_ = 0;
  std::uint64_t scanned_ = 0;      // no curve ends at the start of an entry from front_ + 1 to before this
  std::uint64_t closed_ = 0;       // the path ended here once
  std::uint64_t plain_until_ = 0;  // these blocks stay lines
  std::vector<Vertex> window_;
  SmoothingSpline spline_;
  std::uint64_t first_of_curve_ = 0, last_ = 0;  // of the curve, of the window: numbers of vertices
  bool open_ = false, ends_ = false;             // a curve has begun; it ends with the window
  std::size_t span_ = 0, spans_ = 0;             // next to be given back, and how many
  double at_ = 0;                                // u up to which the curve has been given back
  double feed_factor_ = 1;
  bool left_line_ = false;  // the next line begins at left_at_, not at its programmed start
  AxisValues left_at_{};
  PathBlock ready_;
};

}  // namespace trunnion::motion
