// SPDX-License-Identifier: Apache-2.0
#include "variable_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace trunnion::channel {
namespace {

constexpr std::uint32_t first_kept = 500;  // those before it are common: forgotten at power-off

template <class Range>
void write(std::string& out, const Range& values, std::uint32_t first) {
  char text[64];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].given) continue;
    const auto end = std::to_chars(text, text + sizeof text, values[i].number);
    out += "#" + std::to_string(first + i) + ": ";
    out.append(text, end.ptr);
    out += '\n';
  }
}

language::Value* find(language::VariableStore& variables, std::uint32_t number) {
  language::Value* found = nullptr;
  language::VariableStore::fields(variables, [&](std::uint32_t first, auto& values) {
    if (number >= first && number < first + values.size()) found = &values[number - first];
  });
  return found;
}

}  // namespace

std::string write_variables(const language::VariableStore& variables, const std::string& boot) {
  std::string out = "boot " + boot + "\n";
  language::VariableStore::fields(
      variables, [&](std::uint32_t first, const auto& values) { write(out, values, first); });
  return out;
}

void read_variables(const std::string& text, const std::string& file, const std::string& boot,
                    language::VariableStore& variables) {
  const std::string_view all = text;
  std::size_t line = 0;
  bool same_boot = false;
  for (std::size_t at = 0; at < all.size();) {
    ++line;
    const auto end = std::min(all.find('\n', at), all.size());
    const auto row = all.substr(at, end - at);
    at = end + 1;
    if (line == 1 && row.substr(0, 5) == "boot ") {
      same_boot = row.substr(5) == boot;
      continue;
    }
    const char* const last = row.data() + row.size();
    std::uint32_t number = 0;
    double value = 0;
    bool good = !row.empty() && row[0] == '#';
    if (good) {
      const auto name = std::from_chars(row.data() + 1, last, number);
      good = name.ec == std::errc{} && last - name.ptr > 2 && name.ptr[0] == ':' && name.ptr[1] == ' ';
      if (good) {
        const auto rest = std::from_chars(name.ptr + 2, last, value);
        good = rest.ec == std::errc{} && rest.ptr == last && std::isfinite(value);
      }
    }
    auto* const variable = good ? find(variables, number) : nullptr;
    if (variable == nullptr)
      throw std::runtime_error(file + ":" + std::to_string(line) +
                               ": expected '#number: value' of #50..#199, #500..#999, #5061..#5069 or "
                               "#50000..#54999, #900000..#907399");
    if (number >= first_kept || same_boot) *variable = language::Value::of(value);
  }
}

}  // namespace trunnion::channel
