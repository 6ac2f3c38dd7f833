// SPDX-License-Identifier: Apache-2.0
#include "collision/collision_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "collision/shape_distance.hpp"
#include "geometry/angle.hpp"

namespace trunnion::collision {
namespace {

// mm: a distance that exceeds the clearance by less is taken as it. It covers the error of a distance and
// bounds the number of steps.
constexpr double resolution = 0.005;
// A share of a move below this is not divided further.
constexpr double least_share = 1e-9;

struct Pair {
  std::size_t first = 0, second = 0;
  std::size_t common = 0;  // axes from the base that move both
};

// How much one axis moves a body for the rest of a move.
struct JointMotion {
  double amount = 0;  // mm, or rad of a rotary axis
  double reach = 0;   // rotary: distance of the body's farthest point from the axis, mm
  bool rotary = false;
};

}  // namespace

struct CollisionModel::Implementation {
  MachineLinks links;
  BodySet set;
  std::vector<ShapeGeometry> shapes;
  std::vector<Pair> pairs;

  struct State {
    std::array<std::vector<Placement>, 2> links;  // tool, workpiece
    std::vector<Placement> bodies;
    std::vector<Vec3> centres;  // of the bounding spheres
  };

  Implementation(MachineLinks l, BodySet s) : links(std::move(l)), set(std::move(s)) {
    for (const Body& body : set.bodies) shapes.emplace_back(body.shape);
    for (std::size_t i = 0; i < set.bodies.size(); ++i)
      for (std::size_t k = i + 1; k < set.bodies.size(); ++k)
        if (!neighbours(set.bodies[i].link, set.bodies[k].link) && !allowed(i, k))
          pairs.push_back({i, k, common(set.bodies[i].link, set.bodies[k].link)});
  }

  static bool neighbours(const Link& a, const Link& b) {
    if (a.depth == 0 || b.depth == 0) return a.depth + b.depth <= 1;
    return a.workpiece == b.workpiece && (a.depth > b.depth ? a.depth - b.depth : b.depth - a.depth) <= 1;
  }
  static std::size_t common(const Link& a, const Link& b) {
    return a.workpiece == b.workpiece ? std::min(a.depth, b.depth) : 0;
  }
  bool allowed(std::size_t i, std::size_t k) const {
    const auto &a = set.bodies[i].name, &b = set.bodies[k].name;
    return std::any_of(set.allowed.begin(), set.allowed.end(), [&](const auto& pair) {
      return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
    });
  }

  void place(const AxisPosition& position, State& state) const {
    for (const bool workpiece : {false, true})
      links.place(position, workpiece, state.links[workpiece ? 1 : 0]);
    state.bodies.resize(set.bodies.size());
    state.centres.resize(set.bodies.size());
    for (std::size_t i = 0; i < set.bodies.size(); ++i) {
      const Body& body = set.bodies[i];
      const Placement& link = state.links[body.link.workpiece ? 1 : 0][body.link.depth];
      state.bodies[i] = {link.rotation * body.rotation, link * body.position};
      state.centres[i] = state.bodies[i] * shapes[i].centre();
    }
  }
  // Never above the distance.
  double rough(const Pair& pair, const State& state) const {
    return (state.centres[pair.first] - state.centres[pair.second]).norm() - shapes[pair.first].radius() -
           shapes[pair.second].radius();
  }
  PairDistance exact(const Pair& pair, const State& state) const {
    PairDistance out{pair.first, pair.second, 0};
    out.distance = distance_between(shapes[pair.first], state.bodies[pair.first], shapes[pair.second],
                                    state.bodies[pair.second], out.on_first, out.on_second);
    return out;
  }

  std::optional<PairDistance> nearest(const State& state, double within) const {
    std::optional<PairDistance> found;
    for (const Pair& pair : pairs) {
      if (rough(pair, state) >= (found ? std::min(found->distance, within) : within)) continue;
      const auto one = exact(pair, state);
      if (one.distance < within && (!found || one.distance < found->distance)) found = one;
    }
    return found;
  }

  // Of body `i` at `state` for a move by `change`.
  void motions(std::size_t i, const State& state, const AxisPosition& change,
               std::vector<JointMotion>& out) const {
    const Body& body = set.bodies[i];
    const auto& joints = links.joints(body.link.workpiece);
    const auto& frames = state.links[body.link.workpiece ? 1 : 0];
    out.resize(body.link.depth);
    for (std::size_t k = 0; k < body.link.depth; ++k) {
      const Joint& joint = joints[k];
      JointMotion& motion = out[k];
      motion.rotary = joint.rotary;
      motion.amount = std::abs(change[joint.axis]);
      motion.reach = 0;
      if (!joint.rotary || motion.amount == 0) continue;
      motion.amount *= geometry::radians_per_degree;
      const Vec3 direction = frames[k].rotation * joint.direction, point = frames[k] * joint.point;
      const auto beside = [&](const Vec3& p) { return (p - point).cross(direction).norm(); };
      // The distance from a line is convex: its maximum over a box is at a corner.
      double corners = 0;
      for (const Vec3& corner : shapes[i].corners())
        corners = std::max(corners, beside(state.bodies[i] * corner));
      motion.reach = std::min(corners, beside(state.centres[i]) + shapes[i].radius());
    }
  }
  // How far a point of the body can move within `share` of the move, by the axes from `first` on. What an
  // outer axis moves adds to the distance from the inner ones.
  static double most_motion(const std::vector<JointMotion>& motions, std::size_t first, double share) {
    double moved = 0;
    for (std::size_t k = motions.size(); k-- > first;)
      moved += motions[k].amount * share * (motions[k].rotary ? motions[k].reach + moved : 1);
    return moved;
  }

  std::optional<FirstContact> first_contact(const AxisPosition& from, const AxisPosition& to,
                                            double clearance) const {
    AxisPosition change{};
    for (std::size_t k = 0; k < change.size(); ++k) change[k] = to[k] - from[k];
    State state;
    std::vector<std::vector<JointMotion>> moving(set.bodies.size());
    double at = 0;
    for (;;) {
      AxisPosition here{};
      for (std::size_t k = 0; k < here.size(); ++k) here[k] = at >= 1 ? to[k] : from[k] + at * change[k];
      place(here, state);
      for (std::size_t i = 0; i < set.bodies.size(); ++i) motions(i, state, change, moving[i]);
      double step = std::max(1 - at, 0.0);
      for (const Pair& pair : pairs) {
        const auto moved = [&](double share) {
          return most_motion(moving[pair.first], pair.common, share) +
                 most_motion(moving[pair.second], pair.common, share);
        };
        const auto most = moved(step);
        if (rough(pair, state) - clearance > most + 2 * resolution) continue;
        const auto one = exact(pair, state);
        const double spare = one.distance - clearance - resolution;
        if (spare <= resolution) return FirstContact{at, here, one};
        // The motion is convex in the share, so a smaller share moves less than in proportion.
        if (spare < most) step *= spare / most;
      }
      if (at >= 1) return std::nullopt;
      at = 1 - at <= step ? 1 : at + std::max(step, least_share);
    }
  }
};

CollisionModel::CollisionModel(MachineLinks links, BodySet set)
    : implementation_(std::make_unique<Implementation>(std::move(links), std::move(set))) {}
CollisionModel::CollisionModel(CollisionModel&&) noexcept = default;
CollisionModel& CollisionModel::operator=(CollisionModel&&) noexcept = default;
CollisionModel::~CollisionModel() = default;

const MachineLinks& CollisionModel::links() const { return implementation_->links; }
const std::vector<Body>& CollisionModel::bodies() const { return implementation_->set.bodies; }
double CollisionModel::clearance() const { return implementation_->set.clearance; }
std::size_t CollisionModel::pair_count() const { return implementation_->pairs.size(); }

std::optional<PairDistance> CollisionModel::nearest(const AxisPosition& position, double within) const {
  Implementation::State state;
  implementation_->place(position, state);
  return implementation_->nearest(state, within);
}

bool CollisionModel::collides(const AxisPosition& position) const {
  return nearest(position, clearance() + 2 * resolution).has_value();
}

std::optional<FirstContact> CollisionModel::first_contact(const AxisPosition& from, const AxisPosition& to,
                                                          double clearance) const {
  return implementation_->first_contact(from, to, clearance < 0 ? this->clearance() : clearance);
}

void CollisionModel::note(const AxisPosition& position, std::size_t at, double within,
                          ClearanceTable& table) const {
  const auto& pairs = implementation_->pairs;
  if (table.rows_.empty())
    for (const auto& pair : pairs) table.rows_.push_back({pair.first, pair.second, within, at});
  Implementation::State state;
  implementation_->place(position, state);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto& row = table.rows_[i];
    if (implementation_->rough(pairs[i], state) >= row.distance) continue;
    const double distance = implementation_->exact(pairs[i], state).distance;
    if (distance < row.distance) row.distance = distance, row.at = at;
  }
}

std::string CollisionModel::text_of(const PairDistance& pair) const {
  char text[200];
  const auto& all = bodies();
  std::snprintf(text, sizeof text,
                pair.distance >= 0 ? "'%s' and '%s' are %.3f mm apart" : "'%s' and '%s' overlap by %.3f mm",
                all[pair.first].name.c_str(), all[pair.second].name.c_str(), std::abs(pair.distance));
  return text;
}

}  // namespace trunnion::collision
