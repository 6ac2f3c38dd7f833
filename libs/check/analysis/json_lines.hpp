// SPDX-License-Identifier: Apache-2.0
// Motions, the end and an alarm as JSON lines.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "analysis/motion_tracker.hpp"

namespace trunnion::analysis {

/// `text` with quotes, as JSON writes it.
std::string json_string(std::string_view text);

/// Writes one line for each call. Formats into a buffer of its own: a hundred times as fast as building
/// documents.
class JsonLines {
 public:
  /// `axes` as language::Environment::axes(); `out` must outlive the writer.
  JsonLines(std::ostream& out, std::uint16_t axes) : out_(out), axes_(axes) {}
  ~JsonLines() { flush(); }
  JsonLines(const JsonLines&) = delete;
  JsonLines& operator=(const JsonLines&) = delete;

  /// An arc in none of the three planes has "normal", the vector it turns about, and "plane" says nothing.
  void motion(const Motion& motion);
  void end(const language::AxisValues& mcs);
  /// With "program" when it is in another text, and "called_from", innermost first, when it is in a
  /// subprogram; with "remedy" when its word is one of another control.
  void error(const language::Alarm& alarm);
  void flush();

 private:
  void put(std::string_view text);
  void number(double value);
  void whole(std::uint64_t value);
  void position(std::string_view key, const language::AxisValues& values);
  void vector(std::string_view key, const language::Vector3& values);
  void make_room();

  static constexpr std::size_t room = 1024;  // more than any line of a motion
  std::ostream& out_;
  std::uint16_t axes_;
  std::array<char, 65536> buffer_{};
  std::size_t size_ = 0;
};

}  // namespace trunnion::analysis
