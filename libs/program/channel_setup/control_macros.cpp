// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/control_macros.hpp"

#include <array>
#include <utility>

namespace trunnion::channel_setup {

// Of the files of libs/program/channel_setup/macros and of examples/calibration/programs, by the build.
extern const char *const macro_O9801,
    *const macro_O9810, *const macro_O9811, *const macro_O9812,
                                                *const macro_O9813,
                                                    *const macro_O9814,
                                                        *const macro_O9815,
                                                            *const macro_O9816,
                                                                *const macro_O9817,
                                                                    *const macro_O9818,
                                                                        *const macro_O9819,
                                                                            *const macro_O9960;

language::TextSource* control_macro(std::string_view name) {
  using Macro = std::pair<std::string_view, language::StringSource>;
  static std::array macros{
      Macro{"O9801", macro_O9801}, Macro{"O9810", macro_O9810}, Macro{"O9811", macro_O9811},
      Macro{"O9812", macro_O9812}, Macro{"O9813", macro_O9813}, Macro{"O9814", macro_O9814},
      Macro{"O9815", macro_O9815}, Macro{"O9816", macro_O9816}, Macro{"O9817", macro_O9817},
      Macro{"O9818", macro_O9818}, Macro{"O9819", macro_O9819}, Macro{"O9960", macro_O9960}};
  for (auto& [own, text] : macros)
    if (own == name) return &text;
  return nullptr;
}

}  // namespace trunnion::channel_setup
