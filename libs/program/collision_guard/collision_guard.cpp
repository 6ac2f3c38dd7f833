// SPDX-License-Identifier: Apache-2.0
#include "collision_guard/collision_guard.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "machine/chain_parameters.hpp"
#include "machine/yaml.hpp"
#include "motion/axis_motion.hpp"

namespace trunnion::collision_guard {
namespace {

using collision::AxisPosition;
using collision::PathCheck;
using language::CommandKind;

// Of one straight move, degrees: of all rotary axes together under a tool tip, and of an arc.
constexpr double rotary_step = 5, arc_step = 10;
// The axes leave a straight move most near its middle. So small parts of a turn are nearly parabolas, and
// twice what is found there covers the difference.
constexpr double bend_share = 2;
constexpr double difference_step = 0.1;  // degrees, of the derivatives of the linear axes

double turn_of(const AxisValues& from, const AxisValues& to) {
  double turn = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (canonical::is_rotary(i)) turn += std::abs(to[i] - from[i]);
  return turn;
}

}  // namespace

BodiesText load_bodies_text(const std::string& directory) {
  BodiesText bodies{directory + "/bodies.yaml", std::nullopt};
  if (std::filesystem::exists(bodies.file)) bodies.text = machine::read_text(bodies.file);
  return bodies;
}

CollisionGuard::CollisionGuard(const channel_setup::ChannelSetup& machine, CollisionMode mode,
                               BodiesText bodies)
    : machine_(machine), mode_(mode), text_(std::move(bodies)) {}

void CollisionGuard::configure(const machine::Parameters& parameters, std::uint16_t channel) {
  check_.reset();
  model_.reset();
  bodies_.reset();
  tool_.reset();
  begin_run();
  if (!text_.text)
    throw std::runtime_error(text_.file + ": the file is missing, and 'collision' in machine.yaml needs it");
  auto bodies =
      collision::parse_bodies(*text_.text, text_.file, machine::chain_parameters(parameters, channel));
  travel_ = {};
  for (const auto axis : machine_.channel_axes().index)
    if (axis < travel_.size()) travel_[axis].present = true;
  bodies_ = std::move(bodies);
}

void CollisionGuard::begin_run() {
  open_ = false;
  warned_.reset();
  if (check_) check_->forget_path();
}

CollisionGuard::Tool CollisionGuard::tool_of(const language::ModalState& modal) const {
  const auto number = modal.tool != 0 ? modal.tool : modal.length_offset;
  const auto row = number != 0 ? machine_.tool_offset(number) : std::nullopt;
  if (!row) return {};
  const double length = row->length + row->length_wear;
  if (!(length > 0)) return {};
  // A tool without a radius in the table is a line.
  return {length, std::max(row->radius.value_or(0), 0.01), number};
}

// The bodies are built anew only when the tool is another one.
void CollisionGuard::use_tool(const language::ModalState& modal) {
  const auto tool = tool_of(modal);
  if (tool_ == tool) return;
  tool_ = tool;
  auto set = bodies_->set;
  if (tool.length > 0) {
    std::erase_if(set.bodies, [](const auto& body) { return body.tool; });
    set.bodies.push_back(collision::tool_body(bodies_->links, tool.length, tool.radius));
  }
  check_.reset();
  model_.emplace(bodies_->links, std::move(set));
  check_.emplace(*model_);
}

AxisValues CollisionGuard::machine_of(const AxisValues& position, const language::Command& move) const {
  auto out = move.modal.transformation == language::Transformation::rtcp
                 ? motion::machine_axes(position, &machine_.chain(), move.modal.tool_length)
                 : position;
  for (std::size_t i = 0; i < out.size(); ++i)
    if ((held_mask_ >> i & 1u) != 0) out[i] = held_[i];
  return out;
}

void CollisionGuard::open(const AxisValues& from, const language::Command& move) {
  use_tool(move.modal);
  move_ = move;
  path_ = move.kind == CommandKind::arc ? motion::PathSegment::arc(from, move.target, move.arc)
                                        : motion::PathSegment::line(from, move.target);
  double parts = move.kind == CommandKind::arc ? move.arc.sweep / arc_step : 1;
  if (move.modal.transformation == language::Transformation::rtcp)
    parts = std::max(parts, turn_of(from, move.target) / rotary_step);
  chords_ = static_cast<std::size_t>(std::ceil(std::clamp(parts, 1.0, 1e6)));
  const auto& limits = machine_.limits();
  const motion::PathMode& mode =
      move.modal.smoothing == 0 ? limits : limits.modes[std::min<std::size_t>(move.modal.smoothing, 2) - 1];
  const double own = move.modal.path_tolerance;
  tolerance_ = {};
  for (const auto axis : machine_.channel_axes().index)
    tolerance_[axis] = canonical::is_rotary(axis)
                           ? mode.orientation_tolerance
                           : (own > 0 ? own : mode.contour_tolerance) + limits.arc_tolerance;
  chord_ = 0;
  at_ = machine_of(from, move);
  open_ = true;
  begin_chord();
}

void CollisionGuard::begin_chord() {
  const auto share = [&](double chord) { return chord / static_cast<double>(chords_); };
  const auto number = static_cast<double>(chord_);
  const bool last = chord_ + 1 == chords_;
  const auto place = [&](double s) { return path_.position(path_.length() * s); };
  next_ = machine_of(last ? move_.target : place(share(number + 1)), move_);
  auto deviation = tolerance_;
  const bool rtcp = move_.modal.transformation == language::Transformation::rtcp;
  const bool turns = rtcp && turn_of(path_.start(), move_.target) > 0;
  if (turns || move_.kind == CommandKind::arc) {
    const auto middle = machine_of(place(share(number + 0.5)), move_);
    for (std::size_t i = 0; i < middle.size(); ++i)
      deviation[i] += bend_share * std::abs(middle[i] - (at_[i] + next_[i]) / 2);
  }
  if (rtcp) {
    // What the rotary axes may leave their path moves the linear axes under the tip.
    const auto here = place(share(number));
    const auto there = machine_of(here, move_);
    for (std::size_t r = 0; r < here.size(); ++r) {
      if (!canonical::is_rotary(r) || tolerance_[r] == 0) continue;
      auto turned = here;
      turned[r] += difference_step;
      const auto moved = machine_of(turned, move_);
      for (std::size_t i = 0; i < moved.size(); ++i)
        if (!canonical::is_rotary(i))
          deviation[i] += tolerance_[r] / difference_step * std::abs(moved[i] - there[i]);
    }
  }
  for (std::size_t i = 0; i < deviation.size(); ++i)
    if ((held_mask_ >> i & 1u) != 0) deviation[i] = 0;
  check_->begin(at_, next_, deviation, move_.kind == CommandKind::skip);
}

program_execution::MoveGuard::Verdict CollisionGuard::check(const AxisValues& from,
                                                            const language::Command& move) {
  if (!bodies_) {
    contact_text_ = std::to_string(move.line) + ": the bodies of the machine are not known";
    return Verdict::contact;
  }
  if (!open_) open(from, move);
  for (;;) {
    const auto verdict = check_->advance(budget_);
    if (verdict == PathCheck::Verdict::unfinished) return Verdict::unfinished;
    if (verdict == PathCheck::Verdict::contact) {
      open_ = false;
      contact_text_ = std::to_string(move.line) + ": " + words();
      if (mode_ == CollisionMode::stop) return Verdict::contact;
      const auto& pair = check_->contact().pair;
      const std::pair bodies(pair.first, pair.second);
      if (warned_ != bodies) warnings_.push_back(contact_text_);
      warned_ = bodies;
      return Verdict::free;
    }
    if (++chord_ == chords_) break;
    at_ = next_;
    begin_chord();
  }
  open_ = false;
  warned_.reset();
  return Verdict::free;
}

std::optional<Obstacle> CollisionGuard::obstacle(const AxisValues& from, const AxisValues& to,
                                                 const language::ModalState& modal) {
  if (!bodies_) return Obstacle{0, "the bodies of the machine are not known"};
  use_tool(modal);
  open_ = false;
  check_->forget_path();
  auto start = from, end = to;
  for (std::size_t i = 0; i < start.size(); ++i)
    if ((held_mask_ >> i & 1u) != 0) start[i] = end[i] = held_[i];
  check_->begin(start, end, {}, false);
  auto budget = std::numeric_limits<std::size_t>::max();
  if (check_->advance(budget) == PathCheck::Verdict::free) return std::nullopt;
  return Obstacle{check_->contact().share, words()};
}

// "'spindle nose' and 'table' would be 0.998 mm apart (clearance 1 mm) at X10.000 Y0.000 Z-300.000 mm,
// A30.000 C0.000 deg"
std::string CollisionGuard::words() const {
  const auto& contact = check_->contact();
  const auto& bodies = model_->bodies();
  const double distance = std::abs(contact.pair.distance);
  const auto near = contact.pair.distance >= 0 ? fmt::format("be {:.3f} mm apart", distance)
                                               : fmt::format("overlap by {:.3f} mm", distance);
  auto linear = travel_, rotary = travel_;
  bool any_rotary = false;
  for (std::size_t i = 0; i < travel_.size(); ++i) {
    const bool turns = canonical::is_rotary(i);
    (turns ? linear : rotary)[i].present = false;
    any_rotary = any_rotary || (turns && travel_[i].present);
  }
  auto out = fmt::format("'{}' and '{}' would {} (clearance {:g} mm) at {} mm",
                         bodies[contact.pair.first].name, bodies[contact.pair.second].name, near,
                         model_->clearance(), collision::text_of(contact.position, linear));
  if (any_rotary) out += ", " + collision::text_of(contact.position, rotary) + " deg";
  return out;
}

std::unique_ptr<CollisionGuard> load_guard(const channel_setup::ChannelSetup& machine,
                                           const std::string& directory,
                                           const machine::Parameters& parameters, std::uint16_t channel) {
  const auto mode = machine::load_collision_mode(directory);
  if (mode == CollisionMode::off) return nullptr;
  auto guard = std::make_unique<CollisionGuard>(machine, mode, load_bodies_text(directory));
  guard->configure(parameters, channel);
  return guard;
}

}  // namespace trunnion::collision_guard
