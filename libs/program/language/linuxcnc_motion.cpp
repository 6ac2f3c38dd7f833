// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_motion.hpp"

namespace trunnion::language {

void LinuxcncMotion::note_codes() {
  const GCodes& g = words_.g();
  if (g.is(Group::cycle, 800)) state_.motion_off = true;
  if (g.has(Group::motion) || (g.has(Group::cycle) && !g.is(Group::cycle, 800))) state_.motion_off = false;
}

Fault LinuxcncMotion::move() {
  const ModalState& modal = state_.modal;
  const GCodes& g = words_.g();
  const bool axes = (words_.letters() & axis_bits) != 0;
  // G43.1 and G43.2 have taken them.
  if (axes && g.has(Group::tool_length) && g.code(Group::tool_length).axis_words != AxisWords::move)
    return g.has(Group::motion) ? Fault{AlarmNumber::codes_compete, g.offset(Group::motion)} : Fault{};
  if (state_.motion_off)
    return axes ? Fault{AlarmNumber::linuxcnc_axis_words, words_.offset_of_any(axis_bits)} : Fault{};
  return modal.cycle != 80 ? cycles_.run() : motion_.move();
}

}  // namespace trunnion::language
