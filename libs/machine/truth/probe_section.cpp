// SPDX-License-Identifier: Apache-2.0
#include "truth/probe_section.hpp"

#include <array>

#include "geometry/angle.hpp"
#include "truth/true_geometry.hpp"
#include "truth/units.hpp"

namespace trunnion::truth {
namespace {

constexpr machine::Limits position{-1e5, 1e5}, angle{-360, 360};  // mm, deg
constexpr machine::Limits size{1e-3, 1e4};                        // mm: lengths and diameters
constexpr std::size_t most_solids = 64;

// A length that the entry of a solid must have.
struct Length {
  const char* key;
  double value = 0;
};

class SolidReader {
 public:
  explicit SolidReader(const machine::YamlReader& reader) : reader_(reader) {}

  touch_probe::Solid read(const YAML::Node& entry) {
    YAML::Node shape;
    std::string kind;
    centre_ = turn_ = Vec3::Zero();
    reader_.each(entry, "one of sphere, box, ring, cylinder; position_mm, rotation_deg",
                 [&](const std::string& key, const YAML::Node& value) {
                   if (key == "position_mm") return centre_ = reader_.vector(value, position), true;
                   if (key == "rotation_deg")
                     return turn_ = geometry::radians_per_degree * reader_.vector(value, angle), true;
                   if (key != "sphere" && key != "box" && key != "ring" && key != "cylinder") return false;
                   if (!kind.empty())
                     reader_.fail(value, "'" + kind + "' is there already: one solid, one shape");
                   kind = key;
                   shape = value;
                   return true;
                 });
    if (kind.empty()) reader_.fail(entry, "a shape is missing: one of sphere, box, ring, cylinder");
    edges_ = rotation(turn_);
    return kind == "sphere" ? sphere(shape)
           : kind == "box"  ? box(shape)
           : kind == "ring" ? ring(shape)
                            : cylinder(shape);
  }

 private:
  template <std::size_t n>
  void lengths(const YAML::Node& shape, std::array<Length, n>& wanted) {
    std::string keys;
    for (const auto& length : wanted) keys.append(keys.empty() ? "" : ", ").append(length.key);
    reader_.each(shape, keys, [&](const std::string& key, const YAML::Node& value) {
      for (auto& length : wanted)
        if (key == length.key) return length.value = reader_.number(value, size), true;
      return false;
    });
    for (const auto& length : wanted)
      if (length.value == 0) reader_.fail(shape, std::string("'") + length.key + "' is missing");
  }

  touch_probe::Solid sphere(const YAML::Node& shape) {
    touch_probe::SphereGauge out;
    double diameter = 0;
    out.centre = centre_;
    out.shaft = -edges_.col(2);
    reader_.each(shape, "diameter_mm, shaft_diameter_mm, shaft_length_mm",
                 [&](const std::string& key, const YAML::Node& value) {
                   if (key == "diameter_mm") return diameter = reader_.number(value, size), true;
                   if (key == "shaft_diameter_mm")
                     return out.shaft_radius = reader_.number(value, size) / 2, true;
                   return key == "shaft_length_mm" && (out.shaft_length = reader_.number(value, size), true);
                 });
    if (diameter == 0) reader_.fail(shape, "'diameter_mm' is missing");
    if ((out.shaft_radius > 0) != (out.shaft_length > 0))
      reader_.fail(shape, "a shaft has both 'shaft_diameter_mm' and 'shaft_length_mm'");
    out.radius = diameter / 2;
    if (out.shaft_radius >= out.radius && out.shaft_radius > 0)
      reader_.fail(shape["shaft_diameter_mm"], "the shaft must be thinner than the sphere");
    return out;
  }

  touch_probe::Solid box(const YAML::Node& shape) {
    touch_probe::CuboidGauge out;
    bool given = false;
    reader_.each(shape, "size_mm", [&](const std::string& key, const YAML::Node& value) {
      return key == "size_mm" && (out.half_lengths = reader_.vector(value, size) / 2, given = true);
    });
    if (!given) reader_.fail(shape, "'size_mm' is missing");
    out.centre = centre_;
    out.edges = edges_;
    return out;
  }

  touch_probe::Solid ring(const YAML::Node& shape) {
    std::array<Length, 3> l{{{"bore_mm"}, {"outside_mm"}, {"height_mm"}}};
    lengths(shape, l);
    if (l[1].value <= l[0].value)
      reader_.fail(shape["outside_mm"], "the outside diameter must exceed the bore");
    return touch_probe::RingGauge{centre_, edges_.col(2), l[0].value / 2, l[1].value / 2, l[2].value / 2};
  }

  touch_probe::Solid cylinder(const YAML::Node& shape) {
    std::array<Length, 2> l{{{"diameter_mm"}, {"height_mm"}}};
    lengths(shape, l);
    return touch_probe::CylinderGauge{centre_, edges_.col(2), l[0].value / 2, l[1].value / 2};
  }

  const machine::YamlReader& reader_;
  Vec3 centre_, turn_;
  Mat3 edges_;
};

}  // namespace

touch_probe::TouchProbeTruth read_probe(const machine::YamlReader& reader, const YAML::Node& section) {
  touch_probe::TouchProbeTruth out;
  const machine::Limits small{0, 1e4}, seed{0, 4294967295.0}, touch{1, 1e9};  // um
  const auto whole = [&](const YAML::Node& node, machine::Limits limits) {
    const double value = reader.number(node, limits);
    if (value != static_cast<double>(static_cast<std::uint32_t>(value)))
      reader.fail(node, "expected a whole number");
    return static_cast<std::uint32_t>(value);
  };
  reader.each(
      section,
      "ball_radius_mm, length_mm, pre_travel_um, lobing_um, lobing_phase_deg, repeatability_um, delay_ms, "
      "seed, no_signal_from_touch, early_mm, early_from_touch, stuck_from_touch",
      [&](const std::string& key, const YAML::Node& v) {
        if (key == "ball_radius_mm") return out.ball_radius = reader.number(v, {1e-3, 100}), true;
        if (key == "length_mm") return out.length = reader.number(v, {0, 2000}), true;
        if (key == "pre_travel_um") return out.pre_travel = um * reader.number(v, small), true;
        if (key == "lobing_um") return out.lobing = um * reader.number(v, small), true;
        if (key == "lobing_phase_deg") return out.lobing_phase = reader.number(v, angle), true;
        if (key == "repeatability_um") return out.repeatability = um * reader.number(v, small), true;
        if (key == "delay_ms") return out.delay = ms * reader.number(v, {0, 1000}), true;
        if (key == "seed") return out.seed = whole(v, seed), true;
        if (key == "no_signal_from_touch") return out.no_signal_from = whole(v, touch), true;
        if (key == "early_mm") return out.early = reader.number(v, {1e-3, 100}), true;
        if (key == "stuck_from_touch") return out.stuck_from = whole(v, touch), true;
        return key == "early_from_touch" && (out.early_from = whole(v, touch), true);
      });
  return out;
}

std::vector<touch_probe::Solid> read_solids(const machine::YamlReader& reader, const YAML::Node& section) {
  if (!section.IsSequence()) reader.fail(section, "expected a list of solids");
  if (section.size() > most_solids)
    reader.fail(section, "at most " + std::to_string(most_solids) + " solids are possible");
  std::vector<touch_probe::Solid> solids;
  SolidReader one(reader);
  for (const auto& entry : section) solids.push_back(one.read(entry));
  return solids;
}

}  // namespace trunnion::truth
