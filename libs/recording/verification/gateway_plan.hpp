// SPDX-License-Identifier: Apache-2.0
// What the gateway is given from a recording: the topics it shows, and over HTTP what the operator asked.
#pragma once

#include <deque>
#include <optional>

#include "verification/verify_plan.hpp"

namespace trunnion::verification {

using OperatorLine = idl::gateway::OperatorRequest;

/// One line of the recorded operator journal.
struct OperatorRequest {
  OperatorLine line;
  std::string body;  ///< the whole
  /// The recorded reply to each request on the bus that was made of it; none where there was none.
  std::vector<std::optional<StoredMessage>> replies;
};

struct GatewayStep {
  enum class Kind {
    feed,   ///< write `message`
    ask,    ///< send `request` over HTTP; what the gateway then asks on the bus is answered with its replies
    sample  ///< what it shows must be what follows from what it was fed
  };
  Kind kind = Kind::feed;
  const StoredMessage* message = nullptr;
  const OperatorRequest* request = nullptr;
};

struct GatewayPlan {
  VerifyPlan outputs;  ///< all but steps and end
  std::deque<OperatorRequest> requests;
  std::vector<GatewayStep> steps;
  /// Lines that cannot be sent again: nobody waited for the answer, the body or a file it
  /// is answered from is not in the recording, or who sent it was refused for who he is (no login, a role,
  /// another station operates).
  std::size_t left_out = 0;
};

/// Everything in the order of the writers' clocks, requests at the place where the gateway acted on them, one
/// at a time. It samples before a request (not while a continuous jog must be renewed), around alarms, every
/// `sample_every` messages and at the end. Throws std::runtime_error when the recording has nothing to show.
GatewayPlan plan_gateway(const StoredRecording& recording, std::size_t sample_every = 256);
GatewayPlan plan_gateway(StoredRecording&&, std::size_t = 0) = delete;  // steps point into it

/// The gateway's outputs among `messages` in a form that two processes have in common: the journal's lines
/// numbered from 1 in the order of `lines`, and of the requests on the bus the client is the number of their
/// line, the number counts within the line; repetitions are left out. What belongs to no line is kept with
/// client 0 when `strays` is true.
std::vector<StoredMessage> by_line(const std::vector<StoredMessage>& messages,
                                   const std::vector<OperatorLine>& lines, bool strays);

/// The client and number of a request on the bus; none when `message` is not one.
std::optional<std::pair<std::uint64_t, std::uint64_t>> asker_of(const StoredMessage& message);

/// The recorded reply to a request, addressed to whoever wrote `request` now.
bus::Bytes addressed_to(const StoredMessage& reply, const StoredMessage& request);
/// The topic that answers a topic of requests; null when none does.
const bus::TopicEntry* reply_topic(const bus::TopicEntry& request);

}  // namespace trunnion::verification
