// SPDX-License-Identifier: Apache-2.0
#include "language/m_functions.hpp"

#include <charconv>
#include <stdexcept>
#include <string>

#include "language/codes.hpp"

namespace trunnion::language {
namespace {

// The number that `text` begins with, which it then no longer does.
std::uint16_t take_code(std::string_view& text) {
  std::uint16_t code = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
  if (error != std::errc{} || code > highest_m)
    throw std::runtime_error("'" + std::string(text.substr(0, text.find_first_of(" ;-"))) +
                             "' is no M code: 0 to " + std::to_string(highest_m));
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return code;
}

}  // namespace

void MFunctions::add(std::string_view text) {
  ++groups_;
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == ';') {
      groups_ = static_cast<std::uint16_t>(groups_ + (text.front() == ';'));
      text.remove_prefix(1);
      continue;
    }
    const std::uint16_t first = take_code(text);
    std::uint16_t last = first;
    if (!text.empty() && text.front() == '-') {
      text.remove_prefix(1);
      last = take_code(text);
    }
    if (last < first)
      throw std::runtime_error("M" + std::to_string(first) + "-" + std::to_string(last) + " is no range");
    for (std::uint16_t code = first; code <= last; ++code) {
      const auto name = "M" + std::to_string(code);
      if (m_code(code).group == MGroup::flow) throw std::runtime_error(name + " belongs to the control");
      if (has(code)) throw std::runtime_error(name + " is there twice");
      group_[code] = groups_;
    }
  }
}

}  // namespace trunnion::language
