// SPDX-License-Identifier: Apache-2.0
// Compensation tables as text, in the units of the HNC-8 manual: um and 0.001 deg. docs/compensation.md has
// the format.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trunnion::error_tables {

/// Type codes of the manual's tables: moving axis, compensated axis.
enum class Direction { unidirectional = 1, bidirectional = 2, modulo = 3, bidirectional_modulo = 4 };

constexpr bool both_ways(Direction d) {
  return d == Direction::bidirectional || d == Direction::bidirectional_modulo;
}
constexpr bool repeats(Direction d) { return d == Direction::modulo || d == Direction::bidirectional_modulo; }

/// Axes are 0 .. 8: X Y Z A B C U V W. Lengths in mm, angles in deg.
struct TextTable {
  std::size_t moving = 0, compensated = 0;
  /// Of an angle table: the lever arm; the values are angles then, in deg.
  std::optional<std::size_t> arm;
  double reference = 0;  ///< coordinate of the arm without effect, mm
  Direction direction = Direction::unidirectional;
  std::size_t points = 0;
  double offset = 0;  ///< intervals below the zero of the moving axis: the travel begins at -offset * spacing
  double spacing = 0;          ///< mm or deg
  std::vector<double> values;  ///< ascending coordinate; of both ways: positive direction first
};

struct TextSquareness {
  std::size_t moving = 0, compensated = 0;
  double angle = 0;  ///< deg, above zero: more than 90 deg
};

struct TextTables {
  std::vector<TextTable> tables;
  std::vector<TextSquareness> squareness;
};

/// Throws std::runtime_error that begins with file:line:column.
TextTables parse_tables(const std::string& text, const std::string& file);

/// What parse_tables reads again, to 1e-4 um.
std::string text_of(const TextTables& tables);

/// "X_Y", of an angle table "X_Y Z".
std::string name_of(const TextTable& table);

}  // namespace trunnion::error_tables
