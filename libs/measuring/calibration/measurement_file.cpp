// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_file.hpp"

#include <fmt/core.h>

#include <cmath>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::calibration {
namespace {

using machine::Limits;

constexpr Limits place{-1e5, 1e5}, any_angle{-1e6, 1e6};

ReferenceMeasurement read_reference(const machine::YamlReader& reader, const YAML::Node& map) {
  ReferenceMeasurement found;
  reader.each(map, "sphere_mm, zero_offset_mm", [&](const std::string& key, const YAML::Node& node) {
    if (key == "sphere_mm") return found.sphere = reader.vector(node, place), true;
    return key == "zero_offset_mm" && (found.zero_offset = reader.vector(node, place), true);
  });
  if (!map["sphere_mm"] || !map["zero_offset_mm"])
    reader.fail(map, "expected sphere_mm and zero_offset_mm of the reference");
  return found;
}

class InputReader {
 public:
  InputReader(const std::string& file, const MeasuredMachine& machine) : reader_(file), machine_(machine) {}

  MeasurementInputs read(const YAML::Node& root) {
    in_ = default_inputs(machine_);
    reader_.each(root,
                 "plane, transformation, mode, calibrate_probe, positioning, reference, "
                 "reference_measurement, zero_offset_mm, sphere, "
                 "probe, measuring_path_mm, confidence_range_mm, axes, further_poses, vector_tolerance_mm, "
                 "tolerance_alarm, "
                 "directions, settings",
                 [&](const std::string& key, const YAML::Node& node) { return input(key, node); });
    if (const auto fault = fault_of(in_, machine_); !fault.empty()) reader_.fail(root, fault);
    return in_;
  }

 private:
  bool input(const std::string& key, const YAML::Node& node) {
    if (key == "plane")
      in_.plane = reader_.choice<Plane>(
          node, {{"G17", Plane::g17}, {"G18", Plane::g18}, {"G19", Plane::g19}, {"active", Plane::active}});
    else if (key == "transformation")
      in_.transformation = reader_.text(node);
    else if (key == "mode")
      in_.mode = reader_.choice<Mode>(node, {{"correct", Mode::correct},
                                             {"only_correct", Mode::only_correct},
                                             {"measure_only", Mode::measure_only}});
    else if (key == "calibrate_probe")
      in_.calibrate_probe = boolean(node);
    else if (key == "positioning")
      in_.positioning = reader_.choice<Positioning>(
          node, {{"paraxial", Positioning::paraxial}, {"circular", Positioning::circular}});
    else if (key == "reference")
      in_.reference = reader_.choice<Reference>(
          node,
          {{"without", Reference::without}, {"measure", Reference::measure}, {"adapt", Reference::adapt}});
    else if (key == "reference_measurement")
      in_.reference_measurement = read_reference(reader_, node);
    else if (key == "zero_offset_mm")
      in_.zero_offset = reader_.vector(node, place);
    else if (key == "measuring_path_mm")
      in_.measuring_path = reader_.number(node, {0.01, 100});
    else if (key == "confidence_range_mm")
      in_.confidence_range = reader_.number(node, {0.001, 100});
    else if (key == "further_poses")
      in_.further_poses = whole(node, 0, 100);
    else if (key == "vector_tolerance_mm")
      in_.vector_tolerance = reader_.number(node, {0, 1000});
    else if (key == "tolerance_alarm")
      in_.tolerance_needs_reset = reader_.choice<bool>(node, {{"acknowledge", false}, {"reset", true}});
    else if (key == "directions")
      in_.write_directions = reader_.choice<bool>(node, {{"report", false}, {"write", true}});
    else if (key == "sphere")
      sphere(node);
    else if (key == "probe")
      probe(node);
    else if (key == "settings")
      settings(node);
    else if (key == "axes")
      axes(node);
    else
      return false;
    return true;
  }

  bool boolean(const YAML::Node& node) {
    return reader_.choice<bool>(node, {{"true", true}, {"false", false}, {"yes", true}, {"no", false}});
  }

  void sphere(const YAML::Node& map) {
    reader_.each(map, "centre_mm, diameter_mm, shaft, shaft_diameter_mm",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "centre_mm") return in_.sphere = reader_.vector(node, place), true;
                   if (key == "diameter_mm")
                     return in_.sphere_diameter = reader_.number(node, {1, 200}), true;
                   if (key == "shaft_diameter_mm")
                     return in_.shaft_diameter = reader_.number(node, {0, 100}), true;
                   if (key != "shaft") return false;
                   in_.shaft = reader_.vector(node, place);
                   if (!(in_.shaft->norm() > 1e-6)) reader_.fail(node, "the vector has no length");
                   return true;
                 });
  }

  void probe(const YAML::Node& map) {
    reader_.each(map, "length_mm, length_uncertainty_mm, ball_diameter_mm, on_m, off_m",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "length_mm") return in_.probe_length = reader_.number(node, {0, 1e4}), true;
                   if (key == "length_uncertainty_mm")
                     return in_.probe_length_uncertainty = reader_.number(node, {0, 1}), true;
                   if (key == "ball_diameter_mm")
                     return in_.ball_diameter = reader_.number(node, {0.1, 100}), true;
                   if (key == "on_m")
                     return in_.probe_on = static_cast<std::uint32_t>(whole(node, 0, 9999)), true;
                   if (key == "off_m")
                     return in_.probe_off = static_cast<std::uint32_t>(whole(node, 0, 9999)), true;
                   return false;
                 });
  }

  void settings(const YAML::Node& map) {
    reader_.each(
        map,
        "touches, diameter_tolerance_mm, least_triangle_angle_deg, least_swept_angle_deg, "
        "rotary_feed_deg_per_min, circle_feed_mm_per_min, positioning_feed_mm_per_min, "
        "first_touch_feed_mm_per_min, measuring_feed_mm_per_min, repeatability_mm, transformation_active",
        [&](const std::string& key, const YAML::Node& node) {
          if (key == "touches")
            in_.touches = reader_.choice<std::size_t>(node, {{"8", 8}, {"10", 10}});
          else if (key == "diameter_tolerance_mm")
            in_.diameter_tolerance = reader_.number(node, {0.0001, 10});
          else if (key == "least_triangle_angle_deg")
            in_.least_triangle_angle = reader_.number(node, {2, 60});
          else if (key == "least_swept_angle_deg")
            in_.least_swept_angle = reader_.number(node, {10, 180});
          else if (key == "rotary_feed_deg_per_min")
            in_.rotary_feed = reader_.number(node, {1, 1e5});
          else if (key == "circle_feed_mm_per_min")
            in_.circle_feed = reader_.number(node, {1, 1e5});
          else if (key == "positioning_feed_mm_per_min")
            in_.positioning_feed = reader_.number(node, {1, 1e5});
          else if (key == "first_touch_feed_mm_per_min")
            in_.first_touch_feed = reader_.number(node, {1, 1e4});
          else if (key == "repeatability_mm")
            in_.repeatability = reader_.number(node, {0.0001, 1});
          else if (key == "measuring_feed_mm_per_min")
            in_.measuring_feed = reader_.number(node, {1, 1e4});
          else if (key == "transformation_active")
            in_.transformation_active = boolean(node);
          else
            return false;
          return true;
        });
  }

  void axes(const YAML::Node& map) {
    const auto defaults = in_.axes;
    in_.axes.clear();
    reader_.each(map, "A, B, C, U, V, W", [&](const std::string& key, const YAML::Node& node) {
      const auto letter = key.size() == 1 ? rotary_letters.find(key[0]) : rotary_letters.npos;
      if (letter == rotary_letters.npos) return false;
      AxisRange range;
      for (const auto& known : defaults)
        if (known.angle == letter) range = known;
      range.angle = letter;
      axis(node, range);
      in_.axes.push_back(range);
      return true;
    });
  }

  void axis(const YAML::Node& map, AxisRange& range) {
    reader_.each(map,
                 "start_deg, end_deg, points, other_deg, touch_start_deg, normalization, normalized_value_mm",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "start_deg") return range.start = reader_.number(node, any_angle), true;
                   if (key == "end_deg") return range.end = reader_.number(node, any_angle), true;
                   if (key == "other_deg") return range.other = reader_.number(node, any_angle), true;
                   if (key == "touch_start_deg")
                     return range.touch_start = reader_.number(node, {-360, 360}), true;
                   if (key == "normalized_value_mm")
                     return range.normalized_value = reader_.number(node, place), true;
                   if (key == "points") return range.points = whole(node, 3, 12), true;
                   if (key != "normalization") return false;
                   range.normalization = static_cast<int>(whole(node, 0, 16));
                   const auto checked = metrology::normalization_of(*range.normalization, 0);
                   if (const auto* fault = std::get_if<std::string>(&checked)) reader_.fail(node, *fault);
                   return true;
                 });
  }

  std::size_t whole(const YAML::Node& node, double low, double high) {
    const double value = reader_.number(node, {low, high});
    if (value != std::floor(value)) reader_.fail(node, reader_.text(node) + " is not a whole number");
    return static_cast<std::size_t>(value);
  }

  machine::YamlReader reader_;
  const MeasuredMachine& machine_;
  MeasurementInputs in_;
};

}  // namespace

MeasurementInputs parse_inputs(const std::string& text, const std::string& file,
                               const MeasuredMachine& machine) {
  return InputReader(file, machine).read(machine::parse_yaml(text, file));
}

ReferenceMeasurement parse_reference(const std::string& text, const std::string& file) {
  return read_reference(machine::YamlReader(file), machine::parse_yaml(text, file));
}

std::string text_of(const ReferenceMeasurement& reference) {
  const auto &s = reference.sphere, &z = reference.zero_offset;
  return fmt::format("{{sphere_mm: [{:.9f}, {:.9f}, {:.9f}], zero_offset_mm: [{:.9f}, {:.9f}, {:.9f}]}}\n",
                     s.x(), s.y(), s.z(), z.x(), z.y(), z.z());
}

}  // namespace trunnion::calibration
