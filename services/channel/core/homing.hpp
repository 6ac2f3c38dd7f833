// SPDX-License-Identifier: Apache-2.0
// The drive moves an axis that searches its reference; the channel lets it, and ends the search for whatever
// stops any other motion of the channel.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "machine/axes.hpp"
#include "stream_link.hpp"

namespace trunnion::channel {

/// Axes are named by their logical numbers. One searches at a time.
class Homing {
 public:
  enum class Outcome : std::uint8_t { none, found, failed, ended };

  /// The axes whose position is not known.
  void set_unreferenced(std::set<std::uint16_t> axes);
  bool referenced(std::uint16_t axis) const { return !unreferenced_.contains(axis) || found_.contains(axis); }
  bool all_referenced() const;
  /// The drive has said so before its alarm ends.
  void note_found(std::uint16_t axis);
  /// A reference return of `axis` is a search of the drive, and no move of the channel. `parameters` may be
  /// null.
  bool needed(std::uint16_t axis, const machine::Parameters* parameters) const;

  /// The drive is asked by advance(). `speed` mm/s or deg/s, 0 = the axis' own.
  void begin(std::uint16_t axis, double speed = 0) {
    search_ = Search{axis, speed};
    outcome_ = Outcome::none;
  }
  /// The drive knows no override: the axis brakes while there is none (`moves` is false), and searches from
  /// where it is when there is one again.
  void advance(StreamLink& link, bool moves);
  void end(StreamLink& link, bool moves);

  bool active() const { return search_.has_value(); }
  /// It is over when the drive has braked.
  bool ended() const { return search_ && search_->ended; }
  /// How the newest search has gone, once.
  Outcome take_outcome() { return std::exchange(outcome_, Outcome::none); }
  /// For the operator, while it is active.
  std::string detail(const machine::ChannelAxes& axes, const StreamLink& link, bool moves) const;

 private:
  struct Search {
    std::uint16_t axis = 0;
    double speed = 0;
    bool demanded = false;  ///< of the drive; false: it waits for the feed override, or brakes
    bool ended = false;
  };
  std::set<std::uint16_t> unreferenced_;
  std::set<std::uint16_t> found_;  // of these, those found since
  std::optional<Search> search_;
  Outcome outcome_ = Outcome::none;
};

}  // namespace trunnion::channel
