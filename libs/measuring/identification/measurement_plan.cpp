// SPDX-License-Identifier: Apache-2.0
#include "identification/measurement_plan.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "canonical/axes.hpp"
#include "compensation/structure.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"
#include "text/quantity.hpp"

namespace trunnion::identification {
namespace {

using machine::Limits;

using canonical::axis_letters;
constexpr double micro = 1e-3;  // um in mm
constexpr Limits place{-1e5, 1e5}, tool{0, 1e4};

class PlanReader {
 public:
  PlanReader(const std::string& file, const machine::MachineOutline& machine)
      : reader_(file), machine_(machine) {}

  MeasurementPlan read(const YAML::Node& root) {
    MeasurementPlan plan;
    double tool_length = 0;
    bool any = false;
    reader_.each(root, "structure, tool_length_mm, measurements",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "structure") {
                     plan.structure = reader_.text(node);
                     const auto parsed = volumetric::parse_structure(plan.structure);
                     if (const auto* refused = std::get_if<std::string>(&parsed))
                       reader_.fail(node, *refused);
                   } else if (key == "tool_length_mm") {
                     tool_length = reader_.number(node, tool);
                   } else if (key == "measurements") {
                     if (!node.IsSequence() || node.size() == 0 || node.size() > 200)
                       reader_.fail(node, "expected a list of 1 .. 200 measurements");
                     any = true;
                     for (const auto& entry : node) plan.measurements.push_back(measurement(entry));
                   } else {
                     return false;
                   }
                   return true;
                 });
    if (!any) reader_.fail(root, "measurements are missing");
    for (auto& m : plan.measurements)
      if (m.tool_length < 0) m.tool_length = tool_length;
    return plan;
  }

 private:
  Measurement measurement(const YAML::Node& entry) {
    if (!entry.IsMap() || !entry["instrument"])
      reader_.fail(entry, "expected {instrument: laser, ballbar or rtest, ...}");
    Measurement m;
    m.tool_length = -1;  // that of the plan
    m.kind = reader_.choice<InstrumentKind>(entry["instrument"], {{"laser", InstrumentKind::laser},
                                                                  {"ballbar", InstrumentKind::ballbar},
                                                                  {"rtest", InstrumentKind::nest}});
    switch (m.kind) {
      case InstrumentKind::laser:
        laser(entry, m);
        break;
      case InstrumentKind::ballbar:
        ballbar(entry, m);
        break;
      case InstrumentKind::nest:
        nest(entry, m);
        break;
    }
    return m;
  }

  bool common(const std::string& key, const YAML::Node& node, Measurement& m) {
    if (key == "instrument") return true;
    if (key == "tool_length_mm") return m.tool_length = reader_.number(node, tool), true;
    if (key == (m.angular() ? "uncertainty_urad" : "uncertainty_um"))
      return m.uncertainty = reader_.number(node, {0.001, 1000}) * (m.angular() ? 1e-6 : micro), true;
    return false;
  }

  std::size_t count(const YAML::Node& node, double least, double most) {
    const double value = reader_.number(node, {least, most});
    if (value != std::floor(value)) reader_.fail(node, reader_.text(node) + " is not a whole number");
    return static_cast<std::size_t>(value);
  }

  void laser(const YAML::Node& entry, Measurement& m) {
    if (!entry["error"]) reader_.fail(entry, "error is missing: EXX, EYX .. EBZ");
    const auto error = reader_.text(entry["error"]);
    const auto known = linear_axis_error(error);
    if (!known)
      reader_.fail(entry["error"], "'" + error + "': expected EXX, EYX .. ECZ: an error of X, Y or Z");
    m.name = "laser " + error;
    m.laser.component = known->component, m.laser.axis = known->axis;
    if (!laser_shows(*known, machine_.design.tool_direction.normalized()))
      reader_.fail(entry["error"], error + ": a rotation about the tool does not move the tool's axis");
    m.uncertainty = m.angular() ? 1e-6 : micro;
    const auto& travel = machine_.axes[known->axis];
    m.laser.from = travel.low, m.laser.to = travel.high;
    const Limits in_travel{travel.low, travel.high};
    reader_.each(
        entry,
        "instrument, error, from_mm, to_mm, at_mm, points, runs, reference, tool_length_mm, uncertainty_" +
            std::string(m.angular() ? "urad" : "um"),
        [&](const std::string& key, const YAML::Node& node) {
          if (key == "error") return true;
          if (key == "from_mm") return m.laser.from = reader_.number(node, in_travel), true;
          if (key == "to_mm") return m.laser.to = reader_.number(node, in_travel), true;
          if (key == "at_mm") return m.laser.others = reader_.vector(node, place), true;
          if (key == "points") return m.laser.targets = count(node, 3, 1000), true;
          if (key == "reference" && m.straightness()) {
            m.aligned = reader_.choice<bool>(node, {{"table", true}, {"free", false}});
            return true;
          }
          if (key == "runs") return m.laser.runs = count(node, 2, 100), true;
          return common(key, node, m);
        });
    if (!(m.laser.to > m.laser.from)) reader_.fail(entry, "from_mm must be below to_mm");
  }

  void ballbar(const YAML::Node& entry, Measurement& m) {
    m.ballbar.points = 120;
    m.name = "ballbar XY";
    reader_.each(entry, "instrument, plane, radius_mm, at_mm, points, tool_length_mm, uncertainty_um",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "plane") {
                     const auto plane = reader_.choice<std::pair<std::size_t, std::size_t>>(
                         node, {{"XY", {0, 1}}, {"XZ", {0, 2}}, {"YZ", {1, 2}}});
                     m.ballbar.first = plane.first, m.ballbar.second = plane.second;
                     m.name = "ballbar " + reader_.text(node);
                     return true;
                   }
                   if (key == "radius_mm") return m.ballbar.radius = reader_.number(node, {1, 1e4}), true;
                   if (key == "at_mm") return m.ballbar.centre = reader_.vector(node, place), true;
                   if (key == "points") {
                     m.ballbar.points = count(node, 16, 10000);
                     if (m.ballbar.points % 4 != 0)
                       reader_.fail(node, "the points of a circle must be a multiple of 4");
                     return true;
                   }
                   return common(key, node, m);
                 });
  }

  void nest(const YAML::Node& entry, Measurement& m) {
    if (!entry["axis"]) reader_.fail(entry, "axis is missing");
    const auto name = reader_.text(entry["axis"]);
    m.axis = name.size() == 1 ? axis_letters.find(name[0]) : std::string_view::npos;
    bool turns = false;
    const auto& d = machine_.design;
    for (const auto* side : {&d.table_2, &d.table_1, &d.table_0, &d.head_2, &d.head_1, &d.head_0})
      turns = turns || (*side && 3 + (*side)->angle == m.axis);
    if (!turns) reader_.fail(entry["axis"], "the machine has no rotary axis '" + name + "'");
    m.name = "rtest " + name;
    const Limits travel{machine_.axes[m.axis].low, machine_.axes[m.axis].high};
    reader_.each(entry, "instrument, axis, from_deg, to_deg, points, at_mm, tool_length_mm, uncertainty_um",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "axis") return true;
                   if (key == "from_deg") return m.from = reader_.number(node, travel), true;
                   if (key == "to_deg") return m.to = reader_.number(node, travel), true;
                   if (key == "points") return m.points = count(node, 4, 1000), true;
                   if (key == "at_mm") return m.centre = reader_.vector(node, place), true;
                   return common(key, node, m);
                 });
    if (!(m.to > m.from)) reader_.fail(entry, "from_deg must be below to_deg");
    if (machine_.axes[m.axis].way != canonical::RotaryWay::linear && std::abs(m.to - m.from - 360) > 1e-9)
      reader_.fail(entry, "axis " + name +
                              " counts modulo 360, so its table is that of a whole turn: to_deg must be " +
                              text::quantity(m.from + 360));
  }

  machine::YamlReader reader_;
  const machine::MachineOutline& machine_;
};

}  // namespace

std::optional<LinearAxisError> linear_axis_error(const std::string& name) {
  if (name.size() != 3 || name[0] != 'E') return std::nullopt;
  const auto component = axis_letters.find(name[1]), axis = axis_letters.find(name[2]);
  if (component > 5 || axis > 2) return std::nullopt;
  return LinearAxisError{component, axis};
}

bool laser_shows(const LinearAxisError& error, const truth::Vec3& tool_direction) {
  if (error.component < 3) return true;
  const truth::Vec3 about = truth::Vec3::Unit(static_cast<Eigen::Index>(error.component - 3));
  return about.cross(tool_direction).norm() >= 0.01;
}

MeasurementPlan parse_plan(const std::string& text, const std::string& file,
                           const machine::MachineOutline& machine) {
  return PlanReader(file, machine).read(machine::parse_yaml(text, file));
}

std::vector<double> readings(truth::PoseReport report, const Measurement& m,
                             const truth::InstrumentTruth& instrument) {
  report.tool_length = m.tool_length;
  std::vector<double> values;
  switch (m.kind) {
    case InstrumentKind::laser: {
      const auto measured = truth::measure_laser(report, m.laser, instrument);
      const auto add = [&](const std::vector<double>& runs) {
        double sum = 0;
        for (const double value : runs) sum += value;
        values.push_back(sum / static_cast<double>(runs.size()));
      };
      for (const auto& target : measured.targets) add(target.up);
      for (const auto& target : measured.targets) add(target.down);
      break;
    }
    case InstrumentKind::ballbar: {
      const auto measured = truth::measure_ballbar(report, m.ballbar, instrument);
      for (const auto* circle : {&measured.ccw, &measured.cw})
        for (const auto& reading : *circle) values.push_back(reading.deviation);
      break;
    }
    case InstrumentKind::nest:
      for (const auto& reading :
           truth::measure_nest(report, m.axis, m.from, m.to, m.points, m.centre, instrument, true))
        for (const double value : reading.deviation) values.push_back(value);
      break;
  }
  return values;
}

truth::InstrumentTruth instrument_of(const truth::Truth& truth, const Measurement& m) {
  const char* name = m.kind == InstrumentKind::ballbar ? "ballbar"
                     : m.kind == InstrumentKind::nest  ? "rtest"
                     : m.angular()                     ? "laser_angle"
                                                       : "laser";
  const auto found = truth.instruments.find(name);
  return found == truth.instruments.end() ? truth::InstrumentTruth{} : found->second;
}

}  // namespace trunnion::identification
