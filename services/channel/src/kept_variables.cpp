#include "kept_variables.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace trunnion::channel {
namespace {

constexpr std::uint32_t first_kept = 500, first_user = 50000;

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
  if (number >= first_kept && number < first_kept + variables.kept.size())
    return &variables.kept[number - first_kept];
  if (number >= first_user && number < first_user + variables.user.size())
    return &variables.user[number - first_user];
  return nullptr;
}

}  // namespace

std::string write_kept_variables(const language::VariableStore& variables) {
  std::string out;
  write(out, variables.kept, first_kept);
  write(out, variables.user, first_user);
  return out;
}

void read_kept_variables(const std::string& text, const std::string& file,
                         language::VariableStore& variables) {
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    ++line;
    const auto end = std::min(text.find('\n', at), text.size());
    const char *p = text.data() + at, *const last = text.data() + end;
    std::uint32_t number = 0;
    double value = 0;
    bool good = p != last && *p == '#';
    if (good) {
      const auto name = std::from_chars(p + 1, last, number);
      good = name.ec == std::errc{} && last - name.ptr > 2 && name.ptr[0] == ':' && name.ptr[1] == ' ';
      if (good) {
        const auto rest = std::from_chars(name.ptr + 2, last, value);
        good = rest.ec == std::errc{} && rest.ptr == last && std::isfinite(value);
      }
    }
    auto* const variable = good ? find(variables, number) : nullptr;
    if (variable == nullptr)
      throw std::runtime_error(file + ":" + std::to_string(line) +
                               ": expected '#number: value' of #500..#999 or #50000..#54999");
    *variable = language::Value::of(value);
    at = end + 1;
  }
}

}  // namespace trunnion::channel
