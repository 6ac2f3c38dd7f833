// SPDX-License-Identifier: Apache-2.0
// Errors and warnings of one translation, with their places.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::st {

/// A place in a source; line and column count from 1.
struct Position {
  std::uint16_t file = 0;  ///< index of the source
  std::uint32_t line = 1, column = 1;
};

enum class Severity { warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  Position at;
  std::string text;
};

class Diagnostics {
 public:
  static constexpr std::size_t most = 200;  ///< more are not kept

  void error(Position at, std::string text);
  void warning(Position at, std::string text);
  std::size_t errors() const { return errors_; }
  /// In the order of file, line and column; equal entries once.
  std::vector<Diagnostic> sorted() const;

 private:
  std::vector<Diagnostic> entries_;
  std::size_t errors_ = 0;
};

/// file:line:column: error: text
std::string to_line(const Diagnostic& diagnostic, const std::vector<std::string>& files);

}  // namespace trunnion::st
