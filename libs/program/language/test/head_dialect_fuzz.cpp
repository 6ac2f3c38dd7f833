// SPDX-License-Identifier: Apache-2.0
// Any line as one of a head, and any text as rules for names: a place is inside the line, a name is a
// dialect's exactly when it is known, and a rule that is taken is found again.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "language/head_dialect.hpp"
#include "language/name_dialects.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_head(std::string_view line) {
  using trunnion::language::HeadLine;
  const HeadLine head = trunnion::language::read_head_line(line);
  require(head.offset <= line.size());
  if (head.kind != HeadLine::Kind::named) return;
  const auto name = trunnion::canonical::dialect_name(head.dialect);
  const auto found = trunnion::canonical::dialect_named(line.substr(head.offset, name.size()));
  require(found == head.dialect);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (size <= 16384) check_head(text.substr(0, text.find('\n')));
  trunnion::language::NameDialects dialects;
  try {
    dialects.add(text);
  } catch (const std::runtime_error&) {
    return 0;
  }
  const std::string_view word = text.substr(0, text.find_first_of(" ;"));
  if (!word.empty()) require(dialects.of(std::string("part").append(word)).has_value());
  return 0;
}
