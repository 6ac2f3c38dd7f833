// SPDX-License-Identifier: Apache-2.0
// Whether the disk of a recording fills up, and when: from the free space and the bytes written, once a
// second.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace trunnion::recorder {

class SpaceWatch {
 public:
  /// Bytes free below which space is low; 0 = nothing is watched. Below a tenth of it the recording must end,
  /// so that the machine can still store its state.
  explicit SpaceWatch(std::uint64_t needed) : needed_(needed) {}

  enum class Kind {
    unchanged,
    low,     ///< less than needed: text states the time left; again whenever that has halved
    enough,  ///< there is space again
    full     ///< the recording must end: text states why; once
  };
  struct Finding {
    Kind kind = Kind::unchanged;
    std::string text;
  };

  /// A second has passed since the last look, in seconds of a monotonic clock.
  bool due(double now) const { return needed_ != 0 && now >= next_; }
  /// `free` bytes on the disk of the file `path`, `written` bytes of the recording on it.
  Finding look(const std::string& path, std::uint64_t free, std::uint64_t written, double now);

 private:
  struct Sample {
    double time = 0, free = 0, written = 0;
  };
  std::uint64_t reserve() const { return needed_ / 10; }
  /// Bytes/s by which the disk fills up, over the last minute.
  double rate() const;
  Finding low(const std::string& path);

  const std::uint64_t needed_;
  double next_ = 0;
  std::deque<Sample> samples_;
  bool low_ = false;
  double told_ = 0;  // s left, as stated last; below 0: the disk is full
};

}  // namespace trunnion::recorder
