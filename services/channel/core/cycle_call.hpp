// SPDX-License-Identifier: Apache-2.0
// A cycle that a program has called and another service carries out (#3100): its request and its answer.
#pragma once

#include <optional>
#include <string>

#include "contracts/types.hpp"

namespace trunnion::channel {

using idl::channel::CycleCaller;
using idl::channel::CycleOutcome;
using idl::channel::CycleReply;
using idl::channel::CycleRequest;

/// One call is open at a time. The service answers by number; it says at once that it has received a call,
/// and may take its time for the answer.
class CycleCall {
 public:
  explicit CycleCall(std::uint16_t channel) { request_.channel = channel; }

  /// Numbers continue behind those that a process before this one has used up to `epoch` of the stream.
  void continue_numbers(std::uint32_t epoch) { request_.number = (epoch + 1) * numbers_per_epoch; }

  /// `request` without its channel, number and caller.
  void begin(CycleRequest request);
  /// Only a reply to the open call counts.
  void take(const CycleReply& reply);
  /// The program waits, and the service has not said anything.
  bool unheard() const { return open_ && !heard_; }
  bool open() const { return open_; }
  /// CALL, FINISHED or REFUSED: what close() is owed for.
  const std::optional<CycleReply>& answer() const { return answer_; }
  /// The program has its answer.
  void close();
  /// The program has ended: the request says so when the service was called since its beginning.
  void end();

  std::optional<CycleRequest> take_request();

  /// Nothing is open and everything has been taken: the state that fields() lists is whole.
  bool at_rest() const { return !open_ && !outgoing_ && !called_; }
  /// No fields, at rest nothing is open: open_, heard_, called_, answer_, outgoing_. No field, but for the
  /// number a call sets it: request_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", self.request_.number);
  }

 private:
  void publish(CycleCaller caller);
  static constexpr std::uint32_t numbers_per_epoch = 4096;  // as those of AuxiliaryHandshake
  bool open_ = false, heard_ = false, called_ = false;
  CycleRequest request_;
  std::optional<CycleReply> answer_;
  std::optional<CycleRequest> outgoing_;
};

}  // namespace trunnion::channel
