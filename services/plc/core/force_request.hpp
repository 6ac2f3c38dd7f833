// SPDX-License-Identifier: Apache-2.0
// Requests that force and release values.
#pragma once

#include <string>

#include "plc_core.hpp"

namespace trunnion::plc {

/// FORCE and RELEASE, all of it or nothing. Returns an empty text, or in one line why it is refused: the path
/// and what is expected.
std::string change_forces(const idl::plc::OnlineRequest& request, const st::Variables& variables,
                          PlcCore& core);
/// What is forced, with paths of these programs; registers by their address.
idl::plc::Forces forces_of(const Memory& memory, const st::Variables& variables);

}  // namespace trunnion::plc
