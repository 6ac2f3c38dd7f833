// SPDX-License-Identifier: Apache-2.0
// The macros that the control has without anybody storing them.
#pragma once

#include <string_view>

#include "language/text_source.hpp"

namespace trunnion::channel_setup {

/// The macro by its name: "O9960" is CYCLE9960 (docs/calibration.md), "O9801" the touches along a direction
/// (docs/calibration-programs.md), "O9810" .. "O9819" and "O90370" (G37) measure workpieces and tools
/// (docs/measuring-cycles.md), "O90120" (G12 and G13) and "O90150" mill pockets, "O90800" is CYCLE800
/// (docs/motion-language.md); null when the control has none of that name. ISO programs in every channel. A
/// stored program of the same name goes before it. Lives as long as the process, and may be read by any
/// thread.
language::TextSource* control_macro(std::string_view name);

}  // namespace trunnion::channel_setup
