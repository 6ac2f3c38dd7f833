// SPDX-License-Identifier: Apache-2.0
#include "collision/bodies_file.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "compensation/structure.hpp"
#include "geometry/angle.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::collision {
namespace {

using machine::Limits;

constexpr Limits place{-1e5, 1e5}, angle{-360, 360}, size{0.01, 1e5};
constexpr std::size_t most_bodies = 100, most_points = 64, longest_name = 40;
constexpr double least_thickness = 0.01;  // mm, of a hull

class BodiesParser {
 public:
  BodiesParser(const std::string& file, const geometry::ChainParameters& design,
               std::vector<volumetric::StructureAxis> structure)
      : reader_(file), design_(design), structure_(std::move(structure)) {}

  MachineBodies parse(const YAML::Node& root) {
    auto structure = structure_;
    if (root.IsMap() && root["structure"]) {
      auto read = volumetric::parse_structure(reader_.text(root["structure"]));
      if (const auto* refused = std::get_if<std::string>(&read)) reader_.fail(root["structure"], *refused);
      structure = std::get<std::vector<volumetric::StructureAxis>>(std::move(read));
    }
    auto links = MachineLinks::make(design_, structure);
    if (const auto* refused = std::get_if<std::string>(&links))
      reader_.fail(root.IsMap() && root["structure"] ? root["structure"] : root, *refused);
    MachineBodies out{std::get<MachineLinks>(std::move(links)), {}};
    if (root.IsNull()) return out;
    links_ = &out.links;
    YAML::Node allowed;
    reader_.each(root, "structure, clearance_mm, bodies, allowed",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "structure") return true;
                   if (key == "clearance_mm")
                     return out.set.clearance = reader_.number(node, {0.01, 100}), true;
                   if (key == "bodies") return bodies(node, out.set.bodies), true;
                   return key == "allowed" && (allowed.reset(node), true);
                 });
    if (allowed && !allowed.IsNull()) pairs(allowed, out.set);
    return out;
  }

 private:
  void bodies(const YAML::Node& list, std::vector<Body>& out) {
    if (!list.IsSequence()) reader_.fail(list, "expected a list of bodies");
    if (list.size() > most_bodies)
      reader_.fail(list, "at most " + std::to_string(most_bodies) + " bodies are possible");
    for (const auto& entry : list) {
      auto body = one(entry);
      if (std::any_of(out.begin(), out.end(), [&](const auto& other) { return other.name == body.name; }))
        reader_.fail(entry["name"], "'" + body.name + "' is there twice");
      out.push_back(std::move(body));
    }
  }

  Body one(const YAML::Node& entry) {
    Body body;
    bool on = false;
    std::string kind;
    YAML::Node shape;
    from_face_ = false;
    reader_.each(entry, "name, on, one of box, cylinder, sphere, hull; position_mm, rotation_deg",
                 [&](const std::string& key, const YAML::Node& node) {
                   if (key == "name") return name(node, body), true;
                   if (key == "on") return carrier(node, body), on = true;
                   if (key == "position_mm") return body.position = reader_.vector(node, place), true;
                   if (key == "rotation_deg")
                     return body.rotation = volumetric::rotation(geometry::radians_per_degree *
                                                                 reader_.vector(node, angle)),
                            true;
                   if (key != "box" && key != "cylinder" && key != "sphere" && key != "hull") return false;
                   if (!kind.empty())
                     reader_.fail(node, "'" + kind + "' is there already: one body, one shape");
                   kind = key;
                   shape.reset(node);
                   return true;
                 });
    if (body.name.empty()) reader_.fail(entry, "'name' is missing");
    if (!on) reader_.fail(entry, "'on' is missing");
    if (kind.empty()) reader_.fail(entry, "a shape is missing: one of box, cylinder, sphere, hull");
    if (body.link == links_->spindle() && from_face_) body.position += links_->face();
    body.shape = shape_of(kind, shape);
    return body;
  }

  void name(const YAML::Node& node, Body& body) {
    body.name = reader_.text(node);
    if (body.name.empty() || body.name.size() > longest_name)
      reader_.fail(node, "a name has 1 .. " + std::to_string(longest_name) + " characters");
  }

  void carrier(const YAML::Node& node, Body& body) {
    const auto word = reader_.text(node);
    const auto letter = word.size() == 1 ? canonical::axis_letters.find(word[0]) : std::string_view::npos;
    if (word == "base") {
      body.link = {};
    } else if (word == "workpiece") {
      body.link = links_->workpiece();
    } else if (word == "spindle" || word == "tool") {
      body.link = links_->spindle();
      body.tool = word == "tool";
      from_face_ = true;
    } else if (letter != std::string_view::npos && links_->carried_by(letter)) {
      body.link = *links_->carried_by(letter);
    } else {
      reader_.fail(node, "'" + word + "' is none of base, workpiece, spindle, tool and the axes of " +
                             links_->notation());
    }
  }

  // The lengths under `keys`, all of which must be there.
  template <std::size_t n>
  std::array<double, n> lengths(const YAML::Node& shape, const std::array<const char*, n>& keys) {
    std::array<double, n> values{};
    std::string names;
    for (const auto* key : keys) names.append(names.empty() ? "" : ", ").append(key);
    reader_.each(shape, names, [&](const std::string& key, const YAML::Node& node) {
      for (std::size_t i = 0; i < n; ++i)
        if (key == keys[i]) return values[i] = reader_.number(node, size), true;
      return false;
    });
    for (std::size_t i = 0; i < n; ++i)
      if (values[i] == 0) reader_.fail(shape, std::string("'") + keys[i] + "' is missing");
    return values;
  }

  Shape shape_of(const std::string& kind, const YAML::Node& shape) {
    if (kind == "sphere") return Sphere{lengths<1>(shape, {"diameter_mm"})[0] / 2};
    if (kind == "cylinder") {
      const auto l = lengths<2>(shape, {"diameter_mm", "height_mm"});
      return Cylinder{l[0] / 2, l[1] / 2};
    }
    if (kind == "box") {
      Box box;
      bool given = false;
      reader_.each(shape, "size_mm", [&](const std::string& key, const YAML::Node& node) {
        return key == "size_mm" && (box.half_lengths = reader_.vector(node, size) / 2, given = true);
      });
      if (!given) reader_.fail(shape, "'size_mm' is missing");
      return box;
    }
    return hull(shape);
  }

  Hull hull(const YAML::Node& shape) {
    Hull out;
    reader_.each(shape, "points_mm", [&](const std::string& key, const YAML::Node& node) {
      if (key != "points_mm") return false;
      if (!node.IsSequence() || node.size() < 4 || node.size() > most_points)
        reader_.fail(node, "expected a list of 4 .. " + std::to_string(most_points) + " points");
      for (const auto& point : node) out.points.push_back(reader_.vector(point, place));
      if (thickness(out.points) < least_thickness)
        reader_.fail(node, "the points are in a plane, within 0.01 mm");
      return true;
    });
    if (out.points.empty()) reader_.fail(shape, "'points_mm' is missing");
    return out;
  }

  // The least distance of the farthest point: from the first one, from a line, from a plane.
  static double thickness(const std::vector<Vec3>& points) {
    const auto farthest = [&](const auto& distance) {
      return *std::max_element(points.begin(), points.end(),
                               [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    };
    const Vec3 first = points.front();
    const Vec3 second = farthest([&](const Vec3& p) { return (p - first).norm(); });
    if (!((second - first).norm() >= least_thickness)) return 0;
    const Vec3 line = (second - first).normalized();
    const auto beside = [&](const Vec3& p) { return (p - first).cross(line).norm(); };
    const Vec3 third = farthest(beside);
    if (!(beside(third) >= least_thickness)) return 0;
    const Vec3 normal = line.cross(third - first).normalized();
    const auto off = [&](const Vec3& p) { return std::abs((p - first).dot(normal)); };
    return off(farthest(off));
  }

  void pairs(const YAML::Node& list, BodySet& set) {
    if (!list.IsSequence()) reader_.fail(list, "expected a list of pairs [name, name]");
    for (const auto& pair : list) {
      if (!pair.IsSequence() || pair.size() != 2) reader_.fail(pair, "expected a pair [name, name]");
      std::array<std::string, 2> names;
      for (std::size_t i = 0; i < 2; ++i) {
        names[i] = reader_.text(pair[i]);
        if (names[i] != tool_name && std::none_of(set.bodies.begin(), set.bodies.end(),
                                                  [&](const auto& body) { return body.name == names[i]; }))
          reader_.fail(pair[i], "'" + names[i] + "' is no body");
      }
      set.allowed.emplace_back(names[0], names[1]);
    }
  }

  machine::YamlReader reader_;
  const geometry::ChainParameters& design_;
  std::vector<volumetric::StructureAxis> structure_;
  const MachineLinks* links_ = nullptr;
  bool from_face_ = false;  // of the body that is read
};

}  // namespace

MachineBodies parse_bodies(const std::string& text, const std::string& file,
                           const geometry::ChainParameters& design,
                           const std::vector<volumetric::StructureAxis>& structure) {
  return BodiesParser(file, design, structure).parse(machine::parse_yaml(text, file));
}

MachineBodies load_bodies(const std::string& directory, const geometry::ChainParameters& design,
                          const std::vector<volumetric::StructureAxis>& structure) {
  const auto file = directory + "/bodies.yaml";
  const bool described = std::filesystem::exists(file);
  auto bodies = parse_bodies(described ? machine::read_text(file) : "", file, design, structure);
  if (!described) bodies.set = derived_bodies(bodies.links);
  bodies.derived = !described;
  return bodies;
}

}  // namespace trunnion::collision
