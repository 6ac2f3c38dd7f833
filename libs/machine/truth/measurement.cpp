// SPDX-License-Identifier: Apache-2.0
#include "truth/measurement.hpp"

#include "geometry/angle.hpp"

namespace trunnion::truth {
namespace {

// A machine whose axes remember the direction of their newest motion.
class Motion {
 public:
  explicit Motion(const PoseReport& report) : report_(report) {}

  ToolPose to(const Vec3& axes, const geometry::Angles& angles = {}) {
    MachinePose next = now_;
    for (std::size_t i = 0; i < 3; ++i) next.positions[i] = axes[static_cast<Eigen::Index>(i)];
    std::copy(angles.begin(), angles.end(), next.positions.begin() + 3);
    if (started_)
      for (std::size_t i = 0; i < axis_count; ++i)
        if (next.positions[i] != now_.positions[i])
          next.approach[i] = next.positions[i] > now_.positions[i] ? 1 : -1;
    next.tool_length = report_.tool_length;
    next.temperatures = report_.temperatures;
    started_ = true;
    now_ = next;
    return report_.true_pose(now_);
  }

 private:
  const PoseReport& report_;
  MachinePose now_;
  bool started_ = false;
};

}  // namespace

BallbarMeasurement measure_ballbar(const PoseReport& report, const BallbarPath& path,
                                   const InstrumentTruth& truth) {
  Instrument instrument(truth);
  Motion motion(report);
  BallbarMeasurement measured;
  for (const int sense : {1, -1}) {
    auto& readings = sense > 0 ? measured.ccw : measured.cw;
    const auto go = [&](double angle) {
      const auto [s, c] = geometry::sine_cosine(angle);
      Vec3 tip = path.centre;
      tip[static_cast<Eigen::Index>(path.first)] += path.radius * c;
      tip[static_cast<Eigen::Index>(path.second)] += path.radius * s;
      return motion.to(report.model().machine_from_tip(tip, {}, report.tool_length)).tip;
    };
    const double step = sense * 360.0 / static_cast<double>(path.points);
    for (std::size_t i = 0; i < path.points + path.points / 4; ++i) {
      // The reading is half a step beside a reversal, where the direction of an axis is not defined, and
      // after a quarter of a step in the direction of the reading.
      const double angle = (static_cast<double>(i) + 0.5) * step - sense * 90;
      go(angle - step / 4);
      const Vec3 tip = go(angle);
      if (sense * angle > 0) readings.push_back({angle, instrument.read(ballbar_deviation(path, tip))});
    }
  }
  return measured;
}

LaserMeasurement measure_laser(const PoseReport& report, const LaserPlan& plan,
                               const InstrumentTruth& truth) {
  Instrument instrument(truth);
  Motion motion(report);
  LaserMeasurement measured;
  const double step = (plan.to - plan.from) / static_cast<double>(std::max<std::size_t>(plan.targets, 2) - 1);
  const double overrun = 0.1 * step;
  const auto go = [&](double position) {
    Vec3 axes = plan.others;
    axes[static_cast<Eigen::Index>(plan.axis)] = position;
    return motion.to(axes);
  };
  const auto target = [&](std::size_t i) { return plan.from + step * static_cast<double>(i); };
  for (std::size_t i = 0; i < plan.targets; ++i) measured.targets.push_back({target(i), {}, {}});
  go(plan.from - overrun);
  LaserSetup setup;
  setup.zero = go(plan.from);
  const auto about = static_cast<Eigen::Index>(plan.component % 3);
  if (plan.component > 2) {
    // along x across is the axis of the rotation.
    setup.along = Vec3::Unit((about + 1) % 3), setup.across = Vec3::Unit((about + 2) % 3);
  } else {
    setup.along = setup.across = Vec3::Unit(about);
  }
  const auto read = [&](std::size_t i) {
    const auto tool = go(target(i));
    if (plan.component > 2) return instrument.read(laser_angle(setup, tool));
    if (plan.component != plan.axis) return instrument.read(laser_straightness(setup, tool));
    return instrument.read(laser_distance(setup, tool)) - (target(i) - plan.from);
  };
  for (std::size_t run = 0; run < plan.runs; ++run) {
    go(plan.from - overrun);
    for (std::size_t i = 0; i < plan.targets; ++i) measured.targets[i].up.push_back(read(i));
    go(plan.to + overrun);
    for (std::size_t i = plan.targets; i-- > 0;) measured.targets[i].down.push_back(read(i));
  }
  measured.accuracy = position_accuracy(measured.targets);
  return measured;
}

std::vector<NestReading> measure_nest(const PoseReport& report, std::size_t axis, double from, double to,
                                      std::size_t points, const Vec3& centre, const InstrumentTruth& truth,
                                      bool back) {
  Instrument instrument(truth);
  Motion motion(report);
  const auto at = [&](double angle) {
    geometry::Angles angles{};
    angles[axis - 3] = angle;
    return motion.to(report.model().machine_from_tip(centre, angles, report.tool_length), angles).tip;
  };
  const double step = (to - from) / static_cast<double>(std::max<std::size_t>(points, 2) - 1);
  at(from - 0.1 * step);
  const auto nest = Nest::at(at(from));
  std::vector<NestReading> readings;
  const auto read = [&](std::size_t i) {
    NestReading reading;
    reading.angle = from + step * static_cast<double>(i);
    reading.sensors = nest.readings(at(reading.angle));
    for (double& sensor : reading.sensors) sensor = instrument.read(sensor);
    reading.deviation = nest.place(reading.sensors) - nest.centre;
    readings.push_back(reading);
  };
  for (std::size_t i = 0; i < points; ++i) read(i);
  if (!back) return readings;
  at(to + 0.1 * step);
  for (std::size_t i = points; i-- > 0;) read(i);
  return readings;
}

}  // namespace trunnion::truth
