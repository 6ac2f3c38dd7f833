// SPDX-License-Identifier: Apache-2.0
#include "machine/yaml.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "text/utf8.hpp"

namespace trunnion::machine {
namespace {
std::string position(const std::string& file, const YAML::Mark& mark) {
  return file + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1) + ": error: ";
}
}  // namespace

std::string at(const std::string& file, const YAML::Node& node) { return position(file, node.Mark()); }

std::string scalar(const std::string& file, const YAML::Node& node) {
  if (!node.IsScalar()) throw std::runtime_error(at(file, node) + "expected one value");
  return node.Scalar();
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  // yaml-cpp would take any bytes and write others.
  if (const auto valid = text::valid_utf8_prefix(text); valid != text.size()) {
    YAML::Mark mark;
    mark.line = static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(valid), '\n'));
    mark.column = static_cast<int>(valid - (text.rfind('\n', valid) + 1));
    throw std::runtime_error(position(file, mark) + "the text is not UTF-8");
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(position(file, e.mark) + e.msg);
  }
}

std::string scalar_text(const std::string& text) {
  const bool word = !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
                    !YAML::IsNullString(text) && std::all_of(text.begin(), text.end(), [](unsigned char c) {
                      return c < 128 && (std::isalnum(c) != 0 || c == '_');
                    });
  // A JSON string is a quoted YAML scalar. The emitter of yaml-cpp replaces Unicode's noncharacters.
  return word ? text : nlohmann::json(text).dump();
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ": error: cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace trunnion::machine
