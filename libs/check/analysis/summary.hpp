// SPDX-License-Identifier: Apache-2.0
// What a program does, in numbers.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <set>
#include <string_view>

#include "analysis/motion_tracker.hpp"

namespace trunnion::analysis {

/// Gathers motions; memory does not grow with their number.
class Summary {
 public:
  explicit Summary(std::uint16_t axes) : axes_(axes) {}

  void add(const language::Command& command);
  void add(const Motion& motion);
  /// Readable lines; `blocks` as language::Interpreter::blocks(), `warnings` further lines.
  void print(std::ostream& out, std::uint64_t blocks, std::string_view warnings = {}) const;

  /// Extents of the control point in machine coordinates; of a motion whose axes turn under tool tip control,
  /// those of its ends.
  const language::AxisValues& lowest() const { return lowest_; }
  const language::AxisValues& highest() const { return highest_; }
  /// M codes that are in no table of the control, in the order of their numbers.
  const std::set<std::uint32_t>& other_m_codes() const { return other_m_codes_; }

 private:
  /// Moves whose time depends on what F counts.
  struct MixedMoves {
    std::uint64_t moves = 0;
    std::uint32_t line = 0;  ///< of the first one
    double linear_minutes = 0, combined_minutes = 0;
    void add(const Motion& motion);  ///< with a feed
  };
  void extend(const language::AxisValues& point);
  void extend_over_arc(const Motion& motion);

  std::uint16_t axes_;
  std::uint64_t rapids_ = 0, lines_ = 0, arcs_ = 0;
  double rapid_length_ = 0, feed_length_ = 0, feed_minutes_ = 0, dwell_seconds_ = 0;
  MixedMoves mixed_;
  std::uint32_t plane_line_ = 0, plane_solution_ = 0;  ///< of the first tilted plane with P1 or P2
  std::set<std::uint32_t> tools_, other_m_codes_;
  std::uint64_t printed_ = 0;  ///< lines of DPRNT
  bool moved_ = false;
  language::AxisValues lowest_{}, highest_{};
};

}  // namespace trunnion::analysis
