// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/macro_settings.hpp"

#include <fmt/core.h>

#include <array>
#include <stdexcept>

#include "language/codes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::channel_setup {
namespace {

constexpr int macro_call = 65, macro_cancel = 67;  // G65 .. G67

/// A code that calls, by its kind; whoever calls programs by itself, or ends them, cannot be replaced.
bool calls_already(char letter, int code) {
  if (letter == 'G') return code >= macro_call && code <= macro_cancel;
  return language::m_code(static_cast<std::uint16_t>(code)).group == language::MGroup::flow;
}

template <std::size_t Count>
void read(const machine::Parameters& p, const machine::IntegerParameter& parameter, std::uint32_t channel,
          char letter, std::array<std::uint16_t, Count>& codes) {
  for (std::uint32_t i = 0; i < Count; ++i) {
    const int code = p.integer(parameter, channel, i);
    if (code != 0 && calls_already(letter, code))
      throw std::runtime_error(
          fmt::format("parameter {} ({}): {}{} belongs to the control and calls no other program",
                      machine::number_text(parameter.number(channel, i)), parameter.name, letter, code));
    codes[i] = static_cast<std::uint16_t>(code);
  }
}

}  // namespace

MacroSettings macro_settings(const machine::Parameters& p, std::uint32_t channel) {
  MacroSettings settings;
  read(p, parameter::macro_g_code, channel, 'G', settings.calls.g);
  read(p, parameter::macro_m_code, channel, 'M', settings.calls.m);
  read(p, parameter::subprogram_m_code, channel, 'M', settings.calls.m_subprograms);
  settings.calls.t = p.integer(parameter::subprogram_t, channel) != 0;
  settings.calls.s = p.integer(parameter::subprogram_s, channel) != 0;
  settings.prints_blanks = p.integer(parameter::print_blanks, channel) != 0;
  settings.offsets_by_axis = p.integer(parameter::offsets_by_axis, channel) != 0;
  return settings;
}

}  // namespace trunnion::channel_setup
