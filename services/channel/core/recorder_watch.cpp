// SPDX-License-Identifier: Apache-2.0
#include "recorder_watch.hpp"

#include <algorithm>

namespace trunnion::channel {

void RecorderWatch::update(const idl::stream::RecordingProgress& progress) {
  if (progress.until == everywhere)
    recorders_.erase(progress.recorder);
  else
    recorders_[progress.recorder] = {progress.until};
}

std::uint64_t RecorderWatch::limit(std::uint64_t beyond, double now) {
  std::uint64_t result = everywhere;
  for (auto at = recorders_.begin(); at != recorders_.end();) {
    auto& recorder = at->second;
    if (beyond <= recorder.until)
      recorder.holds_since = -1;
    else if (recorder.holds_since < 0)
      recorder.holds_since = now;
    if (recorder.holds_since >= 0 && now - recorder.holds_since > report_timeout) {
      at = recorders_.erase(at);
      continue;
    }
    result = std::min(result, recorder.until);
    ++at;
  }
  return result;
}

}  // namespace trunnion::channel
