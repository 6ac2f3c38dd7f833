// SPDX-License-Identifier: Apache-2.0
// The operator journal: what was asked over HTTP, line by line. docs/topics.md, operator_request.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "access/sessions.hpp"
#include "contracts/types.hpp"
#include "core/router.hpp"

namespace trunnion::gateway {

using JournalLine = idl::gateway::OperatorRequest;

/// The requests on the bus that were made of one over HTTP: their client, the number of the first, how many.
struct Asked {
  std::uint64_t client = 0, number = 0;
  std::uint32_t requests = 0;
};

/// Forces and loads are in the journal of the PLC, and its other requests change nothing.
bool is_of_plc_programs(Operation operation);

/// Whether requests of this operation are kept: all that make the gateway write to the bus, those to the
/// programs of the PLC excepted. Those that only read what it knows are not.
bool is_journaled(Operation operation);

/// A line without body and answer. `address` and `target` are cut off at their bounds.
JournalLine begin_line(idl::gateway::Sender sender, std::string_view address, std::string_view method,
                       std::string_view target);
/// More of the body, or of the answer's. As long as all of it fits it is kept, then its size and CRC alone.
void add_body(JournalLine& line, std::string_view part);
void add_answer(JournalLine& line, std::string_view part);
/// Who was logged in.
void set_user(JournalLine& line, const access::Identity& user);
void set_asked(JournalLine& line, const Asked& asked);

}  // namespace trunnion::gateway
