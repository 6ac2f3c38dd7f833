// SPDX-License-Identifier: Apache-2.0
#include "reading_progress.hpp"

#include <algorithm>
#include <limits>

#include "bus/shared_history.hpp"

namespace trunnion::recorder {

void ReadingProgress::read(const idl::stream::Feedback& feedback, std::size_t bytes) {
  if (feedback.count > 0)
    bytes_per_cycle_ = std::max<std::uint64_t>(bytes_per_cycle_, bytes / feedback.count);
  const auto kept = bus::SharedHistory::capacity * 3 / 4 / bytes_per_cycle_;
  report_.until = feedback.first + feedback.count + std::clamp(kept, least, most);
  news_ = true;
}

std::optional<idl::stream::RecordingProgress> ReadingProgress::take() {
  if (!news_) return std::nullopt;
  news_ = false;
  return report_;
}

idl::stream::RecordingProgress ReadingProgress::ended() const {
  return {report_.recorder, std::numeric_limits<std::uint64_t>::max()};
}

}  // namespace trunnion::recorder
