// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/control_macros.hpp"

#include <array>
#include <utility>

namespace trunnion::channel_setup {

// Of the files of libs/program/channel_setup/macros and of examples/calibration/programs, by the build.
extern const char* const macro_O9801;
extern const char* const macro_O9810;
extern const char* const macro_O9811;
extern const char* const macro_O9812;
extern const char* const macro_O9813;
extern const char* const macro_O9814;
extern const char* const macro_O9815;
extern const char* const macro_O9816;
extern const char* const macro_O9817;
extern const char* const macro_O9818;
extern const char* const macro_O9819;
extern const char* const macro_O9960;
extern const char* const macro_O90120;
extern const char* const macro_O90150;
extern const char* const macro_O90370;
extern const char* const macro_O90800;

language::TextSource* control_macro(std::string_view name) {
  using Macro = std::pair<std::string_view, language::StringSource>;
  static std::array macros{
      Macro{"O9801", macro_O9801},   Macro{"O9810", macro_O9810},   Macro{"O9811", macro_O9811},
      Macro{"O9812", macro_O9812},   Macro{"O9813", macro_O9813},   Macro{"O9814", macro_O9814},
      Macro{"O9815", macro_O9815},   Macro{"O9816", macro_O9816},   Macro{"O9817", macro_O9817},
      Macro{"O9818", macro_O9818},   Macro{"O9819", macro_O9819},   Macro{"O9960", macro_O9960},
      Macro{"O90120", macro_O90120}, Macro{"O90150", macro_O90150}, Macro{"O90370", macro_O90370},
      Macro{"O90800", macro_O90800}};
  for (auto& [own, text] : macros)
    if (own == name) return &text;
  return nullptr;
}

}  // namespace trunnion::channel_setup
