// SPDX-License-Identifier: Apache-2.0
#include "truth/random_machine.hpp"

#include <cmath>

#include "geometry/random_source.hpp"
#include "machine/yaml_reader.hpp"
#include "truth/units.hpp"

namespace trunnion::truth {

extern const char* const grades_text;

namespace {

std::vector<Grade> read_grades() {
  const machine::YamlReader reader("grades.yaml");
  std::vector<Grade> all;
  const auto section = [&](const YAML::Node& node,
                           std::initializer_list<std::pair<const char*, double*>> keys) {
    reader.each(node, "of a grade", [&](const std::string& key, const YAML::Node& value) {
      for (const auto& [name, target] : keys)
        if (key == name) return *target = reader.number(value, {0, 1e6}), true;
      return false;
    });
    return true;
  };
  reader.each(
      YAML::Load(grades_text), "names of grades", [&](const std::string& name, const YAML::Node& node) {
        Grade g;
        g.name = name;
        reader.each(node, "about, linear, rotary, spindle, thermal, drive, beam",
                    [&](const std::string& key, const YAML::Node& v) {
                      if (key == "about") return g.about = reader.text(v), true;
                      if (key == "linear")
                        return section(v, {{"scale_um_per_m", &g.linear.scale_um_per_m},
                                           {"positioning_um", &g.linear.positioning_um},
                                           {"straightness_um", &g.linear.straightness_um},
                                           {"angular_urad", &g.linear.angular_urad},
                                           {"squareness_urad", &g.linear.squareness_urad},
                                           {"pitch_um", &g.linear.pitch_um},
                                           {"pitch_mm", &g.linear.pitch_mm},
                                           {"reversal_um", &g.linear.reversal_um}});
                      if (key == "rotary")
                        return section(v, {{"displacement_um", &g.rotary.displacement_um},
                                           {"inclination_urad", &g.rotary.inclination_urad},
                                           {"zero_urad", &g.rotary.zero_urad},
                                           {"translation_um", &g.rotary.translation_um},
                                           {"tilt_urad", &g.rotary.tilt_urad},
                                           {"positioning_urad", &g.rotary.positioning_urad},
                                           {"reversal_urad", &g.rotary.reversal_urad}});
                      if (key == "spindle")
                        return section(v, {{"inclination_urad", &g.spindle.inclination_urad}});
                      if (key == "drive")
                        return section(v, {{"load_share", &g.drive.load_share},
                                           {"locked_frequency_Hz", &g.drive.locked_frequency_Hz},
                                           {"damping_ratio", &g.drive.damping_ratio},
                                           {"coulomb", &g.drive.coulomb},
                                           {"breakaway_excess", &g.drive.breakaway_excess},
                                           {"viscous_per_mm_per_s", &g.drive.viscous_per_mm_per_s},
                                           {"backlash_um", &g.drive.backlash_um},
                                           {"cogging", &g.drive.cogging}});
                      if (key == "beam")
                        return section(v, {{"misalignment_um", &g.beam.misalignment_um},
                                           {"racking_frequency_Hz", &g.beam.racking_frequency_Hz},
                                           {"racking_damping_ratio", &g.beam.racking_damping_ratio}});
                      return key == "thermal" &&
                             section(v,
                                     {{"expansion_um_per_m_K", &g.thermal.expansion_um_per_m_K},
                                      {"rise_K_per_m_per_min", &g.thermal.rise_K_per_m_per_min},
                                      {"time_constant_s", &g.thermal.time_constant_s},
                                      {"spindle_growth_um_per_K", &g.thermal.spindle_growth_um_per_K},
                                      {"spindle_rise_K_per_1000_rpm", &g.thermal.spindle_rise_K_per_1000_rpm},
                                      {"spindle_time_constant_s", &g.thermal.spindle_time_constant_s}});
                    });
        all.push_back(g);
        return true;
      });
  return all;
}

// A smooth function over the travel without slope: Legendre's second and third polynomial and a wave. Its
// expected mean square is `deviation` squared, a third from each.
ErrorFunction curve(geometry::RandomSource& random, double deviation, const machine::AxisOutline& axis) {
  const double share = deviation / std::sqrt(3.0);
  const double second = share * std::sqrt(5.0) * random.normal();
  const double third = share * std::sqrt(7.0) * random.normal();
  ErrorFunction f;
  f.terms.polynomials.push_back({(axis.low + axis.high) / 2,
                                 (axis.high - axis.low) / 2,
                                 {-second / 2, -1.5 * third, 1.5 * second, 2.5 * third}});
  const double period = (axis.high - axis.low) * (0.2 + 0.5 * random.uniform());
  const double amplitude = share * std::sqrt(2.0) * random.normal();
  f.terms.harmonics.push_back({period, amplitude, 360 * random.uniform()});
  return f;
}

// A periodic function of a turn: the first three harmonics.
ErrorFunction turn(geometry::RandomSource& random, double deviation) {
  ErrorFunction f;
  for (int k = 1; k <= 3; ++k) {
    const double amplitude = deviation * std::sqrt(2.0 / 3.0) * random.normal();
    f.terms.harmonics.push_back({360.0 / k, amplitude, 360 * random.uniform()});
  }
  return f;
}

void draw_linear(const Grade::Linear& grade, std::size_t axis, const machine::AxisOutline& outline,
                 geometry::RandomSource& random, AxisTruth& out) {
  for (std::size_t c = 0; c < component_count; ++c) {
    const bool along = c == axis;
    ErrorFunction f = curve(random,
                            c > 2   ? grade.angular_urad * urad
                            : along ? grade.positioning_um * um
                                    : grade.straightness_um * um,
                            outline);
    if (along) {
      f.terms.polynomials.push_back({0, 1000, {0, grade.scale_um_per_m * um * random.normal()}});
      const double amplitude = grade.pitch_um * um * random.normal();
      f.terms.harmonics.push_back({grade.pitch_mm, amplitude, 360 * random.uniform()});
      f.reversal = -grade.reversal_um * um * std::abs(random.normal());
    }
    out.errors.push_back({c, axis, std::move(f)});
  }
}

void draw_rotary(const Grade::Rotary& grade, std::size_t axis, geometry::RandomSource& random,
                 AxisTruth& out) {
  const auto about = static_cast<Eigen::Index>(axis % 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double displacement = grade.displacement_um * um * random.normal();
    const double inclination =
        (i == about ? grade.zero_urad : grade.inclination_urad) * urad * random.normal();
    // A displacement along the axis is none.
    out.displacement[i] = i == about ? 0 : displacement;
    out.inclination[i] = inclination;
  }
  for (std::size_t c = 0; c < component_count; ++c) {
    const bool along = c == 3 + static_cast<std::size_t>(about);
    ErrorFunction f = turn(random, c < 3   ? grade.translation_um * um
                                   : along ? grade.positioning_urad * urad
                                           : grade.tilt_urad * urad);
    if (along) f.reversal = -grade.reversal_urad * urad * std::abs(random.normal());
    out.errors.push_back({c, axis, std::move(f)});
  }
}

}  // namespace

const std::vector<Grade>& grades() {
  static const std::vector<Grade> all = read_grades();
  return all;
}

GeometryTruth draw_machine(const Grade& grade, std::uint64_t seed, const machine::MachineOutline& machine) {
  GeometryTruth truth;
  geometry::RandomSource random(seed);
  const auto about_one = [&] { return std::max(0.2, 1 + 0.2 * random.normal()); };
  std::array<bool, axis_count> rotary{};
  const auto& design = machine.design;
  for (const auto* side :
       {&design.table_2, &design.table_1, &design.table_0, &design.head_2, &design.head_1, &design.head_0})
    if (*side) rotary[3 + (*side)->angle] = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!machine.axes[i].present) continue;
    draw_linear(grade.linear, i, machine.axes[i], random, truth.axes[i]);
    HeatSource& heat = truth.heat[i];
    heat.expansion = grade.thermal.expansion_um_per_m_K * 1e-6 * about_one();
    heat.rise_per_speed = grade.thermal.rise_K_per_m_per_min * 0.06 * about_one();
    heat.time_constant = grade.thermal.time_constant_s * about_one();
    heat.fixed_point = machine.axes[i].low;
  }
  truth.axes[1].inclination[2] = grade.linear.squareness_urad * urad * random.normal();
  truth.axes[2].inclination[0] = grade.linear.squareness_urad * urad * random.normal();
  truth.axes[2].inclination[1] = grade.linear.squareness_urad * urad * random.normal();
  for (std::size_t i = 3; i < axis_count; ++i)
    if (rotary[i]) draw_rotary(grade.rotary, i, random, truth.axes[i]);
  for (const int i : {0, 1})
    truth.spindle.inclination[i] = grade.spindle.inclination_urad * urad * random.normal();
  HeatSource& spindle = truth.heat[spindle_source];
  spindle.shift = {0, 0, -grade.thermal.spindle_growth_um_per_K * um * about_one()};
  spindle.rise_per_speed = grade.thermal.spindle_rise_K_per_1000_rpm * 1e-3 * about_one();
  spindle.time_constant = grade.thermal.spindle_time_constant_s * about_one();
  return truth;
}

}  // namespace trunnion::truth
