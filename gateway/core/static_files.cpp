// SPDX-License-Identifier: Apache-2.0
#include "core/static_files.hpp"

#include <algorithm>
#include <array>

#include "core/router.hpp"

namespace trunnion::gateway {
namespace {

std::string_view mime_type(const std::string& extension) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> types = {{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".txt", "text/plain; charset=utf-8"},
  }};
  for (const auto& [ending, type] : types)
    if (extension == ending) return type;
  return "application/octet-stream";
}

}  // namespace

std::optional<StaticFile> find_static(const std::filesystem::path& root, std::string_view target) {
  namespace fs = std::filesystem;
  std::string decoded;
  if (root.empty() || !target.starts_with('/') || !percent_decode(target.substr(1), decoded)) return {};
  if (decoded.find('\0') != std::string::npos || decoded.starts_with('/')) return {};
  if (decoded.empty()) decoded = "index.html";
  const fs::path relative(decoded);
  for (const auto& part : relative)
    if (part.empty() || part.native().starts_with('.')) return {};
  std::error_code error;
  const auto top = fs::canonical(root, error);
  if (error) return {};
  const auto file = fs::canonical(top / relative, error);
  if (error || !fs::is_regular_file(file, error)) return {};
  const auto [end, other] = std::mismatch(top.begin(), top.end(), file.begin(), file.end());
  if (end != top.end()) return {};
  return StaticFile{file, mime_type(file.extension()), decoded.starts_with("assets/")};
}

}  // namespace trunnion::gateway
