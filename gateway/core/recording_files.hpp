// SPDX-License-Identifier: Apache-2.0
// The recordings of a machine: files NAME.mcap in one directory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body_source.hpp"
#include "core/byte_range.hpp"

namespace trunnion::gateway {

/// Letters, digits, dot, minus and underscore, not with a dot in front, `.mcap` at the end, at most 100
/// bytes.
bool is_recording_name(std::string_view name);

struct RecordingFile {
  std::string name;
  std::uint64_t size = 0;     ///< bytes
  std::int64_t modified = 0;  ///< ns since 1970-01-01 UTC
  /// In quotes: another one for every content.
  std::string etag() const;
};

/// Ascending by name; empty when there is no such directory.
std::vector<RecordingFile> recording_files(const std::filesystem::path& directory);
/// Nothing when there is none, `name` is no name of a recording, or it is a link.
std::optional<RecordingFile> recording_file(const std::filesystem::path& directory, std::string_view name);

/// The bytes of `range` of a file, in parts. Null when it cannot be opened. A file that has become shorter
/// meanwhile breaks.
std::shared_ptr<BodySource> file_part(const std::filesystem::path& path, const ByteRange& range);

}  // namespace trunnion::gateway
