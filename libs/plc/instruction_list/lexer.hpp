// SPDX-License-Identifier: Apache-2.0
// Words of an instruction list with their places.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::il {

/// what() is file:line:column: error: text.
class CompileError : public std::runtime_error {
 public:
  CompileError(const std::string& file, int at_line, int at_column, const std::string& why)
      : std::runtime_error(file + ":" + std::to_string(at_line) + ":" + std::to_string(at_column) +
                           ": error: " + why),
        line(at_line),
        column(at_column),
        text(why) {}
  int line, column;
  std::string text;  ///< without the place
};

enum class TokenKind { word, number, symbol, end_of_line };

struct Token {
  TokenKind kind = TokenKind::end_of_line;
  std::string_view text;  ///< into the source
  int line = 1, column = 1;
};

/// Comments are (* ... *), over several lines, and // to the end of the line. Every line ends with one
/// end_of_line. Throws CompileError.
std::vector<Token> tokenize(std::string_view source, const std::string& file);

}  // namespace trunnion::il
