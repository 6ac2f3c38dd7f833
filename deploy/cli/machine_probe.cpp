// SPDX-License-Identifier: Apache-2.0
#include "machine_probe.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "figures.hpp"
#include "metrology/sphere.hpp"
#include "storage/file.hpp"

namespace trunnion::cli {
namespace {

using calibration::AxisPosition;
using calibration::PlannedPose;
using calibration::Vec3;

constexpr const char* probe_program = "calibration_pose.tmp.nc";
constexpr double moved_tolerance = 0.02;  // mm: of the sphere since the poses that were measured before

class MachineProbe {
 public:
  MachineProbe(std::uint32_t domain, const MachineMeasurement& m, std::string& phase, std::size_t& complete)
      : m_(m),
        chain_(std::get<geometry::Chain>(geometry::Chain::make(m.machine.model))),
        runner_(domain, m.channel),
        phase_(phase),
        complete_(complete) {}

  std::vector<calibration::TouchedPose> run() {
    runner_.provide("O9801.nc", calibration::double_touch_macro);
    const auto planned = m_.plan.poses.size();
    if (m_.check) {
      phase_ = "plan";
      std::fprintf(stderr, "moves between %zu poses: no collision\n", m_.check(runner_.position()));
    }
    phase_ = "repeatability of the probe";
    check_repeatability();
    auto poses = calibration::touch_poses(
        m_.inputs, m_.machine, m_.plan,
        [&](const PlannedPose& pose, const Vec3& centre, const std::string& name) {
          phase_ = "pose " + name;
          return touch(pose, centre);
        },
        m_.done,
        [&](const auto& done) {
          storage::replace_file(m_.touches_file, calibration::text_of(done, m_.machine.model));
          complete_ = done.size();
          std::fprintf(stderr, "pose %zu of %zu, %s: %zu touches\n", complete_, planned,
                       calibration::pose_name(done.back().angles, m_.machine.model).c_str(),
                       done.back().positions.size());
        });
    phase_ = "end";
    auto last = runner_.position();
    auto top = last;
    top[2] = retract_height(last);
    const auto way = m_.way ? m_.way(last, top) : calibration::Way{top};
    execute(calibration::positioning_program(m_.inputs, m_.machine, way, ++serial_));
    runner_.remove(probe_program);
    return poses;
  }

 private:
  double retract_height(const AxisPosition& from) const {
    const auto& travel = m_.machine.outline.axes[2];
    return travel.present ? travel.high : from[2];
  }
  calibration::Way way_to(const PlannedPose& pose, const Vec3& centre) {
    const auto from = runner_.position(), to = calibration::approach_position(m_.inputs, pose, centre);
    if (m_.way) return m_.way(from, to);
    return calibration::retract_way(from, to, retract_height(from));
  }
  calibration::MacroVariables execute(const std::string& text) {
    return runner_.run(probe_program, text, serial_);
  }

  std::vector<Vec3> touch(const PlannedPose& pose, const Vec3& centre) {
    // The second round begins where the first one has ended, over the pole.
    const auto here = runner_.position();
    const bool there = std::equal(pose.angles.begin(), pose.angles.end(), here.begin() + 3,
                                  [](double a, double b) { return std::abs(a - b) < 1e-3; });
    const auto approach = calibration::approach_position(m_.inputs, pose, centre);
    const bool over_pole =
        there && (Vec3(here[0], here[1], here[2]) - Vec3(approach[0], approach[1], approach[2])).norm() <
                     m_.inputs.measuring_path;
    const auto way = over_pole ? calibration::Way{approach} : way_to(pose, centre);
    const auto variables =
        execute(calibration::measuring_program(m_.inputs, m_.machine, pose, centre, way, ++serial_));
    return calibration::measured_positions(variables, pose.directions.size());
  }

  // The centre of the sphere at the initial pose: as measured before, or as expected.
  Vec3 initial_centre() const {
    if (m_.done.empty())
      return chain_.machine_from_tip(m_.inputs.sphere, m_.plan.poses[0].angles, m_.inputs.probe_length);
    const auto& positions = m_.done.front().positions;
    std::vector<Vec3> newest(
        positions.end() - static_cast<std::ptrdiff_t>(m_.plan.poses[0].directions.size()), positions.end());
    const auto fit = metrology::fit_sphere(newest);
    if (const auto* error = std::get_if<metrology::SphereError>(&fit))
      throw std::runtime_error(std::string("stored touches: ") + metrology::to_string(*error));
    return std::get<metrology::SphereFit>(fit).centre;
  }

  void check_repeatability() {
    const auto& pose = m_.plan.poses.front();
    const Vec3 centre = initial_centre();
    const auto way = way_to(pose, centre);
    const auto variables =
        execute(calibration::repeatability_program(m_.inputs, m_.machine, pose, centre, way, ++serial_));
    const auto positions = calibration::measured_positions(variables, calibration::repeated_touches);
    const Vec3& tool = pose.directions.back();
    const double range = calibration::range_along(positions, tool);
    std::fprintf(stderr, "repeatability of the probe: %.2f um over %zu touches, permitted %.2f um\n",
                 um * range, calibration::repeated_touches, um * m_.inputs.repeatability);
    char text[200];
    std::snprintf(text, sizeof text,
                  "%zu touches of one point differ by %.2f um, %.2f um is permitted: check the probe",
                  calibration::repeated_touches, um * range, um * m_.inputs.repeatability);
    if (!(range <= m_.inputs.repeatability)) throw std::runtime_error(text);
    if (m_.done.empty()) return;
    const double moved = (positions.back() - m_.done.front().positions.back()).dot(tool);
    std::snprintf(text, sizeof text,
                  "the sphere is %.1f um from where the stored touches have it, %.0f um is permitted; start "
                  "again without --resume",
                  um * std::abs(moved), um * moved_tolerance);
    if (!(std::abs(moved) <= moved_tolerance)) throw std::runtime_error(text);
  }

  const MachineMeasurement& m_;
  geometry::Chain chain_;
  ProgramRunner runner_;
  std::string& phase_;
  std::size_t& complete_;
  std::uint32_t serial_ = 0;
};

}  // namespace

std::vector<calibration::TouchedPose> measure_on_machine(std::uint32_t domain,
                                                         const MachineMeasurement& measurement) {
  const InterruptWatch watch;
  std::string phase = "begin";
  std::size_t complete = measurement.done.size();
  try {
    MachineProbe probe(domain, measurement, phase, complete);
    return probe.run();
  } catch (const std::exception& e) {
    const std::string cause = e.what(), prefix = phase + ": ";
    throw std::runtime_error(
        (cause.starts_with(prefix) ? "" : prefix) + cause + "; nothing written, " + std::to_string(complete) +
        " of " + std::to_string(measurement.plan.poses.size()) + " poses are complete in " +
        measurement.touches_file + (complete > 0 ? ": --resume continues after them" : ""));
  }
}

}  // namespace trunnion::cli
