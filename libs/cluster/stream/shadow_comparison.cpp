// SPDX-License-Identifier: Apache-2.0
#include "stream/shadow_comparison.hpp"

#include <iterator>

namespace trunnion::stream {

void ShadowComparison::take(const idl::stream::AxisFrame& frame, Frames& own, Frames& others,
                            bool is_original) {
  const Key key{frame.channel, frame.epoch, frame.first};
  const auto found = others.find(key);
  if (found == others.end()) {
    own.insert_or_assign(key, frame);
  } else {
    const auto& original = is_original ? frame : found->second;
    const auto& shadow = is_original ? found->second : frame;
    if (same_values(original, shadow))
      equal_cycles_ += frame.count;
    else if (!difference_)
      difference_ = difference(original, shadow);
    others.erase(found);
  }
  for (auto* frames : {&own, &others})
    for (auto it = frames->lower_bound({frame.channel, 0, 0});
         it != frames->end() && std::get<0>(it->first) == frame.channel &&
         (std::get<1>(it->first) < frame.epoch || std::get<2>(it->first) + window_cycles < frame.first);)
      it = frames->erase(it);
}

}  // namespace trunnion::stream
