// SPDX-License-Identifier: Apache-2.0
#include "truth/drive_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "truth/error_section.hpp"

namespace trunnion::truth {
namespace {

constexpr double highest_frequency = 500;  // Hz: beyond it the steps of the simulation are too long

class DriveParser {
 public:
  DriveParser(const machine::YamlReader& reader, bool turns)
      : reader_(reader), turns_(turns), place_(turns ? "_deg" : "_mm"), fine_(turns ? "_urad" : "_um") {
    small_ = turns ? 1e-6 * 180 / std::numbers::pi : 1e-3;
  }

  DriveTruth read(const YAML::Node& node) {
    DriveTruth drive;
    reader_.each(node, "mechanics, motor_encoder, load_encoder, fault",
                 [&](const std::string& key, const YAML::Node& v) {
                   if (key == "mechanics") return drive.mechanics = mechanics(v), true;
                   if (key == "motor_encoder") return drive.motor = encoder(v), true;
                   if (key == "load_encoder") return drive.load = encoder(v), true;
                   return key == "fault" && (drive.fault = fault(v), true);
                 });
    return drive;
  }

 private:
  using Targets = std::initializer_list<std::tuple<std::string, double*, machine::Limits, double>>;
  bool number(const Targets& targets, const std::string& key, const YAML::Node& node) const {
    for (const auto& [name, target, limits, unit] : targets)
      if (name == key) return *target = unit * reader_.number(node, limits), true;
    return false;
  }
  static std::string names(const Targets& targets, std::string text) {
    for (const auto& target : targets) text.append(text.empty() ? "" : ", ").append(std::get<0>(target));
    return text;
  }

  MechanicsTruth mechanics(const YAML::Node& node) const {
    MechanicsTruth m;
    const std::string per_speed = turns_ ? "_deg_per_s" : "_mm_per_s";
    const machine::Limits share{0, 10};
    const Targets targets{{"load_share", &m.load_share, {0.02, 0.98}, 1},
                          {"locked_frequency_Hz", &m.locked_frequency, {1, highest_frequency}, 1},
                          {"damping_ratio", &m.damping_ratio, {0, 1}, 1},
                          {"coulomb", &m.coulomb, share, 1},
                          {"breakaway", &m.breakaway, share, 1},
                          {"stribeck_speed" + per_speed, &m.stribeck_speed, {0.01, 1e4}, 1},
                          {"viscous_per" + per_speed, &m.viscous, {0, 1}, 1},
                          {"backlash" + fine_, &m.backlash, {0, 1e5}, small_},
                          {"gravity", &m.gravity, {-10, 10}, 1},
                          {"cogging", &m.cogging, share, 1},
                          {"cogging_period" + place_, &m.cogging_period, {1e-3, 1e5}, 1},
                          {"cogging_phase_deg", &m.cogging_phase, {-360, 360}, 1}};
    const std::string screw = "screw_error";
    reader_.each(node, names(targets, screw), [&](const std::string& key, const YAML::Node& v) {
      if (key == screw) return m.screw = terms(v), true;
      return number(targets, key, v);
    });
    const double resonance = m.locked_frequency / std::sqrt(1 - m.load_share);
    if (resonance > highest_frequency)
      reader_.fail(node,
                   fmt::format("the resonance locked_frequency_Hz / sqrt(1 - load_share) is {:.0f} Hz, above "
                               "{:.0f} Hz",
                               resonance, highest_frequency));
    if (node["breakaway"] && m.breakaway < m.coulomb)
      reader_.fail(node["breakaway"], "breakaway is less than coulomb");
    return m;
  }

  // Values of rotary axes in urad become deg.
  ErrorFunction terms(const YAML::Node& node) const {
    auto errors = read_errors(
        reader_, node, turns_ ? 3 : 0, turns_ ? 3 : 0,
        [&](const YAML::Node& n, const std::string&) -> std::size_t {
          reader_.fail(n, "the error of a screw is one by the position of its motor");
        },
        [&](std::size_t) { return turns_; });
    ErrorFunction f = std::move(errors.front().function);
    if (turns_) {
      const double degrees = 180 / std::numbers::pi;
      for (auto* t : {&f.terms, &f.positive, &f.negative}) {
        for (auto& p : t->polynomials)
          for (double& c : p.coefficients) c *= degrees;
        for (auto& h : t->harmonics) h.amplitude *= degrees;
        for (auto& table : t->tables)
          for (double& value : table.values) value *= degrees;
      }
      f.reversal *= degrees;
    }
    return f;
  }

  EncoderTruth encoder(const YAML::Node& node) const {
    EncoderTruth e;
    double lost = 0;
    const Targets targets{{"resolution" + fine_, &e.resolution, {1e-5, 1e4}, small_},
                          {"signal_period" + fine_, &e.signal_period, {0, 1e6}, small_},
                          {"amplitude_error", &e.amplitude, {-0.5, 0.5}, 1},
                          {"sine_offset", &e.sine_offset, {-0.5, 0.5}, 1},
                          {"cosine_offset", &e.cosine_offset, {-0.5, 0.5}, 1},
                          {"phase_error_deg", &e.phase, {-45, 45}, 1},
                          {"mark_spacing" + place_, &e.mark_spacing, {0.01, 1e4}, 1},
                          {"mark_increment" + place_, &e.mark_increment, {1e-3, 100}, 1},
                          {"first_mark" + place_, &e.first_mark, {-1e5, 1e5}, 1},
                          {"lost_at" + place_, &e.lost_at, {-1e5, 1e5}, 1},
                          {"lost_counts", &lost, {-1e6, 1e6}, 1}};
    reader_.each(node, names(targets, "kind, inverted"), [&](const std::string& key, const YAML::Node& v) {
      if (key == "kind")
        return e.kind = reader_.choice<EncoderKind>(v, {{"absolute", EncoderKind::absolute},
                                                        {"incremental", EncoderKind::incremental},
                                                        {"distance_coded", EncoderKind::distance_coded}}),
               true;
      if (key == "inverted")
        return e.inverted = reader_.choice<bool>(v, {{"false", false}, {"true", true}}), true;
      return number(targets, key, v);
    });
    e.lost_counts = static_cast<std::int32_t>(lost);
    if (e.kind == EncoderKind::distance_coded && e.mark_increment * 4 > e.mark_spacing)
      reader_.fail(node, "the increment of distance-coded marks must be at most a quarter of their spacing");
    return e;
  }

  DriveFaultTruth fault(const YAML::Node& node) const {
    DriveFaultTruth f;
    using Kind = DriveFaultKind;
    bool kind = false, at = false;
    reader_.each(node, "kind, at" + place_, [&](const std::string& key, const YAML::Node& v) {
      if (key == "kind")
        return f.kind = reader_.choice<Kind>(v, {{"power_module", Kind::power_module},
                                                 {"overcurrent", Kind::overcurrent},
                                                 {"overvoltage", Kind::overvoltage},
                                                 {"following_error", Kind::following_error},
                                                 {"overspeed", Kind::overspeed},
                                                 {"overload", Kind::overload},
                                                 {"locked_rotor", Kind::locked_rotor},
                                                 {"bus", Kind::bus}}),
               kind = true;
      return key == "at" + place_ && (f.at = reader_.number(v, {-1e5, 1e5}), at = true);
    });
    if (!kind || !at) reader_.fail(node, std::string("'") + (kind ? "at" + place_ : "kind") + "' is missing");
    return f;
  }

  const machine::YamlReader& reader_;
  bool turns_;
  std::string place_, fine_;
  double small_ = 1e-3;
};

void read_torque_curve(const machine::YamlReader& reader, const YAML::Node& node, SpindleTruth& spindle) {
  if (!node.IsSequence() || node.size() == 0 || node.size() > 32)
    reader.fail(
        node, "expected 1 to 32 points [1/min, Nm] of the torque curve, for example [[0, 100], [6000, 25]]");
  for (const auto& point : node) {
    if (!point.IsSequence() || point.size() != 2)
      reader.fail(point, "expected a point [1/min, Nm] of the torque curve");
    const SpindleTruth::Point p{reader.number(point[0], {0, 1e6}), reader.number(point[1], {1e-6, 1e6})};
    if (!spindle.torque.empty() && p.speed <= spindle.torque.back().speed)
      reader.fail(point, "the speeds of the torque curve must rise");
    spindle.torque.push_back(p);
  }
}

void read_ripple(const machine::YamlReader& reader, const YAML::Node& node, SpindleTruth& spindle) {
  reader.each(node, "share, hz", [&](const std::string& key, const YAML::Node& v) {
    if (key == "share") return spindle.ripple = reader.number(v, {0, 0.5}), true;
    return key == "hz" && (spindle.ripple_frequency = reader.number(v, {1e-3, 500}), true);
  });
  for (const char* const key : {"share", "hz"})
    if (!node[key]) reader.fail(node, std::string("'") + key + "' is missing");
}

void read_gears(const machine::YamlReader& reader, const YAML::Node& node, SpindleTruth& spindle) {
  if (!node.IsSequence() || node.size() == 0 || node.size() > 5)
    reader.fail(node, "expected 1 to 5 gears, for example [{ratio: 4}, {ratio: 1}]");
  for (const auto& gear : node) {
    reader.each(gear, "ratio", [&](const std::string& key, const YAML::Node& v) {
      return key == "ratio" && (spindle.gears.push_back(reader.number(v, {1e-3, 1e3})), true);
    });
    if (!gear["ratio"]) reader.fail(gear, "'ratio' is missing");
  }
}

SpindleTruth read_spindle_drive(const machine::YamlReader& reader, const YAML::Node& node) {
  SpindleTruth spindle;
  reader.each(node, "inertia_kg_m2, torque_Nm, speed_error, disturbance, load_torque_Nm, gears, mark_deg",
              [&](const std::string& key, const YAML::Node& v) {
                if (key == "inertia_kg_m2") return spindle.inertia = reader.number(v, {1e-6, 1e4}), true;
                if (key == "torque_Nm") return read_torque_curve(reader, v, spindle), true;
                if (key == "speed_error") return spindle.speed_error = reader.number(v, {-0.5, 0.5}), true;
                if (key == "disturbance") return read_ripple(reader, v, spindle), true;
                if (key == "load_torque_Nm") return spindle.load_torque = reader.number(v, {0, 1e6}), true;
                if (key == "gears") return read_gears(reader, v, spindle), true;
                return key == "mark_deg" && (spindle.mark = reader.number(v, {0, 360}), true);
              });
  bool motor = false;
  for (const char* const key : {"inertia_kg_m2", "torque_Nm", "load_torque_Nm", "gears"})
    motor = motor || node[key];
  for (const char* const key : {"inertia_kg_m2", "torque_Nm"})
    if (motor && !node[key]) reader.fail(node, std::string("'") + key + "' is missing");
  return spindle;
}

// An entry for each of `names`.
template <class Read>
auto read_named(const machine::YamlReader& reader, const YAML::Node& section,
                const std::vector<std::string>& names, Read&& read) {
  std::string known;
  for (const auto& name : names) known.append(known.empty() ? "" : ", ").append(name);
  std::map<std::string, decltype(read(std::string(), section))> all;
  reader.each(section, known, [&](const std::string& name, const YAML::Node& node) {
    return std::find(names.begin(), names.end(), name) != names.end() &&
           (all.insert_or_assign(name, read(name, node)), true);
  });
  return all;
}

}  // namespace

double SpindleTruth::torque_at(double speed, std::size_t gear) const {
  if (gear >= 1 && gear <= gears.size()) {
    const double ratio = gears[gear - 1];
    return ratio * torque_at(ratio * speed);
  }
  const double at = std::abs(speed);
  if (at <= torque.front().speed) return torque.front().torque;
  for (std::size_t i = 1; i < torque.size(); ++i) {
    const auto &low = torque[i - 1], &high = torque[i];
    if (at <= high.speed)
      return low.torque + (high.torque - low.torque) * (at - low.speed) / (high.speed - low.speed);
  }
  return torque.back().torque;
}

std::map<std::string, DriveTruth> read_drives(const machine::YamlReader& reader, const YAML::Node& section,
                                              const std::vector<std::string>& axes,
                                              const std::vector<std::string>& turning) {
  return read_named(reader, section, axes, [&](const std::string& name, const YAML::Node& node) {
    return DriveParser(reader, std::find(turning.begin(), turning.end(), name) != turning.end()).read(node);
  });
}

std::map<std::string, SpindleTruth> read_spindle_drives(const machine::YamlReader& reader,
                                                        const YAML::Node& section,
                                                        const std::vector<std::string>& names) {
  return read_named(reader, section, names, [&](const std::string&, const YAML::Node& node) {
    return read_spindle_drive(reader, node);
  });
}

}  // namespace trunnion::truth
