// SPDX-License-Identifier: Apache-2.0
#include "cycle_call.hpp"

#include <utility>

namespace trunnion::channel {

void CycleCall::begin(CycleRequest request) {
  request.channel = request_.channel;
  request.number = request_.number + 1;
  request.caller = CycleCaller::ASKS;
  request_ = std::move(request);
  outgoing_ = request_;
  answer_.reset();
  open_ = called_ = true;
  heard_ = false;
}

void CycleCall::take(const CycleReply& reply) {
  if (!open_ || reply.channel != request_.channel || reply.number != request_.number) return;
  heard_ = true;
  if (reply.outcome != CycleOutcome::RECEIVED) answer_ = reply;
}

void CycleCall::close() {
  open_ = false;
  answer_.reset();
  publish(CycleCaller::ANSWERED);
}

void CycleCall::publish(CycleCaller caller) {
  request_.caller = caller;
  outgoing_ = request_;
}

void CycleCall::end() {
  open_ = false;
  answer_.reset();
  if (std::exchange(called_, false)) publish(CycleCaller::ENDED);
}

std::optional<CycleRequest> CycleCall::take_request() { return std::exchange(outgoing_, std::nullopt); }

}  // namespace trunnion::channel
