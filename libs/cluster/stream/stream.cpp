// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_window.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::stream {
template class BatchWindow<idl::stream::PathBatch>;
template class BatchWindow<idl::stream::AxisBatch>;
}  // namespace trunnion::stream
