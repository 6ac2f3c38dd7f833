// SPDX-License-Identifier: Apache-2.0
#include "auxiliary_handshake.hpp"

#include <cmath>
#include <utility>

#include "canonical/macro_signal.hpp"
#include "canonical/spindle_value.hpp"

namespace trunnion::channel {

void AuxiliaryHandshake::begin(const program_execution::AuxiliaryFunction& function, std::uint64_t cycle) {
  request_ = {channel_,           ++number_, function.kind,    function.code,  function.value,
              function.has_value, cycle,     function.surface, function.limit, function.radius};
  outgoing_ = request_;
  open_ = true;
}

std::string AuxiliaryHandshake::function() const {
  if (!open_) return {};
  using program_execution::AuxiliaryKind;
  if (request_.kind == AuxiliaryKind::E && request_.code == canonical::order_angle) return "EC";
  if (is_signal()) return std::string("#").append(std::to_string(request_.code));
  const auto number = request_.kind == AuxiliaryKind::S
                          ? static_cast<std::uint32_t>(std::lround(request_.value))
                          : request_.code;
  return bus::to_string(request_.kind) + std::to_string(number);
}

std::string AuxiliaryHandshake::refusal() const {
  std::string text = "the PLC did not carry out ";
  text += function();
  if (!is_signal()) return text += ". Check the machine, then reset";
  text += ": its programs do not use the register ";
  text += canonical::is_macro_input(request_.code) ? "macro_input_" : "macro_output_";
  text += std::to_string(channel_);
  return text += ". Correct the program or the PLC, then reset";
}

bool AuxiliaryHandshake::is_signal() const {
  return request_.kind == program_execution::AuxiliaryKind::E && canonical::is_macro_signal(request_.code);
}

AuxiliaryHandshake::Outcome AuxiliaryHandshake::finish(const idl::plc::AuxiliaryDone& done) {
  if (!open_ || done.number != request_.number) return Outcome::not_open;
  lower_strobe();
  return done.failed ? Outcome::failed : Outcome::done;
}

void AuxiliaryHandshake::lower_strobe() {
  open_ = false;
  request_.kind = program_execution::AuxiliaryKind::NO_AUXILIARY;
  outgoing_ = request_;
}

void AuxiliaryHandshake::cancel() {
  if (open_) lower_strobe();
}

std::optional<idl::channel::AuxiliaryRequest> AuxiliaryHandshake::take_request() {
  return std::exchange(outgoing_, std::nullopt);
}

}  // namespace trunnion::channel
