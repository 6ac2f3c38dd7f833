// SPDX-License-Identifier: Apache-2.0
#include "collision/collision_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "collision/body_pairs.hpp"

namespace trunnion::collision {
namespace {

// mm: a distance that exceeds the clearance by less is taken as it. It covers the error of a distance and
// bounds the number of steps.
constexpr double resolution = 0.005;
// A share of a move below this is not divided further.
constexpr double least_share = 1e-9;

std::optional<FirstContact> first_contact_of(const BodyPairs& bodies, const AxisPosition& from,
                                             const AxisPosition& to, double clearance) {
  AxisPosition change{};
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = to[k] - from[k];
  BodyPairs::State state;
  std::vector<std::vector<JointMotion>> moving(bodies.set.bodies.size());
  double at = 0;
  for (;;) {
    AxisPosition here{};
    for (std::size_t k = 0; k < here.size(); ++k) here[k] = at >= 1 ? to[k] : from[k] + at * change[k];
    bodies.place(here, state);
    for (std::size_t i = 0; i < bodies.set.bodies.size(); ++i) bodies.motions(i, state, change, moving[i]);
    double step = std::max(1 - at, 0.0);
    for (const Pair& pair : bodies.pairs) {
      const auto moved = [&](double share) {
        return BodyPairs::most_motion(moving[pair.first], pair.common, share) +
               BodyPairs::most_motion(moving[pair.second], pair.common, share);
      };
      const auto most = moved(step);
      if (bodies.rough(pair, state) - clearance > most + 2 * resolution) continue;
      const auto one = bodies.exact(pair, state);
      const double spare = one.distance - clearance - resolution;
      if (spare <= resolution) return FirstContact{at, here, one};
      // The motion is convex in the share, so a smaller share moves less than in proportion.
      if (spare < most) step *= spare / most;
    }
    if (at >= 1) return std::nullopt;
    at = 1 - at <= step ? 1 : at + std::max(step, least_share);
  }
}

}  // namespace

CollisionModel::CollisionModel(MachineLinks links, BodySet set)
    : pairs_(std::make_unique<BodyPairs>(std::move(links), std::move(set))) {}
CollisionModel::CollisionModel(CollisionModel&&) noexcept = default;
CollisionModel& CollisionModel::operator=(CollisionModel&&) noexcept = default;
CollisionModel::~CollisionModel() = default;

const MachineLinks& CollisionModel::links() const { return pairs_->links; }
const std::vector<Body>& CollisionModel::bodies() const { return pairs_->set.bodies; }
double CollisionModel::clearance() const { return pairs_->set.clearance; }
std::size_t CollisionModel::pair_count() const { return pairs_->pairs.size(); }

std::optional<PairDistance> CollisionModel::nearest(const AxisPosition& position, double within) const {
  BodyPairs::State state;
  pairs_->place(position, state);
  return pairs_->nearest(state, within);
}

bool CollisionModel::collides(const AxisPosition& position) const {
  return nearest(position, clearance() + 2 * resolution).has_value();
}

std::optional<FirstContact> CollisionModel::first_contact(const AxisPosition& from, const AxisPosition& to,
                                                          double clearance) const {
  return first_contact_of(*pairs_, from, to, clearance < 0 ? this->clearance() : clearance);
}

void CollisionModel::note(const AxisPosition& position, std::size_t at, double within,
                          ClearanceTable& table) const {
  const auto& pairs = pairs_->pairs;
  if (table.rows_.empty())
    for (const auto& pair : pairs) table.rows_.push_back({pair.first, pair.second, within, at});
  BodyPairs::State state;
  pairs_->place(position, state);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto& row = table.rows_[i];
    if (pairs_->rough(pairs[i], state) >= row.distance) continue;
    const double distance = pairs_->exact(pairs[i], state).distance;
    if (distance < row.distance) row.distance = distance, row.at = at;
  }
}

std::string CollisionModel::text_of(const PairDistance& pair) const {
  const auto &first = bodies()[pair.first].name, &second = bodies()[pair.second].name;
  const double distance = std::abs(pair.distance);
  return pair.distance >= 0 ? fmt::format("'{}' and '{}' are {:.3f} mm apart", first, second, distance)
                            : fmt::format("'{}' and '{}' overlap by {:.3f} mm", first, second, distance);
}

}  // namespace trunnion::collision
