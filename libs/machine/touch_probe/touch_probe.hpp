// SPDX-License-Identifier: Apache-2.0
// A touch-trigger probe in the spindle, whose ball is the tip of the tool, among solids on the workpiece
// side.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/random_source.hpp"
#include "touch_probe/solid.hpp"

namespace trunnion::touch_probe {

struct TouchProbeTruth {
  double ball_radius = 3;    ///< mm
  double length = 100;       ///< mm from the spindle face to the centre of the ball
  double pre_travel = 0;     ///< mm that the ball is pressed against the surface when the contact opens
  double lobing = 0;         ///< mm: amplitude by which the pre-travel changes three times around the probe
  double lobing_phase = 0;   ///< deg: direction of the largest pre-travel from the probe's +X
  double repeatability = 0;  ///< mm: standard deviation of the pre-travel
  double delay = 0;          ///< s from the contact's opening to its edge
  std::uint64_t seed = 1;
  /// Number of the touch (from 1) from which on the contact gives no signal, as with a broken wire; 0: none.
  std::uint32_t no_signal_from = 0;
  double early = 0;  ///< mm before the surface at which the edge comes, in place of the pre-travel ...
  std::uint32_t early_from = 1;  ///< ... from this touch on
  /// Number of the touch from which on the contact does not close again; 0: none.
  std::uint32_t stuck_from = 0;
};

/// Pre-travel for a surface whose outward normal is `normal` in the frame of the probe, without the noise,
/// mm. The lobes of the three contacts act across the probe: along its axis (Z) there are none.
double pre_travel(const TouchProbeTruth& probe, const Vec3& normal);

/// Where the probe is, in the frame of the solids: its ball, and the unit vectors along its X and Z.
struct ProbePose {
  Vec3 ball = Vec3::Zero();
  Vec3 across = Vec3::UnitX(), axis = Vec3::UnitZ();
};

/// What a probe keeps while nothing reads its signal: where its random numbers are, and its touches so far.
struct TouchMemory {
  std::uint64_t random = 0;
  double noise = 0;  ///< mm, of the next touch
  std::uint64_t touches = 0;
};

/// The contact of the probe, followed from motion to motion. The solids are rigid, so the depth of the ball
/// in them is its deflection. The contact opens when the depth reaches the pre-travel and closes when the
/// ball is `reseat` off the surface; every touch draws one random number.
class TouchProbe {
 public:
  static constexpr double reseat = 1e-3;  ///< mm

  TouchProbe(const TouchProbeTruth& truth, std::vector<Solid> solids);

  /// Is there, at rest. A contact that is open there has come before.
  void place(const ProbePose& pose);
  /// Moves evenly from where it was to `pose` in `duration` s (above zero), turned as in `pose`. The share of
  /// the motion after which the edge comes, above 0 and up to 1; nothing when it does not come in this
  /// motion. No allocation.
  std::optional<double> move(const ProbePose& pose, double duration);
  /// The signal: on from the edge until the contact closes.
  bool signal() const { return signal_; }
  TouchMemory memory() const { return {random_.state(), noise_, touches_}; }
  void restore(const TouchMemory& memory) {
    random_ = geometry::RandomSource(memory.random);
    noise_ = memory.noise, touches_ = static_cast<std::uint32_t>(memory.touches);
  }
  /// Switched off, the probe gives no signal.
  void switch_off() { open_ = waiting_ = signal_ = false; }

  /// No fields, the constructor sets them: truth_, solids_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("random", self.random_), visit("noise", self.noise_), visit("ball", self.ball_);
    visit("margin", self.margin_), visit("open", self.open_), visit("waiting", self.waiting_);
    visit("remaining", self.remaining_), visit("signal", self.signal_), visit("touches", self.touches_);
  }

 private:
  bool early(std::uint32_t touch) const { return truth_.early > 0 && touch >= truth_.early_from; }
  bool stuck() const { return truth_.stuck_from > 0 && touches_ >= truth_.stuck_from; }
  double distance(const Vec3& ball, const Solid*& nearest) const;
  double margin(const Vec3& ball, const ProbePose& pose) const;
  double contact_share(const Vec3& from, const ProbePose& pose) const;
  void draw();

  TouchProbeTruth truth_;
  std::vector<Solid> solids_;
  geometry::RandomSource random_;
  double noise_ = 0;              // mm, of the next touch
  std::array<double, 3> ball_{};  // mm, where the newest motion has ended
  double margin_ = 0;             // mm there until the contact opens
  bool open_ = false;             // the contact
  bool waiting_ = false;          // its edge comes after `remaining_`
  double remaining_ = 0;          // s
  bool signal_ = false;
  std::uint32_t touches_ = 0;
};

}  // namespace trunnion::touch_probe
