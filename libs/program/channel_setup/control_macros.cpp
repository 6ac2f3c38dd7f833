// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/control_macros.hpp"

#include <array>

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
  const auto macro = [](std::string_view own, const char* text) {
    return language::StringSource(text, own, language::ProgramDialect::iso);
  };
  static std::array macros{
      macro("O9801", macro_O9801),   macro("O9810", macro_O9810),   macro("O9811", macro_O9811),
      macro("O9812", macro_O9812),   macro("O9813", macro_O9813),   macro("O9814", macro_O9814),
      macro("O9815", macro_O9815),   macro("O9816", macro_O9816),   macro("O9817", macro_O9817),
      macro("O9818", macro_O9818),   macro("O9819", macro_O9819),   macro("O9960", macro_O9960),
      macro("O90120", macro_O90120), macro("O90150", macro_O90150), macro("O90370", macro_O90370),
      macro("O90800", macro_O90800)};
  for (auto& text : macros)
    if (text.name() == name) return &text;
  return nullptr;
}

}  // namespace trunnion::channel_setup
