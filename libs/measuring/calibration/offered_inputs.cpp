// SPDX-License-Identifier: Apache-2.0
#include "calibration/offered_inputs.hpp"

#include <array>
#include <filesystem>

#include "machine/yaml.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::calibration {
namespace {

using Document = nlohmann::ordered_json;

constexpr std::array rotary_names{"A", "B", "C", "U", "V", "W"};

Document list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Document range_document(const AxisRange& range) {
  Document out{{"start_deg", range.start},
               {"end_deg", range.end},
               {"points", range.points},
               {"other_deg", range.other},
               {"touch_start_deg", range.touch_start}};
  if (range.normalization) {
    out["normalization"] = *range.normalization;
    out["normalized_value_mm"] = range.normalized_value;
  }
  return out;
}

Document sphere_document(const MeasurementInputs& in) {
  Document out{{"centre_mm", list(in.sphere)}, {"diameter_mm", in.sphere_diameter}};
  if (in.shaft) {
    out["shaft"] = list(*in.shaft);
    out["shaft_diameter_mm"] = in.shaft_diameter;
  }
  return out;
}

Document settings_document(const MeasurementInputs& in) {
  return {{"touches", in.touches},
          {"diameter_tolerance_mm", in.diameter_tolerance},
          {"least_triangle_angle_deg", in.least_triangle_angle},
          {"least_swept_angle_deg", in.least_swept_angle},
          {"rotary_feed_deg_per_min", in.rotary_feed},
          {"circle_feed_mm_per_min", in.circle_feed},
          {"positioning_feed_mm_per_min", in.positioning_feed},
          {"first_touch_feed_mm_per_min", in.first_touch_feed},
          {"measuring_feed_mm_per_min", in.measuring_feed},
          {"repeatability_mm", in.repeatability},
          {"transformation_active", in.transformation_active}};
}

const char* name_of(Plane plane) {
  constexpr std::array names{"G17", "G18", "G19", "active"};
  return names.at(static_cast<std::size_t>(plane));
}

const char* name_of(Mode mode) {
  constexpr std::array names{"correct", "only_correct", "measure_only"};
  return names.at(static_cast<std::size_t>(mode));
}

const char* name_of(Reference reference) {
  constexpr std::array names{"without", "measure", "adapt"};
  return names.at(static_cast<std::size_t>(reference));
}

}  // namespace

MeasuredMachine load_measured_machine(const machine::MachineConfig& config, const machine::Parameters& active,
                                      std::uint16_t channel) {
  machine::Parameters delivered;
  delivered.values = machine::machine_parameters(config);
  auto measured = measured_machine(config.name, delivered, active, channel);
  const auto file = config.directory + "/truth.yaml";
  if (!std::filesystem::exists(file)) return measured;
  const auto truth = truth::parse_truth(machine::read_text(file), file, measured.outline);
  measured.gauges = probe_and_sphere(truth.probe, truth.solids);
  return measured;
}

nlohmann::ordered_json input_document(const MeasurementInputs& in) {
  Document out;
  out["plane"] = name_of(in.plane);
  if (!in.transformation.empty()) out["transformation"] = in.transformation;
  out["mode"] = name_of(in.mode);
  out["calibrate_probe"] = in.calibrate_probe;
  out["positioning"] = in.positioning == Positioning::paraxial ? "paraxial" : "circular";
  out["reference"] = name_of(in.reference);
  out["zero_offset_mm"] = list(in.zero_offset);
  out["sphere"] = sphere_document(in);
  out["probe"] = {{"length_mm", in.probe_length},
                  {"length_uncertainty_mm", in.probe_length_uncertainty},
                  {"ball_diameter_mm", in.ball_diameter},
                  {"on_m", in.probe_on},
                  {"off_m", in.probe_off}};
  out["measuring_path_mm"] = in.measuring_path;
  out["confidence_range_mm"] = in.confidence_range;
  out["axes"] = Document::object();
  for (const auto& range : in.axes) out["axes"][rotary_names.at(range.angle)] = range_document(range);
  out["further_poses"] = in.further_poses;
  if (in.vector_tolerance) out["vector_tolerance_mm"] = *in.vector_tolerance;
  out["tolerance_alarm"] = in.tolerance_needs_reset ? "reset" : "acknowledge";
  out["directions"] = in.write_directions ? "write" : "report";
  out["settings"] = settings_document(in);
  return out;
}

nlohmann::ordered_json travel_document(const MeasurementInputs& inputs, const MeasuredMachine& machine) {
  auto out = Document::object();
  for (const auto& range : inputs.axes) {
    const auto& travel = machine.outline.axes[3 + range.angle];
    if (travel.present && travel.way == canonical::RotaryWay::linear)
      out[rotary_names.at(range.angle)] = {travel.low, travel.high};
  }
  return out;
}

}  // namespace trunnion::calibration
