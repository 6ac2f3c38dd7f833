// SPDX-License-Identifier: Apache-2.0
#include "auxiliary_handshake.hpp"

#include <cmath>
#include <utility>

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
  const auto number = request_.kind == AuxiliaryKind::S
                          ? static_cast<std::uint32_t>(std::lround(request_.value))
                          : request_.code;
  return bus::to_string(request_.kind) + std::to_string(number);
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
