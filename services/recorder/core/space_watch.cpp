// SPDX-License-Identifier: Apache-2.0
#include "space_watch.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "recording/disk_space.hpp"

namespace trunnion::recorder {
namespace {

constexpr double look_seconds = 1, rate_seconds = 60;
constexpr double least_seconds = 2;  // of samples, for a rate
constexpr double enough = 1.1;       // of the needed space: the warning must not come and go

std::string time_text(double seconds) {
  char text[32];
  if (seconds < 120)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 7200)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  else
    std::snprintf(text, sizeof text, "%.0f h", seconds / 3600);
  return text;
}

}  // namespace

double SpaceWatch::rate() const {
  const auto &oldest = samples_.front(), &newest = samples_.back();
  const double elapsed = newest.time - oldest.time;
  if (elapsed <= 0) return 0;
  // Other programs fill the disk, too; a file system may count what was written only later.
  return std::max(newest.written - oldest.written, oldest.free - newest.free) / elapsed;
}

SpaceWatch::Finding SpaceWatch::look(const std::string& path, std::uint64_t free, std::uint64_t written,
                                     double now) {
  next_ = now + look_seconds;
  samples_.push_back({now, static_cast<double>(free), static_cast<double>(written)});
  while (samples_.front().time < now - rate_seconds) samples_.pop_front();
  if (free < reserve()) {
    if (low_ && told_ < 0) return {};
    low_ = true;
    told_ = -1;
    return {Kind::full, path + ": the disk is full: " + recording::size_text(free) + " are free, the last " +
                            recording::size_text(reserve()) + " are kept for the machine"};
  }
  if (free < needed_ && now - samples_.front().time >= least_seconds) return low(path);
  if (!low_ || static_cast<double>(free) < enough * static_cast<double>(needed_)) return {};
  low_ = false;
  return {Kind::enough, ""};
}

SpaceWatch::Finding SpaceWatch::low(const std::string& path) {
  const double bytes_per_second = rate(), free = samples_.back().free;
  const double left = bytes_per_second > 0 ? (free - static_cast<double>(reserve())) / bytes_per_second
                                           : std::numeric_limits<double>::infinity();
  if (low_ && left >= told_ / 2) return {};
  low_ = true;
  told_ = left;
  std::string text = recording::size_text(static_cast<std::uint64_t>(free)) + " are free";
  if (bytes_per_second > 0)
    text += ": the recording ends in " + time_text(left) + " at " +
            recording::size_text(static_cast<std::uint64_t>(bytes_per_second)) + "/s";
  return {Kind::low, text + "; disk of " + path};
}

}  // namespace trunnion::recorder
