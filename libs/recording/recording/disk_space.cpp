// SPDX-License-Identifier: Apache-2.0
#include "recording/disk_space.hpp"

#include <cstdio>
#include <filesystem>

namespace trunnion::recording {
namespace fs = std::filesystem;

std::string size_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  char text[32];
  if (value < 999'500)
    std::snprintf(text, sizeof text, "%.0f kB", value / 1e3);
  else if (value < 999.95e6)
    std::snprintf(text, sizeof text, "%.1f MB", value / 1e6);
  else
    std::snprintf(text, sizeof text, "%.1f GB", value / 1e9);
  return text;
}

std::optional<std::uint64_t> free_space(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  const auto space = fs::space(fs::absolute(path, error).parent_path(), error);
  if (error) return {};
  return space.available;
}

std::string space_refusal(const std::string& path, std::uint64_t free, std::uint64_t needed) {
  if (free >= needed) return {};
  return path + ": " + size_text(free) + " are free on its disk, a recording needs " + size_text(needed) +
         ": delete files there, or record to another disk";
}

}  // namespace trunnion::recording
