// SPDX-License-Identifier: Apache-2.0
#include "collision/way_search.hpp"

#include <fmt/core.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>

#include "canonical/axes.hpp"
#include "geometry/random_source.hpp"

namespace trunnion::collision {
namespace {

namespace ob = ompl::base;

// A rotary axis without an end of its travel may go this far beyond start and end, deg.
constexpr double endless_margin = 180;
constexpr double endless_travel = 720;
// Share of the extent of the space in one step of the search.
constexpr double step_share = 0.15;
// A corner is cut off where its sides are this part of their length away from it.
constexpr double corner_share = 0.25;
constexpr double same = 1e-9;

using Way = std::vector<AxisPosition>;

// A generator of our own: those of OMPL share one sequence of seeds in the whole process.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * random_.uniform(); }

 private:
  geometry::RandomSource random_;
};

class Sampler : public ob::StateSampler {
 public:
  Sampler(const ob::StateSpace* space, std::shared_ptr<Draw> draw)
      : ob::StateSampler(space), draw_(std::move(draw)) {}
  void sampleUniform(ob::State* state) override {
    const auto& bounds = space_->as<ob::RealVectorStateSpace>()->getBounds();
    auto* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (std::size_t i = 0; i < bounds.low.size(); ++i)
      values[i] = draw_->uniform(bounds.low[i], bounds.high[i]);
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    const auto* centre = near->as<ob::RealVectorStateSpace::StateType>()->values;
    auto* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (unsigned i = 0; i < space_->getDimension(); ++i)
      values[i] = draw_->uniform(centre[i] - distance, centre[i] + distance);
    space_->enforceBounds(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    sampleUniformNear(state, mean, deviation);
  }

 private:
  std::shared_ptr<Draw> draw_;
};

class Search {
 public:
  Search(const CollisionModel& model, const Travel& travel, const AxisPosition& from, const AxisPosition& to,
         const SearchOptions& options)
      : model_(model), travel_(travel), from_(from), to_(to), options_(options) {
    for (const bool workpiece : {false, true})
      for (const Joint& joint : model.links().joints(workpiece))
        if (travel[joint.axis].present) axes_.push_back(joint.axis);
    std::sort(axes_.begin(), axes_.end());
    for (const auto axis : axes_) {
      double low = travel[axis].low, high = travel[axis].high;
      if (axis > 2 && high - low > endless_travel) {
        low = std::max(low, std::min(from[axis], to[axis]) - endless_margin);
        high = std::min(high, std::max(from[axis], to[axis]) + endless_margin);
      }
      low_.push_back(low), high_.push_back(high);
    }
  }

  std::variant<Way, std::string> run() {
    for (const auto& [position, name] : {std::pair{&from_, "start"}, {&to_, "end"}}) {
      if (auto fault = fault_at(*position, name); !fault.empty()) return fault;
    }
    const auto blocked = model_.first_contact(from_, to_);
    if (!blocked) return Way{from_, to_};
    if (auto way = by_a_retract(); !way.empty()) return improved(std::move(way));
    if (auto way = by_samples(); !way.empty()) return improved(std::move(way));
    return "no way was found in " + std::to_string(options_.most_samples) + " samples; on the direct one " +
           model_.text_of(blocked->pair) + " at " + text_of(blocked->position, travel_);
  }

 private:
  std::string fault_at(const AxisPosition& position, const char* name) const {
    for (std::size_t i = 0; i < axes_.size(); ++i)
      if (position[axes_[i]] < low_[i] - same || position[axes_[i]] > high_[i] + same)
        return fmt::format("{}: {} {:.4f} is not within its travel {:.10g} .. {:.10g}", name,
                           canonical::axis_letters[axes_[i]], position[axes_[i]], low_[i], high_[i]);
    const auto contact = model_.first_contact(position, position);
    if (!contact) return "";
    return std::string(name) + ": " + model_.text_of(contact->pair) + " at " + text_of(position, travel_);
  }

  bool free(const AxisPosition& a, const AxisPosition& b) const { return !model_.first_contact(a, b); }
  bool free(const Way& way) const {
    for (std::size_t i = 1; i < way.size(); ++i)
      if (!free(way[i - 1], way[i])) return false;
    return true;
  }

  // One linear axis to an end of its travel, the others meanwhile there, and back.
  Way by_a_retract() const {
    Way best;
    for (std::size_t i = axes_.size(); i-- > 0;) {
      if (axes_[i] > 2) continue;
      for (const double end : {high_[i], low_[i]}) {
        auto up = from_, over = to_;
        up[axes_[i]] = over[axes_[i]] = end;
        auto turned = up;
        for (const auto axis : axes_)
          if (axis > 2) turned[axis] = to_[axis];
        for (const Way& way : {Way{from_, up, over, to_}, Way{from_, up, turned, over, to_}})
          if (free(way) && (best.empty() || length(way) < length(best))) best = way;
      }
    }
    return best;
  }

  double length(const Way& way) const {
    double sum = 0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      double square = 0;
      for (const auto axis : axes_)
        square += (way[i][axis] - way[i - 1][axis]) * (way[i][axis] - way[i - 1][axis]);
      sum += std::sqrt(square);
    }
    return sum;
  }

  AxisPosition position_of(const ob::State* state) const {
    const auto* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    auto position = from_;
    for (std::size_t i = 0; i < axes_.size(); ++i) position[axes_[i]] = values[i];
    return position;
  }

  // A millimetre counts as a degree.
  Way by_samples() const {
    ompl::msg::noOutputHandler();
    const auto dimension = static_cast<unsigned>(axes_.size());
    auto space = std::make_shared<ob::RealVectorStateSpace>(dimension);
    ob::RealVectorBounds bounds(dimension);
    bounds.low = low_, bounds.high = high_;
    space->setBounds(bounds);
    auto draw = std::make_shared<Draw>(options_.seed);
    space->setStateSamplerAllocator(
        [draw](const ob::StateSpace* s) { return std::make_shared<Sampler>(s, draw); });
    auto information = std::make_shared<ob::SpaceInformation>(space);
    information->setStateValidityChecker(
        [this](const ob::State* state) { return !model_.collides(position_of(state)); });
    information->setMotionValidator(std::make_shared<Moves>(information, *this));
    information->setup();
    auto problem = std::make_shared<ob::ProblemDefinition>(information);
    ob::ScopedState<ob::RealVectorStateSpace> start(space), goal(space);
    for (unsigned i = 0; i < dimension; ++i)
      start->values[i] = from_[axes_[i]], goal->values[i] = to_[axes_[i]];
    problem->setStartAndGoalStates(start, goal);
    ompl::geometric::RRTConnect planner(information);
    planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
    planner.setRange(step_share * space->getMaximumExtent());
    planner.setProblemDefinition(problem);
    planner.setup();
    ob::IterationTerminationCondition samples(static_cast<unsigned>(options_.most_samples));
    if (planner.solve(samples) != ob::PlannerStatus::EXACT_SOLUTION) return {};
    Way way;
    auto* path = problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
    for (const auto* state : path->getStates()) way.push_back(position_of(state));
    way.front() = from_, way.back() = to_;
    return free(way) ? way : Way{};
  }

  class Moves : public ob::MotionValidator {
   public:
    Moves(const ob::SpaceInformationPtr& information, const Search& search)
        : ob::MotionValidator(information), search_(search) {}
    bool checkMotion(const ob::State* a, const ob::State* b) const override {
      return search_.free(search_.position_of(a), search_.position_of(b));
    }
    bool checkMotion(const ob::State* a, const ob::State* b,
                     std::pair<ob::State*, double>& last) const override {
      if (checkMotion(a, b)) return true;
      last.second = 0;
      if (last.first != nullptr) si_->copyState(last.first, a);
      return false;
    }

   private:
    const Search& search_;
  };

  static AxisPosition between(const AxisPosition& a, const AxisPosition& b, double share) {
    AxisPosition out{};
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = a[k] + share * (b[k] - a[k]);
    return out;
  }

  // Shorter by direct moves between places of the way, then with its corners cut off.
  Way improved(Way way) const {
    Draw draw(options_.seed + 1);
    for (std::size_t trial = 0; trial < options_.shortcuts && way.size() > 2; ++trial) {
      double a = draw.uniform(0, static_cast<double>(way.size() - 1)),
             b = draw.uniform(0, static_cast<double>(way.size() - 1));
      if (a > b) std::swap(a, b);
      const auto i = static_cast<std::size_t>(a), k = std::min(static_cast<std::size_t>(b), way.size() - 2);
      if (i >= k) continue;
      const auto from = between(way[i], way[i + 1], a - static_cast<double>(i));
      const auto to = between(way[k], way[k + 1], b - static_cast<double>(k));
      Way shorter(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      shorter.push_back(from), shorter.push_back(to);
      shorter.insert(shorter.end(), way.begin() + static_cast<std::ptrdiff_t>(k) + 1, way.end());
      if (length(shorter) < length(way) - 1e-6 && free(way[i], from) && free(from, to) &&
          free(to, way[k + 1]))
        way = without_repeats(std::move(shorter));
    }
    for (std::size_t round = 0; round < options_.smoothing; ++round) {
      Way smooth{way.front()};
      for (std::size_t i = 1; i + 1 < way.size(); ++i) {
        const auto before = between(way[i], way[i - 1], corner_share);
        const auto after = between(way[i], way[i + 1], corner_share);
        if (free(smooth.back(), before) && free(before, after) && free(after, way[i + 1])) {
          smooth.push_back(before), smooth.push_back(after);
        } else {
          smooth.push_back(way[i]);
        }
      }
      smooth.push_back(way.back());
      if (!free(smooth)) break;
      way = std::move(smooth);
    }
    return way;
  }

  static Way without_repeats(Way way) {
    const auto equal = [](const AxisPosition& a, const AxisPosition& b) {
      for (std::size_t k = 0; k < a.size(); ++k)
        if (std::abs(a[k] - b[k]) > same) return false;
      return true;
    };
    const auto end = way.back();
    way.erase(std::unique(way.begin(), way.end(), equal), way.end());
    way.back() = end;
    return way;
  }

  const CollisionModel& model_;
  const Travel& travel_;
  const AxisPosition& from_;
  const AxisPosition& to_;
  const SearchOptions& options_;
  std::vector<std::size_t> axes_;
  std::vector<double> low_, high_;
};

}  // namespace

std::variant<std::vector<AxisPosition>, std::string> find_way(const CollisionModel& model,
                                                              const Travel& travel, const AxisPosition& from,
                                                              const AxisPosition& to,
                                                              const SearchOptions& options) {
  return Search(model, travel, from, to, options).run();
}

}  // namespace trunnion::collision
