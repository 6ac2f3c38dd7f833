// SPDX-License-Identifier: Apache-2.0
#include "snapshot/kept_files.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bus/json.hpp"

namespace trunnion::snapshot {
namespace {

std::string to_hexadecimal(const std::string& bytes) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    text += digits[value >> 4];
    text += digits[value & 15];
  }
  return text;
}

std::string from_hexadecimal(const std::string& text) {
  std::string bytes(text.size() / 2, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    unsigned value = 0;
    const auto* begin = text.data() + 2 * i;
    if (const auto [at, error] = std::from_chars(begin, begin + 2, value, 16);
        error != std::errc{} || at != begin + 2)
      throw std::runtime_error("a file of the snapshot has other characters than hexadecimal digits");
    bytes[i] = static_cast<char>(value);
  }
  return bytes;
}

}  // namespace

bus::Json kept_files(const std::string& directory, const std::vector<std::string>& names) {
  auto files = bus::Json::array();
  for (const auto& name : names) {
    std::ifstream in(std::filesystem::path(directory) / name, std::ios::binary);
    if (!in) continue;
    std::ostringstream bytes;
    bytes << in.rdbuf();
    files.push_back({{"name", name}, {"bytes", to_hexadecimal(bytes.str())}});
  }
  return files;
}

void put_files(const std::string& directory, const bus::Json& files) {
  for (const auto& file : files) {
    const auto name = file.at("name").get<std::string>();
    // Names come with a recording: none leads out of the directory.
    if (name != std::filesystem::path(name).filename())
      throw std::runtime_error("the snapshot has a file with a path: " + name);
    const auto path = std::filesystem::path(directory) / name;
    std::ofstream out(path, std::ios::binary);
    out << from_hexadecimal(file.at("bytes").get<std::string>());
    if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
  }
}

}  // namespace trunnion::snapshot
