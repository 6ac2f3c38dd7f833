// SPDX-License-Identifier: Apache-2.0
// Orders (E): those for spindles, which the programs answer, and signals that programs of the channels set
// and read, which need no answer.
#include <algorithm>
#include <cmath>

#include "canonical/macro_signal.hpp"
#include "plc_core.hpp"

namespace trunnion::plc {

void PlcCore::begin_order(const Handshake& h, const ChannelSymbols& s) {
  auto& r = memory_.registers;
  if (!h.is_signal()) {
    const auto order = spindle_order(h.code, h.value);
    store(r, s.e_order, order.order);
    store(r, s.e_spindle, order.spindle);
    store(r, s.e_value, order.value);
  } else if (h.has_value != 0) {
    const auto word = static_cast<std::uint16_t>(plc::load(r, s.macro_output));
    const auto value = static_cast<std::int32_t>(std::lround(std::clamp(h.value, -32768.0, 65535.0)));
    store(r, s.macro_output, canonical::with_macro_output(word, h.code, value));
  }
}

// Programs without orders for spindles would never answer one, and signals that they do not use are nobody's.
// Otherwise a signal is there when the main task has run from its beginning to its end.
std::optional<bool> PlcCore::failure(const Handshake& h, const ChannelSymbols& s) const {
  const auto& r = memory_.registers;
  const auto& used = !h.is_signal()                      ? s.e_order
                     : canonical::is_macro_input(h.code) ? s.macro_input
                                                         : s.macro_output;
  if (h.kind == AuxiliaryKind::E && !structured_.uses(used.area, used.index)) return true;
  if (h.is_signal()) return continues_main() ? std::nullopt : std::optional(false);
  if (plc::load(r, s.fin) == 0) return std::nullopt;
  return plc::load(r, s.fin_failed) != 0;
}

void PlcCore::read_signal(Handshake& h, const ChannelSymbols& s) const {
  if (h.has_value != 0) return;
  const auto& word = canonical::is_macro_input(h.code) ? s.macro_input : s.macro_output;
  h.value = canonical::macro_value(h.code, static_cast<std::uint16_t>(plc::load(memory_.registers, word)));
}

std::optional<idl::plc::MacroSignal> PlcCore::signal_read(const idl::plc::AuxiliaryDone& done) const {
  const auto& h = memory_.handshakes[done.channel];
  if (done.failed || h.number != done.number || !h.is_signal() || h.has_value != 0) return std::nullopt;
  return idl::plc::MacroSignal{done.channel, done.number, static_cast<std::uint16_t>(h.value)};
}

}  // namespace trunnion::plc
