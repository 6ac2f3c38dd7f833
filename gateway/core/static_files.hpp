// SPDX-License-Identifier: Apache-2.0
// Which file of the page a path means.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::gateway {

struct StaticFile {
  std::filesystem::path path;
  std::string_view type;   ///< MIME type
  bool immutable = false;  ///< its name holds a hash of its content, so it may be kept for ever
};

/// The file under `root` that `target` (the path of a URL, percent-encoded) means; "/" is index.html. Nothing
/// when there is none, when the path has a part that begins with a dot, or when it leads out of `root`, links
/// included.
std::optional<StaticFile> find_static(const std::filesystem::path& root, std::string_view target);

}  // namespace trunnion::gateway
