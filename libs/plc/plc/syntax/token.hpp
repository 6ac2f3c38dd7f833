// SPDX-License-Identifier: Apache-2.0
// Words of Structured Text (IEC 61131-3:2013, 6.1) with their places.
#pragma once

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "plc/syntax/diagnostics.hpp"

namespace trunnion::st {

enum class TokenKind {
  identifier,  ///< also keywords, which are not reserved by the lexer
  integer,     ///< text without underscores; `base` of it
  real,
  string,  ///< text between the quotes with its $ sequences resolved
  time,    ///< T#..., D#..., TOD#..., DT#...: `upper` is the prefix, text what follows #
  direct,  ///< %...: text without the percent sign
  symbol,  ///< operators and punctuation
  end,
};

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;
  std::string upper;  ///< of identifiers: in capitals, as names do not distinguish case
  int base = 10;      ///< of an integer; 16 of a string in double quotes, which is WSTRING
  Position at;
};

using Tokens = std::vector<Token>;

inline void append(Tokens& tokens, Tokens more) {
  tokens.insert(tokens.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The words of a source, with one `end` behind them. Of the three kinds of comments of the
/// standard (* *) and /* */ nest.
std::vector<Token> tokenize(std::string_view source, std::uint16_t file, Diagnostics& diagnostics);

/// ASCII capitals.
std::string upper_case(std::string_view text);

}  // namespace trunnion::st
