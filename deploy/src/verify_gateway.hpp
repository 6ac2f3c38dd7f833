// The gateway against a recording: its topics over the bus, the operator's requests over HTTP.
#pragma once

#include "replay/stored_recording.hpp"
#include "verify.hpp"

namespace trunnion::deploy {

/// As verify(), for the service gateway: compared are what it asks on the bus, its journal, every answer, and
/// at each look of the plan the state it sends to its WebSocket clients.
VerifyResult verify_gateway(const VerifyOptions& options, const replay::StoredRecording& recording);

}  // namespace trunnion::deploy
