// SPDX-License-Identifier: Apache-2.0
// The gateway against a recording: its topics over the bus, the operator's requests over HTTP.
#pragma once

#include "verification/stored_recording.hpp"
#include "verification/verify.hpp"

namespace trunnion::verification {

/// As verify(), for the service gateway: compared are what it asks on the bus, its journal, every answer, and
/// at each sample of the plan the state it sends to its WebSocket clients.
VerifyResult verify_gateway(const VerifyOptions& options, const StoredRecording& recording);

}  // namespace trunnion::verification
