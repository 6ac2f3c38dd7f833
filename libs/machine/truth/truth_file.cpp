// SPDX-License-Identifier: Apache-2.0
#include "truth/truth_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "compensation/structure.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"
#include "truth/drive_section.hpp"
#include "truth/error_section.hpp"
#include "truth/probe_section.hpp"
#include "truth/random_drive.hpp"
#include "truth/random_machine.hpp"
#include "truth/units.hpp"

namespace trunnion::truth {
namespace {

constexpr machine::Limits place{-1e5, 1e5};         // mm
constexpr machine::Limits error_limits{-1e5, 1e5};  // um or urad: 100 mm, 0.1 rad
using canonical::axis_letters;

bool turns(const machine::MachineOutline& machine, std::size_t axis) {
  const auto& p = machine.design;
  for (const auto* side : {&p.table_2, &p.table_1, &p.table_0, &p.head_2, &p.head_1, &p.head_0})
    if (*side && 3 + (*side)->angle == axis) return true;
  return false;
}

// X, Y, Z and the axes that turn.
bool in_chain(const machine::MachineOutline& machine, std::size_t axis) {
  return axis < 3 || turns(machine, axis);
}

class TruthParser {
 public:
  TruthParser(const std::string& file, const machine::MachineOutline& machine)
      : reader_(file), machine_(machine) {}

  Truth parse(const YAML::Node& root) {
    if (root.IsNull()) return truth_;
    if (root.IsMap() && root["random"]) random(root["random"]);
    reader_.each(
        root, "structure, random, axes, spindle, beam, drives, spindle_drives, instruments, probe, solids",
        [&](const std::string& key, const YAML::Node& node) {
          if (key == "structure") return structure(node), true;
          if (key == "random") return true;
          if (key == "axes") return axes(node), true;
          if (key == "spindle") return spindle(node), true;
          if (key == "instruments") return instruments(node), true;
          if (key == "probe") return truth_.probe = read_probe(reader_, node), true;
          if (key == "solids") return truth_.solids = read_solids(reader_, node), true;
          if (key == "drives") return drives(node), true;
          if (key == "spindle_drives")
            return truth_.spindle_drives = read_spindle_drives(reader_, node, machine_.spindles), true;
          return key == "beam" && (beam(node), true);
        });
    check(root);
    return truth_;
  }

 private:
  GeometryTruth& geometry() { return truth_.geometry; }

  // Replaces drawn ones.
  void drives(const YAML::Node& node) {
    for (auto& [name, drive] : read_drives(reader_, node, machine_.drives, machine_.turning))
      truth_.drives[name] = std::move(drive);
  }

  void random(const YAML::Node& node) {
    std::string grade;
    double seed = 1;
    bool drives = false;
    reader_.each(node, "grade, seed, drives", [&](const std::string& key, const YAML::Node& value) {
      if (key == "grade") return grade = reader_.text(value), true;
      if (key == "drives")
        return drives = reader_.choice<bool>(value, {{"false", false}, {"true", true}}), true;
      return key == "seed" && (seed = reader_.number(value, {0, 4294967295.0}), true);
    });
    std::map<std::string, const Grade*> known;
    for (const Grade& g : grades()) known[g.name] = &g;
    if (!node["grade"]) reader_.fail(node, "'grade' is missing");
    const Grade& drawn = *reader_.choice(node["grade"], known);
    const auto number = static_cast<std::uint64_t>(seed);
    geometry() = draw_machine(drawn, number, machine_);
    if (!drives) return;
    truth_.drives = draw_drives(drawn, number, machine_);
    if (machine_.gantry) geometry().beam = draw_beam(drawn, number, machine_, *machine_.gantry);
  }

  std::size_t axis(const YAML::Node& node, const std::string& name) const {
    const auto found = name.size() == 1 ? axis_letters.find(name[0]) : std::string_view::npos;
    if (found == std::string_view::npos || !in_chain(machine_, found))
      reader_.fail(node, "the machine has no linear or rotary axis '" + name + "' in its kinematic chain");
    return found;
  }

  // [w C' A' b X Y Z (S) t], with or without the brackets.
  void structure(const YAML::Node& node) {
    auto structure = volumetric::parse_structure(reader_.text(node));
    if (const auto* refused = std::get_if<std::string>(&structure)) reader_.fail(node, *refused);
    geometry().structure = std::get<std::vector<StructureAxis>>(std::move(structure));
    for (const auto& word : geometry().structure)
      axis(node, std::string(1, canonical::axis_letters[word.axis]));
  }

  void axes(const YAML::Node& node) {
    reader_.each(node, "X, Y, Z and the rotary axes of the machine",
                 [&](const std::string& name, const YAML::Node& entry) {
                   const std::size_t index = axis(entry, name);
                   reader_.each(entry, keys_of(index), [&](const std::string& key, const YAML::Node& value) {
                     return axis_entry(index, key, value);
                   });
                   return true;
                 });
  }

  std::string keys_of(std::size_t index) const {
    const std::string a(1, axis_letters[index]);
    std::string keys = "reference_point_mm, thermal";
    for (const char component : {'X', 'Y', 'Z', 'A', 'B', 'C'})
      keys.append(", E").append(1, component).append(a);
    if (index == 1) keys += ", C0Y_urad";
    if (index == 2) keys += ", A0Z_urad, B0Z_urad";
    if (index > 2)
      for (const char component : {'X', 'Y', 'Z', 'A', 'B', 'C'})
        keys.append(", ")
            .append(1, component)
            .append("O")
            .append(a)
            .append(component > 'W' ? "_um" : "_urad");
    return keys;
  }

  bool axis_entry(std::size_t index, const std::string& key, const YAML::Node& value) {
    AxisTruth& out = geometry().axes[index];
    if (key == "reference_point_mm") return out.reference_point = reader_.vector(value, place), true;
    if (key == "thermal") return thermal(index, value), true;
    if (key.size() == 3 && key[0] == 'E' && key[2] == axis_letters[index]) {
      const auto component = std::string_view("XYZABC").find(key[1]);
      if (component == std::string_view::npos) return false;
      for (auto& error : read_errors(
               reader_, value, index, component,
               [&](const YAML::Node&n, const std::string&name) { return axis(n, name); },
               [&](std::size_t i) { return turns(machine_, i); }))
        out.errors.push_back(std::move(error));
      return true;
    }
    return key.size() > 3 && key[2] == axis_letters[index] && location(key, value);
  }

  // Replaces a drawn one.
  bool location(const std::string& key, const YAML::Node& value) {
    const auto found = location_error(geometry(), machine_, key.substr(0, 3));
    if (!found || key.substr(3) != (found->angle ? "_urad" : "_um")) return false;
    *found->value = reader_.number(value, error_limits) * (found->angle ? urad : um);
    return true;
  }

  void spindle(const YAML::Node& node) {
    reader_.each(node, "XOS_um, YOS_um, ZOS_um, AOS_urad, BOS_urad, thermal",
                 [&](const std::string& key, const YAML::Node& value) {
                   if (key == "thermal") return thermal(spindle_source, value), true;
                   return key.size() > 3 && key[2] == 'S' && location(key, value);
                 });
  }

  void thermal(std::size_t source, const YAML::Node& node) {
    HeatSource& heat = geometry().heat[source];
    const bool linear = source < 3;
    // In K per mm/s, deg/s, 1/min.
    const std::string rise = linear                     ? "rise_K_per_m_per_min"
                             : source == spindle_source ? "rise_K_per_1000_rpm"
                                                        : "rise_K_per_rpm";
    const double unit = linear ? 0.06 : source == spindle_source ? 1e-3 : 1 / 6.0;
    reader_.each(node,
                 rise + ", ambient_K, time_constant_s, shift_um_per_K, tilt_urad_per_K" +
                     (linear ? ", expansion_um_per_m_K, fixed_point_mm" : ""),
                 [&](const std::string& key, const YAML::Node& v) {
                   const machine::Limits effect{-1e3, 1e3};
                   if (key == rise) return heat.rise_per_speed = unit * reader_.number(v, {0, 1e3}), true;
                   if (key == "ambient_K") return heat.constant_rise = reader_.number(v, {-50, 50}), true;
                   if (key == "time_constant_s")
                     return heat.time_constant = reader_.number(v, {1, 1e6}), true;
                   if (key == "shift_um_per_K") return heat.shift = um * reader_.vector(v, effect), true;
                   if (key == "tilt_urad_per_K") return heat.tilt = urad * reader_.vector(v, effect), true;
                   if (linear && key == "expansion_um_per_m_K")
                     return heat.expansion = 1e-6 * reader_.number(v, {-100, 100}), true;
                   return linear && key == "fixed_point_mm" &&
                          (heat.fixed_point = reader_.number(v, place), true);
                 });
  }

  void beam(const YAML::Node& node) {
    BeamTruth beam;
    bool slave = false;
    reader_.each(node,
                 "axis, master_foot_mm, slave_foot_mm, misalignment_um, slave_error, racking_frequency_Hz, "
                 "racking_damping_ratio",
                 [&](const std::string& key, const YAML::Node& v) {
                   if (key == "axis") return beam.axis = axis(v, reader_.text(v)), true;
                   if (key == "master_foot_mm") return beam.master_foot = reader_.vector(v, place), true;
                   if (key == "slave_foot_mm")
                     return beam.slave_foot = reader_.vector(v, place), slave = true, true;
                   if (key == "misalignment_um")
                     return beam.misalignment = um * reader_.number(v, error_limits), true;
                   if (key == "racking_frequency_Hz")
                     return beam.racking_frequency = reader_.number(v, {1, 300}), true;
                   if (key == "racking_damping_ratio")
                     return beam.racking_damping = reader_.number(v, {0, 1}), true;
                   return key == "slave_error";
                 });
    if (beam.axis > 2) reader_.fail(node, "the axis of a beam is X, Y or Z");
    if (!slave) reader_.fail(node, "'slave_foot_mm' is missing");
    if (node["slave_error"])
      for (auto& error : read_errors(
               reader_, node["slave_error"], beam.axis, 0,
               [&](const YAML::Node&n, const std::string&) -> std::size_t {
                 reader_.fail(n, "the slave's error is one by the position of its axis");
               },
               [](std::size_t) { return false; }))
        beam.slave_error = std::move(error.function);
    geometry().beam = beam;
  }

  void instruments(const YAML::Node& node) {
    reader_.each(
        node, "ballbar, laser, laser_angle, rtest", [&](const std::string& name, const YAML::Node& entry) {
          const bool angle = name == "laser_angle";
          if (!angle && name != "ballbar" && name != "laser" && name != "rtest") return false;
          const std::string noise = angle ? "noise_urad" : "noise_um",
                            resolution = angle ? "resolution_urad" : "resolution_um";
          const double unit = angle ? urad : um;
          InstrumentTruth& out = truth_.instruments[name];
          reader_.each(
              entry, noise + ", " + resolution + ", seed", [&](const std::string& key, const YAML::Node& v) {
                if (key == noise) return out.noise = unit * reader_.number(v, {0, 1e3}), true;
                if (key == resolution) return out.resolution = unit * reader_.number(v, {0, 1e3}), true;
                return key == "seed" &&
                       (out.seed = static_cast<std::uint64_t>(reader_.number(v, {0, 4294967295.0})), true);
              });
          return true;
        });
  }

  void check(const YAML::Node& root) {
    const auto made = TrueGeometry::make(machine_.design, geometry());
    if (const auto* refused = std::get_if<std::string>(&made))
      reader_.fail(root["structure"] ? root["structure"] : root["beam"] ? root["beam"] : root, *refused);
  }

  machine::YamlReader reader_;
  const machine::MachineOutline& machine_;
  Truth truth_;
};

}  // namespace

std::optional<LocationError> location_error(GeometryTruth& truth, const machine::MachineOutline& machine,
                                            const std::string& name) {
  if (name.size() != 3 || (name[1] != '0' && name[1] != 'O')) return std::nullopt;
  const auto component = std::string_view("XYZABC").find(name[0]);
  if (component == std::string_view::npos) return std::nullopt;
  const auto part = static_cast<Eigen::Index>(component % 3);
  AxisTruth* axis = nullptr;
  if (name[2] == 'S' && component < 5) {
    axis = &truth.spindle;
  } else {
    const auto index = axis_letters.find(name[2]);
    if (index == std::string_view::npos || !in_chain(machine, index)) return std::nullopt;
    // The other directions of X, Y and Z define the machine's frame.
    if (index < 3 && name.front() != 'C' && name[2] == 'Y') return std::nullopt;
    if (index < 3 && !(name[2] == 'Y' || (name[2] == 'Z' && (name[0] == 'A' || name[0] == 'B'))))
      return std::nullopt;
    axis = &truth.axes[index];
  }
  return LocationError{component < 3 ? &axis->displacement[part] : &axis->inclination[part], component > 2};
}

TrueGeometry make_geometry(const GeometryTruth& truth, const machine::MachineOutline& machine,
                           const std::string& file) {
  auto made = TrueGeometry::make(machine.design, truth);
  if (const auto* refused = std::get_if<std::string>(&made))
    throw std::runtime_error(file + ": error: " + *refused);
  return std::get<TrueGeometry>(std::move(made));
}

Truth parse_truth(const std::string& text, const std::string& file, const machine::MachineOutline& machine) {
  const auto root = machine::parse_yaml(text, file);
  return TruthParser(file, machine).parse(root);
}

}  // namespace trunnion::truth
