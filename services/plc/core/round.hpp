// SPDX-License-Identifier: Apache-2.0
// One round of a running PLC for the standby comparison (idl/plc.idl): what of it is computed here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "address.hpp"
#include "bus/cdr.hpp"
#include "contracts/types.hpp"

namespace trunnion::plc {

using idl::plc::RegisterValue;
using idl::plc::Round;
using idl::plc::Step;
using idl::plc::StepKind;

using Changes = std::vector<RegisterValue>;

/// Registers of `after` that differ from `before`, area by area.
Changes changes(const Registers& before, const Registers& after);
/// R12, B7.
std::string register_name(const RegisterValue& value);
/// A number that differs when any variable, handshake or time differs.
std::uint64_t state_digest(const PlcState& state);
/// Identifies the layout of a state's bytes.
inline constexpr std::uint64_t state_layout = (std::uint64_t{1} << 32) | sizeof(PlcState);

}  // namespace trunnion::plc
