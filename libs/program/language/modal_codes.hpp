// SPDX-License-Identifier: Apache-2.0
// Modal codes and words: units, feed, spindle, tool selection, plane, path control, polar coordinates,
// motion.
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class ModalCodes : private BlockHandler {
 public:
  explicit ModalCodes(BlockContext& context) : BlockHandler(context) {}

  Fault stop_exactly(std::uint16_t at);  ///< G9
  Fault set_units(std::uint16_t at, bool metric);
  Fault set_feed_mode(std::uint16_t at, FeedMode mode);
  Fault set_spindle_mode(std::uint16_t at, SpindleMode mode);
  Fault set_plane(std::uint16_t at, Plane plane);
  Fault set_distance(std::uint16_t at, bool absolute);
  Fault set_centres(std::uint16_t at, bool absolute);
  Fault set_return_level(std::uint16_t at, bool initial);
  Fault stop_at_every_end(std::uint16_t at);    ///< G61
  Fault set_accurate_path(std::uint16_t at);    ///< G61.1
  Fault follow_path(std::uint16_t at);          ///< G62, G63
  Fault set_continuous_path(std::uint16_t at);  ///< G64
  Fault set_polar(std::uint16_t at, bool on);
  Fault set_contour_control(std::uint16_t at);  ///< G5
  Fault set_smoothing(std::uint16_t at);        ///< G5.1
  Fault set_look_ahead(std::uint16_t at);       ///< G8
  Fault set_finish(std::uint16_t at);           ///< G187
  Fault pass_condition(std::uint16_t at);       ///< G120.1
  Fault set_motion(std::uint16_t at, std::uint8_t motion);
  Fault set_cycle(std::uint16_t at, std::uint8_t cycle);

  /// The words F, S and T, each behind the codes it depends on.
  Fault feed_word();
  Fault spindle_word();
  Fault tool_word();
  /// Behind M6: the second of two T words, when it is for the next change.
  Fault ready_tool();

 private:
  /// T of `word`.
  Fault select_tool(char word);
  void set_path_control(PathControl control, bool accurate);
  void set_mode(std::uint8_t mode);
  Fault take_named_axes();
  Fault check_spindle_speed(double speed);
  /// The block has the lead of a thread, if it has its word.
  bool takes_lead() const;
  /// The block has G84 or G84.9.
  bool taps() const;
  /// 1/min, of the spindle with the surface speed of a state that has one, at the position.
  double reached_speed(const ModalState& surface) const;
  /// 1/min, of the program and the machine with G96; 0 = none.
  double speed_limit(const ModalState& modal) const;
};

}  // namespace trunnion::language
