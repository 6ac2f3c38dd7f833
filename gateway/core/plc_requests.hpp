// SPDX-License-Identifier: Apache-2.0
// JSON of an HTTP body -> a request to the programs of the running PLC, checked.
#pragma once

#include <string>
#include <vector>

#include "core/requests.hpp"

namespace trunnion::gateway {

struct PlcSource {
  std::string name, text;
};

/// {"values": [{"path": "main.n", "value": "5"}], "permanent": false}; the value is a literal of the
/// language. Throws BadRequest, as the others do.
idl::plc::OnlineRequest force_request(const bus::Json& body);
/// {"paths": ["main.n"]}; without paths everything that is forced.
idl::plc::OnlineRequest release_request(const bus::Json& body);
/// {"paths": ["main.n", "%G300"]}, 1 to 256.
idl::plc::OnlineRequest watch_request(const bus::Json& body);
/// {"paths", "scans": 1000, "when": {"path", "is": "=", "<>", "<", ">" or "changed", "value": "5"}}.
idl::plc::OnlineRequest trace_request(const bus::Json& body);
/// {"files": [{"name": "main.st", "text": "..."}]}, 1 to 256.
std::vector<PlcSource> load_files(const bus::Json& body);
/// What loads these files: BEGIN_LOAD, their parts, COMPILE.
std::vector<idl::plc::OnlineRequest> load_requests(const std::vector<PlcSource>& files);

}  // namespace trunnion::gateway
