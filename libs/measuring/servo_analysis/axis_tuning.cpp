// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/axis_tuning.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "servo_analysis/friction.hpp"

namespace trunnion::servo_analysis {
namespace {

constexpr double first_gain = 20, first_speed_gain = 200;  // PA0 = PA2 = 200 of the manual, 1/s
constexpr double kept = 0.8;                               // of a critical gain
constexpr double coarse = 1.25, fine = 1.05;               // factors between two trials
constexpr double highest_speed_gain = 4000, highest_position_gain = 400;  // 1/s, for the inertia of the axis
constexpr int most_corrections = 25;

// Long enough for 0.25 s at constant speed where the travel permits.
TestMotion stroke_at(const TuningTask& task, double feed, int strokes = 2) {
  const double v = std::min(feed, task.highest_feed) / per_minute;
  const double wanted = v * 0.3 + v * v / task.acceleration + v * 0.1;
  return {v * per_minute, std::clamp(wanted, 0.5, task.travel), strokes};
}

// The acceleration at the reversal of a circle of 100 mm at 1000 mm/min, on the largest circle the travel
// permits.
TestMotion circle(const TuningTask& task) {
  TestMotion motion;
  motion.radius = std::min(100.0, task.travel / 2);
  motion.feed = 1000 * std::sqrt(motion.radius / 100);
  return motion;
}

constexpr double reversal_window = 0.4;  // s

class Tuning {
 public:
  Tuning(AxisUnderTest& axis, const TuningTask& task) : axis_(axis), task_(task) {}

  TuningResult run() {
    begin();
    identify();
    raise_speed_gain();
    raise_position_gain();
    fine_feed_forward();
    reach_limits();
    return result_;
  }

 private:
  template <class... Values>
  void say(fmt::format_string<Values...> format, Values&&... values) {
    if (task_.progress) task_.progress(fmt::format(format, std::forward<Values>(values)...));
  }

  MotionResult move(const ServoSettings& trial, const TestMotion& motion) {
    auto result = axis_.move(trial, safe_, task_.amplitude, motion);
    ++result_.motions;
    result_.largest_vibration = std::max(result_.largest_vibration, result.amplitude);
    return result;
  }

  // The integral time is ten time constants of the speed loop, 4 ms at least.
  void set_speed_gain(ServoSettings& s, double gain) const {
    s.speed_gain = gain;
    s.speed_integral_time = std::clamp(1e4 * result_.inertia / gain, 4.0, 200.0);
  }

  // The least gains, at which every axis is expected to be still.
  void begin() {
    safe_ = ServoSettings{};
    safe_.notch_frequency = task_.current.notch_frequency, safe_.notch_width = task_.current.notch_width;
    safe_.position_gain = first_gain, safe_.speed_integral_time = 200;
    for (double gain = first_speed_gain; gain >= 20; gain /= 2) {
      safe_.speed_gain = gain, safe_.position_gain = std::min(first_gain, gain / 10);
      say("start with position gain {:g} and speed gain {:g} 1/s", safe_.position_gain, gain);
      first_ = move(safe_, stroke_at(task_, 3000, 4));
      if (!first_.vibration) return;
    }
    throw std::runtime_error(
        "the axis vibrates with the least gains (position gain 2, speed gain 20 1/s): look for a fault of "
        "its "
        "mechanics or its encoders");
  }

  void identify() {
    result_.inertia = identify_inertia(first_.trace) * task_.rated_acceleration;
    const auto slow = move(safe_, stroke_at(task_, 600, 4));
    auto points = friction_points(first_.trace);
    for (const auto& p : friction_points(slow.trace)) points.push_back(p);
    result_.coulomb = std::max(0.0, identify_friction(points).coulomb);
    say("inertia {:.2f} of the nominal one, Coulomb friction {:.3f} of the rated torque", result_.inertia,
        result_.coulomb);
    safe_.acceleration_feedforward = std::clamp(result_.inertia, 0.0, 11.0);
    set_speed_gain(safe_, std::max(safe_.speed_gain, 4 * safe_.position_gain * result_.inertia));
    result_.settings = safe_;
  }

  // Raises a gain until the axis vibrates, in coarse and then in fine steps; the critical gain, or 0 where it
  // does not vibrate up to `highest`. `set` gives the settings with a gain.
  template <class Set>
  double critical(const char* name, double from, double highest, const Set& set) {
    double good = from, step = coarse;
    while (true) {
      const double gain = std::min(good * step, highest);
      const auto result = move(set(gain), stroke_at(task_, 1000));
      say("{} {:.4g} 1/s: {}", name, gain, result.vibration ? "vibration" : "still");
      if (!result.vibration) {
        good = gain;
        if (gain >= highest) return 0;
        continue;
      }
      if (step <= fine) return gain;
      step = fine;
    }
  }

  void raise_speed_gain() {
    const auto with = [&](double gain) {
      auto s = result_.settings;
      set_speed_gain(s, gain);
      return s;
    };
    // Speed gain and time constant of the current loop are then equal: a phase margin of 52 deg is left.
    const double fastest = std::min(highest_speed_gain, 1e3 / task_.current_time_constant);
    const double highest = std::clamp(fastest * result_.inertia, safe_.speed_gain, 1e4);
    result_.critical_speed_gain = critical("speed gain", safe_.speed_gain, highest, with);
    const double found = result_.critical_speed_gain > 0 ? result_.critical_speed_gain : highest;
    result_.settings = with(kept * found);
  }

  void raise_position_gain() {
    const auto with = [&](double gain) {
      auto s = result_.settings;
      s.position_gain = gain;
      return s;
    };
    // A quarter of the bandwidth of the speed loop: the position loop does not overshoot by itself.
    const double highest =
        std::max(safe_.position_gain,
                 std::min(highest_position_gain, result_.settings.speed_gain / result_.inertia / 4));
    result_.critical_position_gain = critical("position gain", safe_.position_gain, highest, with);
    const double found = result_.critical_position_gain > 0 ? result_.critical_position_gain : highest;
    result_.settings = with(kept * found);
    say("80 % of the critical gains: speed gain {:.4g}, position gain {:.4g} 1/s",
        result_.settings.speed_gain, result_.settings.position_gain);
  }

  // Friction compensation where it makes the reversal better.
  void fine_feed_forward() {
    auto with = result_.settings;
    with.friction_compensation = std::clamp(result_.coulomb, 0.0, 1.0);
    const auto motion = task_.circles ? circle(task_) : stroke_at(task_, 500, 6);
    const auto before = move(result_.settings, motion), after = move(with, motion);
    if (before.vibration || after.vibration) return;
    const double window = task_.circles ? reversal_window : 0.1;
    const double jump = reversal_jump(before.trace, window), compensated = reversal_jump(after.trace, window);
    say("reversal {:.2f} um, with friction compensation {:.2f} um", jump * 1e3, compensated * 1e3);
    if (compensated < jump) result_.settings = with;
  }

  // Lower gains where the axis vibrates or a speed overshoots (the manual's rule); the dual loop where the
  // load does.
  void reach_limits() {
    for (int i = 0; i < most_corrections; ++i) {
      bool vibration = false;
      result_.figures = servo_figures(*this, vibration);
      for (const auto& f : result_.figures)
        say("  {:<28} {:>9.3f}, limit {:g} {}", f.name, f.value, f.limit, f.unit);
      if (!vibration && result_.reached()) return;
      auto& s = result_.settings;
      if (vibration || !speed_figures_reached()) {
        if (task_.full_closed_loop && i % 2 == 0 && s.dual_loop_time < 30) {
          s.dual_loop_time = std::min(30.0, s.dual_loop_time + 3);
        } else if (task_.full_closed_loop) {
          s.position_gain *= 0.85;
        } else {
          set_speed_gain(s, s.speed_gain * 0.9);
          s.position_gain *= 0.9;
        }
      } else if (s.speed_integral_time > shortest_integral_time()) {
        s.speed_integral_time = std::max(s.speed_integral_time * 0.7, shortest_integral_time());
      } else {
        s.speed_gain = std::min(s.speed_gain * 1.1, 1e4);
        s.position_gain = std::min(s.position_gain * 1.1, 1000.0);
      }
      say("limits not reached: speed gain {:.4g} 1/s, integral time {:.3g} ms, position gain {:.4g} 1/s, "
          "dual loop {:.3g} ms",
          s.speed_gain, s.speed_integral_time, s.position_gain, s.dual_loop_time);
    }
  }

  // Four time constants of the speed loop, ms: half of the damping is left.
  double shortest_integral_time() const {
    return std::max(2.0, 4e3 * result_.inertia / result_.settings.speed_gain);
  }

  bool speed_figures_reached() const {
    return std::all_of(result_.figures.begin(), result_.figures.end(),
                       [](const auto& f) { return f.reached() || f.unit == "mm"; });
  }

  std::vector<ServoFigure> servo_figures(Tuning& self, bool& vibration) {
    struct Counting : AxisUnderTest {
      explicit Counting(Tuning& t) : tuning(t) {}
      MotionResult move(const ServoSettings& trial, const ServoSettings&, double,
                        const TestMotion& motion) override {
        return tuning.move(trial, motion);
      }
      Tuning& tuning;
    } counting(self);
    return servo_analysis::servo_figures(counting, task_, result_.settings, &vibration);
  }

  AxisUnderTest& axis_;
  const TuningTask& task_;
  ServoSettings safe_;
  MotionResult first_;
  TuningResult result_;
};

}  // namespace

bool TuningResult::reached() const {
  return !figures.empty() &&
         std::all_of(figures.begin(), figures.end(), [](const auto& f) { return f.reached(); });
}

std::vector<ServoFigure> servo_figures(AxisUnderTest& axis, const TuningTask& task,
                                       const ServoSettings& settings, bool* vibration) {
  std::vector<ServoFigure> figures;
  bool vibrates = false;
  const auto& l = task.limits;
  for (const double feed : overshoot_feeds) {
    if (feed > task.highest_feed) continue;
    const auto moved = axis.move(settings, settings, task.amplitude, stroke_at(task, feed, 4));
    vibrates = vibrates || moved.vibration;
    const auto f = motion_figures(moved.trace);
    if (f.phases == 0 && !moved.vibration)
      throw std::runtime_error("the axis has no constant speed at F" +
                               std::to_string(static_cast<int>(feed)) + ": it needs more travel");
    const std::string at = " at F" + std::to_string(static_cast<int>(feed));
    const bool low = task.full_closed_loop && feed <= 500;
    if (feed == 1000)
      figures.push_back({"following error" + at, std::abs(f.following_error), l.following_error, "mm"});
    figures.push_back(
        {"overshoot" + at, f.overshoot * per_minute, low ? l.overshoot_full_closed : l.overshoot, "mm/min"});
    if (feed == 3000) figures.push_back({"ripple" + at, f.ripple * per_minute, l.ripple, "mm/min"});
  }
  if (task.circles) {
    const auto moved = axis.move(settings, settings, task.amplitude, circle(task));
    vibrates = vibrates || moved.vibration;
    figures.push_back({"quadrant jump", reversal_jump(moved.trace, reversal_window), l.reversal_jump, "mm"});
  }
  if (vibration != nullptr) *vibration = vibrates;
  return figures;
}

TuningResult tune_axis(AxisUnderTest& axis, const TuningTask& task) {
  if (!(task.amplitude > 0) || !(task.rated_acceleration > 0) || !(task.travel > 0))
    throw std::runtime_error("amplitude, rated acceleration and travel must be above zero");
  return Tuning(axis, task).run();
}

}  // namespace trunnion::servo_analysis
