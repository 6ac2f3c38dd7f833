// SPDX-License-Identifier: Apache-2.0
#include "core/manual_calibration_document.hpp"

#include "calibration/chain_change.hpp"
#include "calibration/measurement_poses.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using calibration::ChainParameters;
using calibration::Vec3;

constexpr double least_alpha = 5, most_alpha = 90, usual_alpha = 30;  // deg
constexpr double most_displacement = 100;                             // mm

Json named(const std::vector<std::pair<std::string, std::string>>& values) {
  auto rows = Json::array();
  for (const auto& [name, about] : values) rows.push_back({{"name", name}, {"about", about}});
  return rows;
}

Json vectors_of(const ChainParameters& chain) {
  auto rows = Json::array();
  for (const auto slot : metrology::all_slots)
    if (const auto& axis = axis_at(chain, slot)) {
      const Vec3 offset = axis->offset + axis->correction;
      rows.push_back({{"axis", std::string(1, "ABCUVW"[axis->angle])},
                      {"offset_mm", {offset.x(), offset.y(), offset.z()}}});
    }
  return rows;
}

calibration::Readings readings_of(const Json& body, calibration::ManualKind kind) {
  if (!body.is_object()) throw BadRequest("readings", "readings must be an object of names and numbers");
  for (const auto& [name, value] : body.items())
    if (!value.is_number()) throw BadRequest("readings", "reading " + name + " must be a number");
  try {
    return calibration::parse_readings(body.dump(), "readings", kind);  // JSON is YAML
  } catch (const std::exception& error) {
    throw BadRequest("readings", error.what());
  }
}

std::vector<Vec3> displacements_of(const Json& rows) {
  const std::string expected = "displacements must be nine of [x, y, z] in mm";
  if (!rows.is_array() || rows.size() != 9) throw BadRequest("displacements", expected);
  std::vector<Vec3> displacements;
  for (const auto& row : rows) {
    if (!row.is_array() || row.size() != 3) throw BadRequest("displacements", expected);
    auto& value = displacements.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      value[static_cast<Eigen::Index>(i)] =
          commands::number(row[i], "displacements", -most_displacement, most_displacement);
  }
  return displacements;
}

}  // namespace

calibration::GuideLanguage guide_language(const std::string& name) {
  if (name.empty() || name == "en") return calibration::GuideLanguage::english;
  if (name == "de") return calibration::GuideLanguage::german;
  if (name == "zh") return calibration::GuideLanguage::chinese;
  throw BadRequest("language", "language must be en, de or zh");
}

Json guide_document(calibration::ManualKind kind, calibration::GuideLanguage language, double alpha,
                    const ChainParameters& chain) {
  const auto& guide = calibration::guide_of(kind, language);
  auto steps = Json::array();
  for (const auto& step : guide.steps)
    steps.push_back(
        {{"at", step.at}, {"use", step.use}, {"do", step.action}, {"readings", named(step.readings)}});
  auto poses = Json::array();
  for (const auto& pose : calibration::check_poses(kind, alpha))
    poses.push_back(calibration::pose_name(pose, chain));
  return {{"kind", calibration::to_string(kind)},
          {"title", guide.title},
          {"checks", guide.checks},
          {"steps", std::move(steps)},
          {"values", named(guide.values)},
          {"optional", guide.optional},
          {"poses", std::move(poses)},
          {"vectors", vectors_of(chain)}};
}

ManualEvaluation evaluate_manual(const Json& body, calibration::ManualKind kind, const ChainParameters& chain,
                                 std::uint16_t channel) {
  commands::only(body, {"channel", "readings", "displacements", "alpha"});
  if (body.contains("readings") == body.contains("displacements"))
    throw BadRequest("readings", "give readings or displacements");
  const double alpha = body.contains("alpha")
                           ? commands::number(body["alpha"], "alpha", least_alpha, most_alpha)
                           : usual_alpha;
  auto after = chain;
  ManualEvaluation result;
  if (body.contains("readings")) {
    after = calibration::chain_of_readings(kind, readings_of(body["readings"], kind), chain);
  } else {
    const auto displacements = displacements_of(body["displacements"]);
    const auto acceptance = calibration::acceptance_of(kind, displacements);
    if (!acceptance.accepted()) after = calibration::corrected(kind, displacements, alpha, chain);
    result.document["accepted"] = acceptance.accepted();
    auto& lines = result.document["acceptance"] = Json::array();
    for (const auto& line : acceptance.lines)
      lines.push_back({{"name", line.name}, {"value_mm", line.value}, {"limit_mm", line.limit}});
  }
  result.values = calibration::changed_parameters(chain, after, channel);
  result.document["before"] = vectors_of(chain);
  result.document["after"] = vectors_of(after);
  auto& changes = result.document["changes"] = Json::array();
  for (const auto& [number, value] : result.values)
    changes.push_back({{"number", number},
                       {"name", machine::Catalogue::instance().find(number)->name},
                       {"after", value.value}});
  return result;
}

}  // namespace trunnion::gateway
