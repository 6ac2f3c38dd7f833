// SPDX-License-Identifier: Apache-2.0
// Cutter radius compensation: the path of the tool's centre beside a programmed contour.
#pragma once

#include <array>
#include <cstddef>

#include "language/alarms.hpp"
#include "language/arc_geometry.hpp"
#include "language/canonical.hpp"
#include "language/environment.hpp"
#include "language/planar_piece.hpp"

namespace trunnion::language {

/// A stage between the frames and the commands: moves go in as programmed and come out offset in the plane,
/// one or more moves later. Positions are contour coordinates (ProgramFrame).
///
///  - The first straight move in the plane behind request() leads in: it ends square beside the start of the
///    next one. The first straight move behind request(off) leads out, from square beside the end of the one
///    before, or from where its offset meets that of a wall behind it (leave_along). Neither may be an arc.
///  - Inside corners: both moves end where their offsets meet. Outside corners: an arc about the corner at
///    feed, a polygon around that arc in rapid.
///  - Another radius or side at a corner without a meeting point: a straight line between the square points.
///  - Commands without motion in the plane wait in line and act where the move before them ends. They do not
///    disturb the corner, however many there are up to `capacity`.
///  - Interference: a move whose direction would be reversed is an alarm; with interference_check also one
///    that comes nearer than the radius to one of the check_blocks moves before or behind it. An arc that
///    leads tangentially onto the contour or off it is no contour that could be cut into.
///
/// Memory is fixed. After an alarm only reset() makes sense.
class CutterCompensation {
 public:
  static constexpr std::size_t capacity = 64;

  /// Nothing held, nothing offset.
  void reset();

  /// Settings for the moves to come.
  void configure(const CutterSettings& settings);

  /// From the next move on: the side as programmed, the radius in mm (negative: the other side), the plane.
  /// `at` is where the tool is; it counts when nothing was active before.
  void request(CutterSide side, double radius, Plane plane, const AxisValues& at);
  CutterSide side() const { return side_; }
  /// Behind request(off): the contour is taken to continue from its end in this direction of the plane (G40 I
  /// J K). Not both components may be 0.
  void leave_along(Vector2 direction) { wall_ = direction; }

  /// Moves and everything else must go through here.
  bool active() const { return side_ != CutterSide::off || offset_ || count_ != 0; }

  /// A rapid, line or arc from `start` to move.target. `flipped`: the frames mirror the plane, so that the
  /// left of the program is the right of the contour.
  AlarmNumber add(const Command& move, const AxisValues& start, bool flipped);

  /// Room for a command that does not move, to be filled by the caller but for target; nullptr when there is
  /// none.
  Command* add_at_rest();

  /// The next command that is settled; false when more moves are needed.
  AlarmNumber pop(Command& command, bool& popped);

  /// No more moves come: the last one ends square to itself, everything held is settled.
  AlarmNumber finish();

  /// Lines of the text: of the move that would cut into the contour, and of the contour's move. They hold
  /// after an alarm of interference.
  struct Interference {
    std::uint32_t line = 0, contour_line = 0;
  };
  const Interference& interference() const { return interference_; }

  /// Where the tool is when everything given out has been moved.
  const AxisValues& tool() const { return tool_; }

 private:
  struct Item {
    Command command;
    bool moves_in_plane = false;
    bool leads = false;                             // in or out: not on the contour
    bool behind_lead = false, before_lead = false;  // next to a move that does
    bool smooth_start = false, smooth_end = false;  // no corner with the move before or behind
    double left = 0;                                // offset to the left of the walk, mm
    PlanarPiece contour;
    Vector2 tool_start, tool_end;
    bool end_known = false;
    bool around = false;  // joined to the move before by an arc about the corner
  };

  Item& item(std::size_t i) { return items_[(first_ + i) % capacity]; }
  const Item& item(std::size_t i) const { return items_[(first_ + i) % capacity]; }
  bool push();
  /// Index of the nearest move in the plane behind; count_ when there is none.
  std::size_t move_after(std::size_t i) const;
  AlarmNumber settle_corner(Item& before, Item& after);
  AlarmNumber check_direction(const Item& item) const;
  AlarmNumber check_interference(std::size_t i);
  bool clear_of(const Item& item, const PlanarPiece& contour, double left) const;
  /// What other moves must be clear of, the offset of which: 0 = of nothing.
  static double guarded(const Item& item);
  PlanarPiece tool_piece(const Item& item) const;
  PlanarPiece around_piece(const Item& item) const;
  bool give_join(const Item& item, Command& command);
  void give_move(const Item& item, Command& command);
  void remember(const Item& item);
  Vector2 in_plane(const AxisValues& p) const { return {p[axes_.first], p[axes_.second]}; }
  void set_in_plane(AxisValues& p, Vector2 to) const;

  CutterSettings settings_;
  CutterSide side_ = CutterSide::off;
  double radius_ = 0;
  PlaneAxes axes_ = plane_axes(Plane::xy);
  Plane plane_ = Plane::xy;
  bool offset_ = false;    // the tool is beside the contour, or will be when everything held is done
  bool finished_ = false;  // no look-ahead is needed any more
  AxisValues tool_{};
  std::array<Item, capacity> items_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::size_t last_move_ = 0;  // slot of the newest move in the plane
  bool has_last_move_ = false;
  Vector2 wall_;       // direction behind the end of the contour; zero = none
  int join_step_ = 0;  // corners of the polygon in rapid already given
  Vector2 join_from_;  // from the corner to where that polygon begins
  struct Past {
    PlanarPiece contour;
    double left = 0;
    std::uint32_t line = 0;
  };
  Interference interference_;
  std::array<Past, 6> past_{};  // contours already given out, for the interference check
  std::size_t past_count_ = 0;
};

}  // namespace trunnion::language
