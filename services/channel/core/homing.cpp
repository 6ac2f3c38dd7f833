// SPDX-License-Identifier: Apache-2.0
#include "homing.hpp"

#include <algorithm>

#include "canonical/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::channel {

using idl::stream::ReferenceSearch;

void Homing::set_unreferenced(std::set<std::uint16_t> axes) {
  std::erase_if(found_, [&](std::uint16_t axis) { return !axes.contains(axis); });
  unreferenced_ = std::move(axes);
}

bool Homing::all_referenced() const {
  return std::all_of(unreferenced_.begin(), unreferenced_.end(),
                     [this](std::uint16_t axis) { return found_.contains(axis); });
}

void Homing::note_found(std::uint16_t axis) {
  if (unreferenced_.contains(axis)) found_.insert(axis);
}

bool Homing::needed(std::uint16_t axis, const machine::Parameters* parameters) const {
  return !referenced(axis) ||
         (parameters != nullptr && parameters->integer(parameter::homing_direction, axis) != 0);
}

void Homing::advance(StreamLink& link, bool moves) {
  if (!search_) return;
  if (link.homing()) {
    if (!search_->demanded || moves) return;
    link.leave();
    search_->demanded = false;
  } else if (search_->demanded || search_->ended || link.drive_mode() == DriveMode::OFF) {
    const bool found = search_->demanded && link.search() == ReferenceSearch::REFERENCE_FOUND;
    outcome_ = search_->ended ? Outcome::ended : found ? Outcome::found : Outcome::failed;
    search_.reset();
  } else if (moves) {
    link.request_homing(search_->axis, search_->speed);
    search_->demanded = true;
  }
}

void Homing::end(StreamLink& link, bool moves) {
  if (!search_) return;
  if (search_->demanded && link.homing()) link.leave();
  search_->demanded = false, search_->ended = true;
  advance(link, moves);
}

std::string Homing::detail(const machine::ChannelAxes& axes, const StreamLink& link, bool moves) const {
  std::string name;
  for (std::size_t i = 0; i < axes.number.size(); ++i)
    if (axes.number[i] == search_->axis) name = canonical::axis_letters[axes.index[i]];
  if (search_->ended) return "axis " + name + " brakes, its homing has ended";
  if (search_->demanded && link.homing_waits())
    return "axis " + name + " waits: another channel searches a reference";
  if (search_->demanded && link.search() == ReferenceSearch::MOVES_OFF_SWITCH)
    return "axis " + name + " moves off its home switch";
  return "axis " + name + " searches its reference" + (moves ? "" : ": the feed override is 0 %");
}

}  // namespace trunnion::channel
