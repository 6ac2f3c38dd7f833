// SPDX-License-Identifier: Apache-2.0
// What one hole of a canned cycle is made of.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::language {

/// G74, G84: Q pecks, J the axis.
constexpr bool is_tapping(std::uint8_t cycle) { return cycle == 74 || cycle == 84; }
/// G73, G83: Q pecks.
constexpr bool is_pecking(std::uint8_t cycle) { return cycle == 73 || cycle == 83; }
/// G76, G87: Q or I J K the shift.
constexpr bool is_shifting(std::uint8_t cycle) { return cycle == 76 || cycle == 87; }

/// One step at a hole. Levels are program coordinates of the axis across the plane, mm.
struct HoleStep {
  enum class Kind : std::uint8_t {
    rapid,      ///< to level
    feed,       ///< to level at the programmed feed
    tap,        ///< to level, coupled to the spindle; number 1: out of the hole behind the last depth
    shift,      ///< in the plane, rapid, to the hole + the cycle's shift
    unshift,    ///< back to the hole
    dwell,      ///< value seconds
    auxiliary,  ///< M code `number`
  };
  Kind kind = Kind::rapid;
  double value = 0;  ///< level or seconds
  std::uint32_t number = 0;
};

/// The words of a cycle, resolved.
struct HoleParameters {
  std::uint8_t cycle = 81;  ///< 73, 74, 76, 81..89
  double initial = 0;       ///< level the cycle was called at
  double r = 0;             ///< level where feed begins
  double z = 0;             ///< level of the bottom; of G87 the end of the bore
  bool return_to_initial = true;
  double peck = 0;            ///< mm, > 0; 0 without pecks
  double dwell = 0;           ///< seconds
  double retract = 0;         ///< mm, between pecks of G73 and tapping
  double clearance = 0;       ///< mm above the last depth (G83)
  double reduction = 0;       ///< mm that each peck is smaller than the one before (Haas J)
  double least_peck = 0;      ///< mm, of pecks that get smaller
  double between_outs = 0;    ///< mm of G73 behind which the tool goes out to R (Haas K); 0 = it does not
  std::uint32_t restart = 3;  ///< M code that starts the spindle again: 3 or 4
  bool linuxcnc = false;      ///< G89 goes out at feed all the way, tapping dwells at the bottom only
};

/// Gives the steps of a hole one after the other, the tool being above it. Allocates nothing, however many
/// pecks there are.
class HoleCycle {
 public:
  void start(const HoleParameters& parameters);
  /// False behind the last step.
  bool next(HoleStep& step);
  void stop() { next_ = count_ = 0, pecking_ = false; }

 private:
  using Kind = HoleStep::Kind;
  void add(Kind kind, double value = 0, std::uint32_t number = 0) {
    steps_[count_++] = {kind, value, number};
  }
  void add_dwell();
  void add_whole_hole();
  void add_peck();
  void add_return();

  HoleParameters p_;
  std::array<HoleStep, 16> steps_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  bool pecking_ = false;  // more depth is to come when the steps run out
  double depth_ = 0;      // level reached by the last peck
  double peck_ = 0;       // mm, of the next one
  double since_out_ = 0;  // mm drilled since the tool was at R
  bool out_ = true;       // it is there
};

}  // namespace trunnion::language
