// SPDX-License-Identifier: Apache-2.0
// One topic of a recording as a table.
#pragma once

#include <ostream>

#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// Comma-separated, quoted as RFC 4180 says, numbers so that they read back to the same bits. Batches of the
/// stream give a line for each cycle (cycle, channel, epoch, then the fields), everything else one for each
/// message (time in ns, then the fields). The last column is the time of the message, ISO 8601 in UTC; the
/// lines of one batch have the same. A field that some lines do not have is empty there. Returns the number
/// of lines after the header.
std::size_t write_csv(const StoredRecording& recording, const bus::TopicEntry& topic, std::ostream& out);

}  // namespace trunnion::verification
