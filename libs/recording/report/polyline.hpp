// SPDX-License-Identifier: Apache-2.0
// The programmed path as points, and the distance of any other point from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/chain.hpp"

namespace trunnion::report {

using geometry::Vec3;

/// One straight piece. Pieces follow each other, so its end is the next one's start.
struct Piece {
  Vec3 end;                ///< mm
  std::uint32_t line = 0;  ///< of the program
  bool rapid = false;
};

struct Nearest {
  Vec3 point = Vec3::Zero();
  double distance = 0;  ///< mm
  std::size_t piece = 0;
};

/// A path of straight pieces with a tree of boxes over neighbouring pieces: neighbours in the program are
/// neighbours in space, so the tree needs no sorting.
class Polyline {
 public:
  void start(const Vec3& point) {
    start_ = point;
    pieces_.clear();
    boxes_.clear();
  }
  void add(const Piece& piece) { pieces_.push_back(piece); }
  /// Call after the last add() and before nearest().
  void build();

  /// The nearest point of the whole path. `guess` is a piece that is probably near: the search is the faster
  /// for it and the result the same.
  Nearest nearest(const Vec3& point, std::size_t guess) const;

  const Vec3& start() const { return start_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const Vec3& begin_of(std::size_t piece) const { return piece == 0 ? start_ : pieces_[piece - 1].end; }

 private:
  struct Box {
    Vec3 low, high;
  };
  static constexpr std::size_t leaf = 8;  // pieces
  void try_piece(const Vec3& point, std::size_t piece, Nearest& best, double& squared) const;
  void search(const Vec3& point, std::size_t level, std::size_t node, Nearest& best, double& squared) const;

  Vec3 start_ = Vec3::Zero();
  std::vector<Piece> pieces_;
  std::vector<std::vector<Box>> boxes_;  // level 0: one for each leaf; each level above halves their number
};

}  // namespace trunnion::report
