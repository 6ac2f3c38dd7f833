// SPDX-License-Identifier: Apache-2.0
// The handlers, one for each concern of a block.
#pragma once

#include "language/curve_motion.hpp"
#include "language/drilling_cycles.hpp"
#include "language/frame_codes.hpp"
#include "language/line_tapping.hpp"
#include "language/linuxcnc_curves.hpp"
#include "language/linuxcnc_cycles.hpp"
#include "language/linuxcnc_frames.hpp"
#include "language/linuxcnc_modal_state.hpp"
#include "language/linuxcnc_modes.hpp"
#include "language/linuxcnc_motion.hpp"
#include "language/linuxcnc_threads.hpp"
#include "language/linuxcnc_tools.hpp"
#include "language/modal_codes.hpp"
#include "language/num_tapping.hpp"
#include "language/path_motion.hpp"
#include "language/positioning.hpp"
#include "language/table_codes.hpp"
#include "language/tap_removal.hpp"
#include "language/tilted_planes.hpp"
#include "language/tool_codes.hpp"
#include "language/tool_vector_motion.hpp"

namespace trunnion::language {

struct BlockHandlers {
  explicit BlockHandlers(BlockContext& context)
      : modal(context),
        tool(context),
        frames(context),
        planes(context),
        tables(context),
        positioning(context),
        vectors(context),
        motion(context, vectors),
        curve(context),
        cycles(context),
        num_tapping(context),
        tap_removal(context),
        line_tapping(context),
        linuxcnc_modes(context),
        linuxcnc_frames(context, frames, tables),
        linuxcnc_tools(context, tool, tables, linuxcnc_frames),
        linuxcnc_cycles(context, cycles),
        linuxcnc_modal_state(context, modal, tool, linuxcnc_frames),
        linuxcnc_threads(context, motion),
        linuxcnc_curves(context),
        linuxcnc_motion(context, motion, positioning, linuxcnc_cycles, linuxcnc_threads, linuxcnc_curves) {}

  ModalCodes modal;
  ToolCodes tool;
  FrameCodes frames;
  TiltedPlanes planes;
  TableCodes tables;
  Positioning positioning;
  ToolVectorMotion vectors;
  PathMotion motion;
  CurveMotion curve;
  DrillingCycles cycles;
  NumTapping num_tapping;
  TapRemoval tap_removal;
  LineTapping line_tapping;
  LinuxcncModes linuxcnc_modes;
  LinuxcncFrames linuxcnc_frames;
  LinuxcncTools linuxcnc_tools;
  LinuxcncCycles linuxcnc_cycles;
  LinuxcncModalState linuxcnc_modal_state;
  LinuxcncThreads linuxcnc_threads;
  LinuxcncCurves linuxcnc_curves;
  LinuxcncMotion linuxcnc_motion;
};

}  // namespace trunnion::language
