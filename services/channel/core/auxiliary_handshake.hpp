// SPDX-License-Identifier: Apache-2.0
// What a program asks of the PLC while the axes are at rest: M S T, orders for spindles and signals (E).
#pragma once

#include <optional>
#include <string>

#include "contracts/types.hpp"
#include "program_execution/auxiliary_memory.hpp"

namespace trunnion::channel {

/// One request is open at a time. The PLC answers by number; its strobe falls when the function is done or
/// cancelled.
class AuxiliaryHandshake {
 public:
  enum class Outcome : std::uint8_t { not_open, done, failed };

  explicit AuxiliaryHandshake(std::uint16_t channel) : channel_(channel) {}

  /// Numbers continue behind those that a process before this one has used up to `epoch` of the stream.
  void continue_numbers(std::uint32_t epoch) { number_ = (epoch + 1) * numbers_per_epoch; }

  /// Raises the strobe. The axes have been at rest since `cycle`.
  void begin(const program_execution::AuxiliaryFunction& function, std::uint64_t cycle);
  /// The open function as a program writes it ("M6"), empty when none is.
  std::string function() const;
  /// What a failure of the open function means and what to do, for the operator.
  std::string refusal() const;
  /// The PLC's answer. Only the open function's number counts.
  Outcome finish(const idl::plc::AuxiliaryDone& done);

  /// Gives up what is open.
  void cancel();

  /// Nothing is open and everything has been taken: the state that fields() lists is whole.
  bool at_rest() const { return !open_ && !outgoing_; }
  /// No field, the constructor sets it: channel_. No fields, at rest nothing is open: open_, request_,
  /// outgoing_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", self.number_);
  }

  std::optional<idl::channel::AuxiliaryRequest> take_request();

 private:
  // A restarted process counts on from the next epoch: fewer functions than this fall into one.
  static constexpr std::uint32_t numbers_per_epoch = 4096;
  void lower_strobe();
  bool is_signal() const;

  std::uint16_t channel_;
  std::uint32_t number_ = 0;
  bool open_ = false;
  idl::channel::AuxiliaryRequest request_;
  std::optional<idl::channel::AuxiliaryRequest> outgoing_;
};

}  // namespace trunnion::channel
