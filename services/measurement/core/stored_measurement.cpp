// SPDX-License-Identifier: Apache-2.0
#include "stored_measurement.hpp"

#include <cmath>
#include <stdexcept>

#include "snapshot/fields.hpp"

namespace trunnion::measurement {
namespace {

using idl::measurement::Phase;

constexpr std::size_t most_poses = 128, most_coordinates = 60, angle_count = 6;  // idl/measurement.idl

void check(const StoredMeasurement& m) {
  const auto finite = [](const std::vector<double>& values) {
    for (const double value : values)
      if (!std::isfinite(value)) throw std::runtime_error("a number is not finite");
  };
  if (m.state.phase > Phase::FINISHED) throw std::runtime_error("the phase is not known");
  if (m.request.mode > idl::measurement::Mode::ONLY_CORRECT)
    throw std::runtime_error("the mode is not known");
  if (!m.request.sphere.empty() && m.request.sphere.size() != 3)
    throw std::runtime_error("the sphere has not three coordinates");
  if (m.request.probe_length.size() > 1) throw std::runtime_error("there is more than one probe length");
  finite(m.request.sphere);
  finite(m.request.probe_length);
  if (m.result.poses.size() > most_poses) throw std::runtime_error("there are too many poses");
  for (const auto& pose : m.result.poses) {
    if (pose.angles.size() != angle_count || pose.touches.size() > most_coordinates ||
        pose.touches.size() % 3 != 0)
      throw std::runtime_error("a pose is incomplete");
    finite(pose.angles);
    finite(pose.touches);
  }
}

}  // namespace

std::string text_of(const StoredMeasurement& measurement) {
  return bus::text_of(snapshot::written(measurement)) + "\n";
}

StoredMeasurement parse_measurement(const std::string& text) {
  StoredMeasurement measurement;
  try {
    const auto json = bus::Json::parse(text);
    if (!json.is_object()) throw std::runtime_error("it is no JSON object");
    snapshot::read(json, measurement);
  } catch (const bus::Json::exception& e) {
    throw std::runtime_error(e.what());
  }
  check(measurement);
  return measurement;
}

bool is_active(Phase phase) {
  switch (phase) {
    case Phase::PLANNING:
    case Phase::REPEATABILITY:
    case Phase::MEASURING:
    case Phase::RETRACTING:
    case Phase::ESTIMATING:
    case Phase::WRITING:
    case Phase::STOPPING:
      return true;
    case Phase::NOTHING:
    case Phase::WAITING:
    case Phase::INTERRUPTED:
    case Phase::FINISHED:
      return false;
  }
  return false;
}

}  // namespace trunnion::measurement
