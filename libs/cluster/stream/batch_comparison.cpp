// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_comparison.hpp"

#include <iterator>

namespace trunnion::stream {

void BatchComparison::take(const idl::stream::AxisBatch& batch, Batches& own, Batches& others,
                           bool is_original) {
  const Key key{batch.channel, batch.epoch, batch.first};
  const auto found = others.find(key);
  if (found == others.end()) {
    own.insert_or_assign(key, batch);
  } else {
    const auto& original = is_original ? batch : found->second;
    const auto& standby = is_original ? found->second : batch;
    if (same_values(original, standby))
      equal_cycles_ += batch.count;
    else if (!difference_)
      difference_ = difference(original, standby);
    others.erase(found);
  }
  for (auto* batches : {&own, &others})
    for (auto it = batches->lower_bound({batch.channel, 0, 0});
         it != batches->end() && std::get<0>(it->first) == batch.channel &&
         (std::get<1>(it->first) < batch.epoch || std::get<2>(it->first) + window_cycles < batch.first);)
      it = batches->erase(it);
}

}  // namespace trunnion::stream
