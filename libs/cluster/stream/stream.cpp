// SPDX-License-Identifier: Apache-2.0
#include "stream/frame_window.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::stream {
template class FrameWindow<idl::stream::PathFrame>;
template class FrameWindow<idl::stream::AxisFrame>;
}  // namespace trunnion::stream
