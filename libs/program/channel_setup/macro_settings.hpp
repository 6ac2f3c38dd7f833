// SPDX-License-Identifier: Apache-2.0
// What the parameters of a channel say of macros.
#pragma once

#include <cstdint>

#include "language/environment.hpp"
#include "machine/parameters.hpp"

namespace trunnion::channel_setup {

struct MacroSettings {
  language::CodeCalls calls;
  bool prints_blanks = true;
  bool offsets_by_axis = false;
};

/// Throws std::runtime_error that names the parameter of a code that cannot call a program.
MacroSettings macro_settings(const machine::Parameters& parameters, std::uint32_t channel);

}  // namespace trunnion::channel_setup
