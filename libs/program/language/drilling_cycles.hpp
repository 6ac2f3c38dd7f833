// SPDX-License-Identifier: Apache-2.0
// Canned cycles (G73 .. G89) and hole patterns (G70, G71, G78, G79).
#pragma once

#include "language/block_context.hpp"
#include "language/hole_cycle.hpp"
#include "language/hole_pattern.hpp"

namespace trunnion::language {

class DrillingCycles : private BlockHandler {
 public:
  explicit DrillingCycles(BlockContext& context) : BlockHandler(context) {}

  /// No hole is left to do.
  void reset();

  /// A block while a cycle is modal: its words, and the holes of its position.
  Fault run();
  Fault drill_circle(std::uint16_t at);  ///< G70
  Fault drill_arc(std::uint16_t at);     ///< G71
  Fault drill_line(std::uint16_t at);    ///< G78
  Fault drill_grid(std::uint16_t at);    ///< G79

  /// Holes of the words in ProgramSettings::cycle, the first at `first` in the plane, each `step` on from the
  /// one before.
  Fault drill(HolePattern::Point first, HolePattern::Point step, std::uint32_t count) {
    pattern_.line(first, step, count);
    return begin_holes();
  }

  /// Tapping has stopped the spindle. When another code has ended the cycle it turns again as before, unless
  /// the program has commanded it otherwise meanwhile.
  void restart_spindle();
  /// Steps until one of them makes a command, or all holes are done.
  Fault next_step();

 private:
  /// The words all patterns have.
  struct Pattern {
    HolePattern::Point point{};
    double i = 0;  // mm
    double j = 0;  // as written
    std::uint32_t count = 0;
    bool clockwise = false;
  };
  Fault read_cycle_words();
  Fault read_settings(CycleWords& words);
  Fault read_tapping_axis(CycleWords& words);
  /// I J K of pecks, and J of tapping, as Haas has them (haas_cycles.cpp).
  Fault read_haas_words(CycleWords& words);
  Fault read_haas_pecks(CycleWords& words);
  /// The spindle reaches the speed at which a tap comes out.
  Fault check_retract();
  /// 1/min of it; 0 = S.
  double retract_speed() const;
  Fault read_repeats(std::uint32_t& repeats);
  Fault place_holes(std::uint16_t at, std::uint32_t axes, std::uint32_t repeats, AxisValues& target);
  Fault check_cycle(std::uint16_t at) const;
  Fault check_pecks(std::uint16_t at) const;
  Fault check_levels(std::uint16_t at) const;
  Fault read_pattern(std::uint16_t at, bool may_turn, Pattern& pattern);
  Fault begin_holes();
  Fault step(const HoleStep& step);
  Fault rapid_to(const AxisValues& target) { return output_.move_straight({CommandKind::rapid}, target); }

  HolePattern pattern_;
  HoleCycle hole_;
  HolePattern::Point place_{};
  double lead_ = 0;  // mm, of tapping, positive right-hand
};

}  // namespace trunnion::language
