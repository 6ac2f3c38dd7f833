// SPDX-License-Identifier: Apache-2.0
#include "calibration/manual_calibration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "geometry/angle.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::calibration {

extern const char* const manual_steps_text;
extern const char* const manual_steps_german_text;
extern const char* const manual_steps_chinese_text;

namespace {

constexpr std::array names{"ac-table", "bc-head", "ac-head", "hybrid"};

ManualGuide read_guide(const YAML::Node& node) {
  ManualGuide guide;
  guide.title = node["title"].as<std::string>();
  for (const auto& check : node["checks"]) guide.checks.push_back(check.as<std::string>());
  for (const auto& step : node["steps"]) {
    auto& out = guide.steps.emplace_back();
    out.at = step["at"].as<std::string>();
    out.use = step["use"].as<std::string>();
    out.action = step["do"].as<std::string>();
    for (const auto& reading : step["read"])
      out.readings.emplace_back(reading.first.as<std::string>(), reading.second.as<std::string>());
  }
  for (const auto& value : node["values"])
    guide.values.emplace_back(value.first.as<std::string>(), value.second.as<std::string>());
  for (const auto& name : node["optional"]) guide.optional.push_back(name.as<std::string>());
  return guide;
}

bool is(const std::optional<geometry::RotaryAxis>& axis, std::size_t angle, const Vec3& direction) {
  return axis && axis->angle == angle && axis->direction.normalized().dot(direction) > std::cos(M_PI / 180);
}

double sine(double degrees) { return geometry::sine_cosine(degrees).sine; }

machine::Limits limits_of(const std::string& name) {
  if (name == "alpha") return {5, 90};
  if (name == "tool_radius" || name == "arbor_diameter") return {1e-3, 1000};
  return {-1e5, 1e5};
}

}  // namespace

const char* to_string(ManualKind kind) { return names[static_cast<std::size_t>(kind)]; }

std::optional<ManualKind> manual_kind(const ChainParameters& p) {
  constexpr std::size_t a = 0, b = 1, c = 2;
  const bool two = !p.table_0 && !p.head_0;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  if (two && is(p.table_1, a, -x) && is(p.table_2, c, -z) && !p.head_2) return ManualKind::ac_table;
  if (two && is(p.head_1, c, z) && is(p.head_2, b, y) && !p.table_2) return ManualKind::bc_head;
  if (two && is(p.head_1, c, z) && is(p.head_2, a, x) && !p.table_2) return ManualKind::ac_head;
  if (two && is(p.head_2, b, y) && !p.head_1 && is(p.table_2, c, -z) && !p.table_1) return ManualKind::hybrid;
  return std::nullopt;
}

const ManualGuide& guide_of(ManualKind kind, GuideLanguage language) {
  static const auto guides = [] {
    std::array<std::vector<ManualGuide>, 3> all;  // by language
    const std::array texts{manual_steps_text, manual_steps_german_text, manual_steps_chinese_text};
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const auto root = machine::parse_yaml(texts[i], "manual_steps.yaml");
      for (const char* name : names) all[i].push_back(read_guide(root[name]));
    }
    return all;
  }();
  return guides[static_cast<std::size_t>(language)][static_cast<std::size_t>(kind)];
}

Readings parse_readings(const std::string& text, const std::string& file, ManualKind kind) {
  const auto& guide = guide_of(kind);
  std::vector<std::string> known;
  for (const auto& step : guide.steps)
    for (const auto& [name, about] : step.readings) known.push_back(name);
  for (const auto& [name, about] : guide.values) known.push_back(name);
  std::string all;
  for (const auto& name : known) {
    if (!all.empty()) all += ", ";
    all += name;
  }
  const machine::YamlReader reader(file);
  Readings readings;
  const auto root = machine::parse_yaml(text, file);
  reader.each(root, all, [&](const std::string& key, const YAML::Node& node) {
    if (std::find(known.begin(), known.end(), key) == known.end()) return false;
    readings[key] = reader.number(node, limits_of(key));
    return true;
  });
  for (const auto& name : known)
    if (!readings.contains(name) &&
        std::find(guide.optional.begin(), guide.optional.end(), name) == guide.optional.end())
      reader.fail(root, std::string(name).append(" is missing; the readings are ").append(all));
  return readings;
}

ChainParameters chain_of_readings(ManualKind kind, const Readings& r, ChainParameters chain) {
  for (const auto slot : metrology::all_slots)
    if (auto& axis = axis_at(chain, slot)) axis->correction.setZero();
  const auto centre = [&] { return Vec3((r.at("x1") + r.at("x2")) / 2, (r.at("y1") + r.at("y2")) / 2, 0); };
  switch (kind) {
    case ManualKind::ac_table: {
      const double alpha = r.contains("alpha") ? r.at("alpha") : 90;
      const double offset = r.at("offy_z1") / (2 * sine(alpha));
      const double height = r.at("zc_y1") - offset + r.at("tool_radius"), length = -r.at("zc_z2");
      chain.table_1->offset = {0, offset, 0};
      chain.table_2->offset = centre() + Vec3(0, 0, r.at("zc_z1") + height - length);
      break;
    }
    case ManualKind::bc_head: {
      const double x = r.at("b_z1") / 2;
      chain.head_2->offset = {x, 0, -(r.at("length_z1") - r.at("arbor_diameter") / 2) - x};
      chain.head_1->offset = {-r.at("c_x1") / 2 - x, -r.at("c_y1") / 2, 0};
      break;
    }
    case ManualKind::ac_head: {
      const double y = -r.at("a_z1") / 2;
      chain.head_2->offset = {0, y, -(r.at("length_z1") - r.at("arbor_diameter") / 2) + y};
      chain.head_1->offset = {-r.at("c_x1") / 2, -r.at("c_y1") / 2 - y, 0};
      break;
    }
    case ManualKind::hybrid: {
      const double x = r.at("b_z1") / 2;
      chain.head_2->offset = {x, 0, -(r.at("length_z1") - r.at("arbor_diameter") / 2) - x};
      chain.table_2->offset = centre();
      break;
    }
  }
  return chain;
}

std::vector<Angles> check_poses(ManualKind kind, double alpha) {
  std::vector<Angles> poses;
  for (const double c : {0, 90, 180, 270}) poses.push_back({0, 0, c});
  const std::size_t swivel = kind == ManualKind::ac_table || kind == ManualKind::ac_head ? 0 : 1;
  const auto angles = kind == ManualKind::ac_table ? std::array<double, 5>{0, alpha, -alpha, -90, 0}
                                                   : std::array<double, 5>{0, 45, 90, -45, -90};
  for (const double angle : angles) {
    Angles pose{};
    pose[swivel] = angle;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<Vec3> parse_displacements(const std::string& text, const std::string& file) {
  std::vector<Vec3> displacements;
  std::size_t number = 0;
  const auto fail = [&](std::size_t column, const std::string& what) {
    throw std::runtime_error(file + ":" + std::to_string(number) + ":" + std::to_string(column + 1) +
                             ": error: " + what);
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, std::min(text.find('#', at), end) - at);
    at = end + 1, ++number;
    std::vector<double> values;
    for (std::size_t i = line.find_first_not_of(" \t\r"); i != line.npos;) {
      const std::size_t stop = std::min(line.find_first_of(" \t\r", i), line.size());
      double value = 0;
      const char* first = line.data() + i + (line[i] == '+' ? 1 : 0);
      const auto [last, error] = std::from_chars(first, line.data() + stop, value);
      if (error != std::errc() || last != line.data() + stop || !(std::abs(value) <= 100))
        fail(i, "'" + line.substr(i, stop - i) + "' is not a displacement within -100 .. 100 mm");
      values.push_back(value);
      i = line.find_first_not_of(" \t\r", stop);
    }
    if (values.empty()) continue;
    if (values.size() != 3) fail(0, "expected x y z in mm");
    if (displacements.size() == 9) fail(0, "more than the nine poses of the check");
    displacements.emplace_back(values[0], values[1], values[2]);
  }
  if (displacements.size() != 9)
    fail(0, std::to_string(displacements.size()) + " displacements, the check has nine poses");
  return displacements;
}

ChainParameters corrected(ManualKind kind, const std::vector<Vec3>& d, double alpha, ChainParameters chain) {
  const double x = (d[2] - d[0]).x() / 2, y = -(d[3] - d[1]).x() / 2;  // of the axis of C
  switch (kind) {
    case ManualKind::ac_table: {
      // The swing shows A where it is: C's own correction has moved it already.
      const double a = (d[6] - d[5]).z() / (2 * sine(alpha));
      chain.table_2->offset += Vec3(x, y, (d[7] - d[4]).z() - a);
      chain.table_1->offset.y() += a - y;
      break;
    }
    case ManualKind::bc_head: {
      const double spindle = -(d[8] - d[6]).z() / 2;
      chain.head_2->offset += Vec3(spindle, 0, (d[6] - d[4]).z() - spindle);
      chain.head_1->offset += Vec3(x - spindle, y, 0);
      break;
    }
    case ManualKind::ac_head: {
      const double spindle = (d[8] - d[6]).z() / 2;
      chain.head_2->offset += Vec3(0, spindle, (d[6] - d[4]).z() + spindle);
      chain.head_1->offset += Vec3(x, y - spindle, 0);
      break;
    }
    case ManualKind::hybrid: {
      const double spindle = -(d[8] - d[6]).z() / 2;
      chain.head_2->offset += Vec3(spindle, 0, (d[6] - d[4]).z() - spindle);
      chain.table_2->offset += Vec3(x, y, 0);
      break;
    }
  }
  return chain;
}

double largest_deviation(const std::vector<double>& readings) {
  double largest = 0;
  for (const double value : readings) largest = std::max(largest, std::abs(value - readings.front()));
  return largest;
}

bool Acceptance::accepted() const {
  return std::all_of(lines.begin(), lines.end(), [](const Line& l) { return l.value <= l.limit; });
}

Acceptance acceptance_of(ManualKind kind, const std::vector<Vec3>& d) {
  Acceptance acceptance;
  const std::string swivel = kind == ManualKind::ac_table || kind == ManualKind::ac_head ? "A" : "B";
  for (int component = 0; component < 3; ++component) {
    const std::string name(1, "XYZ"[component]);
    const auto over = [&](std::size_t first, std::size_t last) {
      std::vector<double> series;
      for (std::size_t i = first; i <= last; ++i) series.push_back(d[i][component]);
      return largest_deviation(series);
    };
    acceptance.lines.push_back({name + " over C", over(0, 3), 0.02});
    acceptance.lines.push_back({std::string(name).append(" over ").append(swivel), over(4, 8), 0.02});
  }
  if (kind == ManualKind::ac_table) {
    acceptance.lines.push_back({"Z between +alpha and -alpha (OFFY)", std::abs((d[6] - d[5]).z()), 0.01});
    acceptance.lines.push_back({"Z between A0 and A-90 (Zc)", std::abs((d[7] - d[4]).z()), 0.01});
  }
  return acceptance;
}

}  // namespace trunnion::calibration
