// SPDX-License-Identifier: Apache-2.0
// Of the library alone: the bodies of a machine at a position of its axes, their pairs, and bounds of how far
// they move.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision/collision_model.hpp"
#include "collision/shape_distance.hpp"
#include "geometry/angle.hpp"

namespace trunnion::collision {

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

struct BodyPairs {
  MachineLinks links;
  BodySet set;
  std::vector<ShapeGeometry> shapes;
  std::vector<Pair> pairs;

  struct State {
    std::array<std::vector<Placement>, 2> links;  // tool, workpiece
    std::vector<Placement> bodies;
    std::vector<Vec3> centres;  // of the bounding spheres
  };

  BodyPairs(MachineLinks l, BodySet s) : links(std::move(l)), set(std::move(s)) {
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
    for (std::size_t i = 0; i < set.bodies.size(); ++i) place_body(i, state);
  }
  // By the links of `state`.
  void place_body(std::size_t i, State& state) const {
    const Body& body = set.bodies[i];
    const Placement& link = state.links[body.link.workpiece ? 1 : 0][body.link.depth];
    state.bodies[i] = {link.rotation * body.rotation, link * body.position};
    state.centres[i] = state.bodies[i] * shapes[i].centre();
  }
  // Distance of the farthest point of body `i` from rotary joint `k` of its side, mm.
  double reach(std::size_t i, std::size_t k, const State& state) const {
    const bool workpiece = set.bodies[i].link.workpiece;
    const Joint& joint = links.joints(workpiece)[k];
    const Placement& frame = state.links[workpiece ? 1 : 0][k];
    const Vec3 direction = frame.rotation * joint.direction, point = frame * joint.point;
    const auto beside = [&](const Vec3& p) { return (p - point).cross(direction).norm(); };
    // The distance from a line is convex: its maximum over a box is at a corner.
    double corners = 0;
    for (const Vec3& corner : shapes[i].corners())
      corners = std::max(corners, beside(state.bodies[i] * corner));
    return std::min(corners, beside(state.centres[i]) + shapes[i].radius());
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
    out.resize(body.link.depth);
    for (std::size_t k = 0; k < body.link.depth; ++k) {
      const Joint& joint = joints[k];
      JointMotion& motion = out[k];
      motion.rotary = joint.rotary;
      motion.amount = std::abs(change[joint.axis]);
      motion.reach = 0;
      if (!joint.rotary || motion.amount == 0) continue;
      motion.amount *= geometry::radians_per_degree;
      motion.reach = reach(i, k, state);
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
};

}  // namespace trunnion::collision
