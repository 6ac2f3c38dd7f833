// What a channel may ask of the drive: StreamRequest::kind.
#pragma once

#include <cstdint>

namespace trunnion::drive {

/// `home` names the logical number of the axis in `epoch`.
enum class StreamRequestKind : std::uint8_t { start = 1, resume = 2, start_epoch = 3, leave = 4, home = 5 };

}  // namespace trunnion::drive
