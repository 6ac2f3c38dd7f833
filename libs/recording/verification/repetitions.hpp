// SPDX-License-Identifier: Apache-2.0
// A client sends a request again when no reply comes within 200 ms (service/request.hpp). The service takes
// it once and answers the others with the reply it gave, or not at all while it has none. How often that
// happens follows from the load of the computer alone, so a verification leaves repetitions out.
#pragma once

#include <vector>

#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// Keeps one copy of each request and of its reply, by client and number. Of a request it is the copy that
/// the service says it took (AppliedInput), else the first. Replies to nobody's recorded request all stay.
void drop_repetitions(std::vector<StoredMessage>& messages);

}  // namespace trunnion::verification
