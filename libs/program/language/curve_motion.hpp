// SPDX-License-Identifier: Apache-2.0
// NURBS curves (G6.2), read block by block and given out as chords.
#pragma once

#include "language/block_context.hpp"
#include "language/nurbs_curve.hpp"

namespace trunnion::language {

class CurveMotion : private BlockHandler {
 public:
  explicit CurveMotion(BlockContext& context) : BlockHandler(context) {}

  /// Forgets a curve that is not complete.
  void reset() { curve_.stop(); }
  /// More blocks of a curve must come.
  bool open() const { return curve_.active(); }
  /// An open curve admits no codes.
  Fault check() const;

  /// A block while the modal motion code is G6.2: begins a curve, or adds to the open one.
  Fault begin();
  Fault add_block();
  /// The next chord, or the end of the activity until the next block.
  Fault next_chord();

 private:
  Fault read_block();

  NurbsCurve curve_;
  Vector3 control_point_{};  // program coordinates, the last one of the curve
};

}  // namespace trunnion::language
