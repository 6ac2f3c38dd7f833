// SPDX-License-Identifier: Apache-2.0
// The space of a recording on its disk.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trunnion::recording {

constexpr std::uint64_t bytes_per_megabyte = 1'000'000;
/// Free space in MB below which no recording starts, unless it is set otherwise.
constexpr double default_free_megabytes = 200;

/// "850 kB", "12.5 MB", "1.3 GB".
std::string size_text(std::uint64_t bytes);

/// Bytes that a process without special rights can still write to the disk of the file `path`, which need not
/// exist. Nothing when that is unknown, and for a pipe or a device.
std::optional<std::uint64_t> free_space(const std::string& path);

/// Why a recording to `path` must not start with `free` bytes: one line; empty when it may.
std::string space_refusal(const std::string& path, std::uint64_t free, std::uint64_t needed);

}  // namespace trunnion::recording
