// SPDX-License-Identifier: Apache-2.0
#include "modal_codes.hpp"

namespace trunnion::channel {

std::vector<std::string> modal_codes(const language::ModalState& m) {
  using namespace language;
  const auto code = [](int number) { return "G" + std::to_string(number); };
  std::vector<std::string> codes{
      m.cycle != 80    ? code(m.cycle)
      : m.motion == 62 ? std::string("G6.2")
                       : code(m.motion),
      m.plane == Plane::xy   ? "G17"
      : m.plane == Plane::zx ? "G18"
                             : "G19",
      m.metric ? "G21" : "G20",
      m.absolute ? "G90" : "G91",
      m.feed_mode == FeedMode::per_minute     ? "G94"
      : m.feed_mode == FeedMode::inverse_time ? "G93"
                                              : "G95",
      m.path_control == PathControl::exact_stop ? "G61" : "G64",
      m.work_offset < 6 ? code(54 + m.work_offset) : "G54.1 P" + std::to_string(m.work_offset - 5),
      m.cutter_side == CutterSide::left    ? "G41"
      : m.cutter_side == CutterSide::right ? "G42"
                                           : "G40",
      m.tip_control()        ? (m.tool_vector ? "G43.5" : "G43.4")
      : m.length_offset == 0 ? "G49"
      : m.tool_length < 0    ? "G44"
                             : "G43",
      m.spindle_mode == SpindleMode::surface ? "G96" : "G97",
      m.return_to_initial ? "G98" : "G99"};
  if (m.tilt.active) codes.emplace_back("G68.2");
  if (m.rotated && !m.tilt.active) codes.emplace_back("G68");
  if (m.scaled) codes.emplace_back("G51");
  if (m.mirrored) codes.emplace_back("G51.1");
  if (m.polar) codes.emplace_back("G16");
  if (m.absolute_centres) codes.emplace_back("G90.1");
  if (m.smoothing != 0) codes.push_back("G5.1 Q" + std::to_string(m.smoothing));
  return codes;
}

}  // namespace trunnion::channel
