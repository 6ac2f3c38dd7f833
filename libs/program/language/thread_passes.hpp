// SPDX-License-Identifier: Apache-2.0
// Threading in passes on a lathe (G76 of LinuxCNC): how deep each pass goes and where it begins and ends.
#pragma once

#include <cstdint>

namespace trunnion::language {

/// Pass n cuts to first * n^(1 / degression) below the peak, the last ones to the full height. With a slide
/// angle each pass begins and ends the farther along Z, the deeper it is.
class ThreadPasses {
 public:
  static constexpr double most_passes = 9999;

  /// mm; X is a radius.
  struct Words {
    double pitch = 0;  ///< per revolution, along Z
    double start_x = 0, start_z = 0;
    double end_z = 0;
    double peak = 0;    ///< from the start to the crest, positive: inside thread
    double first = 0;   ///< depth of the first pass, > 0
    double height = 0;  ///< of the thread, > first
    double degression = 1;
    double angle = 0;           ///< degrees, of the slide
    std::uint32_t springs = 0;  ///< passes at the full height besides the first of them
    double taper = 0;           ///< along Z
    bool taper_in = false, taper_out = false;
  };

  /// What a pass does, program coordinates. Where it is not tapered `in` and `out` are at the bottom.
  struct Pass {
    double away_x = 0;  ///< clear of the thread
    double begin_z = 0, end_z = 0;
    double begin_x = 0, end_x = 0;  ///< of its thread with the tapers
    double bottom_x = 0;
    double bottom_from_z = 0, bottom_to_z = 0;
    bool tapered_in = false, tapered_out = false;
  };

  /// How many passes come before the full height; more than most_passes is too many.
  static double passes_before_full(const Words& words);

  void start(const Words& words);
  /// False behind the last pass.
  bool next(Pass& pass);
  const Words& words() const { return w_; }

 private:
  Words w_;
  double count_ = 0;
  std::uint32_t springs_left_ = 0;
  bool done_ = true;
};

}  // namespace trunnion::language
