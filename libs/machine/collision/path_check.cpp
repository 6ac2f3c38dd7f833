// SPDX-License-Identifier: Apache-2.0
#include "collision/path_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/body_pairs.hpp"

namespace trunnion::collision {
namespace {

constexpr std::size_t axes = std::tuple_size_v<AxisPosition>;
// A share of a move below this is not divided further.
constexpr double shortest_share = 1e-9;

// What one axis between the pair's common part and a body does to the body.
struct Lever {
  std::size_t axis = 0;
  bool rotary = false;
  double reach = 0;  // rotary: distance of the body's farthest point from the axis, mm
};

// The levers of a body from the common part outwards.
struct Levers {
  std::array<Lever, axes> of{};
  std::size_t count = 0;

  // As BodyPairs::most_motion, when each axis moves by at most `amount`, mm and deg.
  double most_motion(const AxisPosition& amount) const {
    double moved = 0;
    for (std::size_t k = count; k-- > 0;)
      moved += of[k].rotary ? geometry::radians_per_degree * amount[of[k].axis] * (of[k].reach + moved)
                            : amount[of[k].axis];
    return moved;
  }
};

// What is known of a pair.
struct Watch {
  AxisPosition at{};    // the distance was computed here
  double distance = 0;  // mm, or less than it
  bool known = false;
  bool escaping = false;  // the path began within the clearance of the pair
  double largest = 0;     // while escaping, mm
  std::array<Levers, 2> levers;

  double most_motion(const AxisPosition& amount) const {
    return levers[0].most_motion(amount) + levers[1].most_motion(amount);
  }
};

}  // namespace

struct PathCheck::Implementation {
  const BodyPairs& bodies;
  double clearance;
  std::vector<Watch> watches;
  BodyPairs::State state;
  std::optional<AxisPosition> placed;  // `state.links` are those of this position

  AxisPosition from{}, to{}, deviation{};
  std::optional<AxisPosition> path_end;  // of the move before; none: a path begins
  bool path_begins = true, probing = false;
  std::size_t pair = 0;  // that is followed
  double at = 0;         // share to which it is known to be free
  double end = 1;        // share up to which pairs are of interest
  FirstContact contact;
  bool found = false;
  std::uint64_t distances = 0;

  explicit Implementation(const BodyPairs& b)
      : bodies(b), clearance(b.set.clearance), watches(b.pairs.size()) {
    state.bodies.resize(bodies.set.bodies.size());
    state.centres.resize(bodies.set.bodies.size());
  }

  AxisPosition position(double share) const {
    if (share >= 1) return to;
    AxisPosition out{};
    for (std::size_t k = 0; k < axes; ++k) out[k] = from[k] + share * (to[k] - from[k]);
    return out;
  }

  void begin(const AxisPosition& start, const AxisPosition& target, const AxisPosition& off, bool touches) {
    probing = touches;
    path_begins = !path_end || *path_end != start;
    if (path_begins)
      for (auto& watch : watches) watch.escaping = false;
    from = start, to = target, deviation = off;
    path_end = target;
    pair = 0, at = 0, end = 1;
  }

  // The farthest an axis is from where the distance was computed, from `at` to the end of the move.
  AxisPosition amount_from(const Watch& watch) const {
    AxisPosition amount{};
    const auto here = position(at), there = position(end);
    for (std::size_t k = 0; k < axes; ++k)
      amount[k] = std::max(std::abs(here[k] - watch.at[k]), std::abs(there[k] - watch.at[k])) + deviation[k];
    return amount;
  }

  bool may_touch(const Pair& which) const {
    const auto &first = bodies.set.bodies[which.first], &second = bodies.set.bodies[which.second];
    return (first.tool && second.link.workpiece) || (second.tool && first.link.workpiece);
  }

  void place(const AxisPosition& position, const Pair& which) {
    if (!placed || *placed != position) {
      for (const bool workpiece : {false, true})
        bodies.links.place(position, workpiece, state.links[workpiece ? 1 : 0]);
      placed = position;
    }
    bodies.place_body(which.first, state);
    bodies.place_body(which.second, state);
  }

  void find_levers(std::size_t body, std::size_t common, Levers& levers) const {
    const Link& link = bodies.set.bodies[body].link;
    const auto& joints = bodies.links.joints(link.workpiece);
    levers.count = 0;
    for (std::size_t k = common; k < link.depth; ++k)
      levers.of[levers.count++] = {joints[k].axis, joints[k].rotary,
                                   joints[k].rotary ? bodies.reach(body, k, state) : 0};
  }

  // Distance and levers of the pair at `at`; true when the rest of the move is free by the distance of the
  // bounding spheres.
  bool measure(Watch& watch, PairDistance& exact) {
    const Pair& which = bodies.pairs[pair];
    const auto here = position(at);
    place(here, which);
    watch.at = here;
    watch.known = true;
    find_levers(which.first, which.common, watch.levers[0]);
    find_levers(which.second, which.common, watch.levers[1]);
    watch.distance = bodies.rough(which, state);
    if (!watch.escaping && watch.distance - clearance - resolution > watch.most_motion(amount_from(watch)))
      return true;
    exact = bodies.exact(which, state);
    watch.distance = exact.distance;
    ++distances;
    return false;
  }

  // The pair is followed to the end of the move or to a contact; false when the budget is used up.
  bool follow(std::size_t& budget) {
    Watch& watch = watches[pair];
    if (watch.known && !watch.escaping && watch.distance - clearance > watch.most_motion(amount_from(watch)))
      return true;
    for (;;) {
      if (budget == 0) return false;
      --budget;
      PairDistance exact;
      if (measure(watch, exact)) return true;
      const double still = watch.most_motion(deviation), most = watch.most_motion(amount_from(watch));
      double spare = watch.distance - clearance - still;
      if (spare <= resolution) {
        const bool starts = path_begins && at == 0;
        if (starts && !watch.escaping) watch.escaping = true, watch.largest = watch.distance;
        if (!watch.escaping || watch.distance < watch.largest - escape_loss) {
          if (watch.escaping) at = 0;
          if (!found || at < end) contact = {at, position(at), exact};
          found = true;
          end = at;
          return true;
        }
        watch.largest = std::max(watch.largest, watch.distance);
        spare = escape_step;
      } else {
        watch.escaping = false;
      }
      if (at >= end) return true;
      if (most - still <= spare && !watch.escaping) return true;
      // The motion is convex in the share: a smaller share moves less than in proportion.
      const double step = most - still > spare ? spare / (most - still) * (end - at) : end - at;
      at = end - at <= step ? end : at + std::max(step, shortest_share);
    }
  }

  Verdict advance(std::size_t& budget) {
    if (pair == 0 && at == 0) found = false;
    for (; pair < watches.size(); ++pair, at = 0)
      if (!(probing && may_touch(bodies.pairs[pair])) && !follow(budget)) return Verdict::unfinished;
    // Whoever goes on behind a contact, or behind a touch, begins a path there.
    if (found || probing) path_end.reset();
    return found ? Verdict::contact : Verdict::free;
  }
};

PathCheck::PathCheck(const CollisionModel& model)
    : implementation_(std::make_unique<Implementation>(*model.pairs_)) {}
PathCheck::PathCheck(PathCheck&&) noexcept = default;
PathCheck& PathCheck::operator=(PathCheck&&) noexcept = default;
PathCheck::~PathCheck() = default;

void PathCheck::begin(const AxisPosition& from, const AxisPosition& to, const AxisPosition& deviation,
                      bool probing) {
  implementation_->begin(from, to, deviation, probing);
}
void PathCheck::forget_path() { implementation_->path_end.reset(); }
PathCheck::Verdict PathCheck::advance(std::size_t& budget) { return implementation_->advance(budget); }
const FirstContact& PathCheck::contact() const { return implementation_->contact; }
std::uint64_t PathCheck::distances() const { return implementation_->distances; }

}  // namespace trunnion::collision
