// SPDX-License-Identifier: Apache-2.0
// The recorder: writes every topic of the cluster to one file, without a part in the stream.
#pragma once

#include <string>
#include <vector>

#include "bus/endpoint.hpp"
#include "contracts/types.hpp"
#include "part_files.hpp"
#include "recording/disk_space.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::recorder {

constexpr auto default_free_space =
    static_cast<std::uint64_t>(recording::default_free_megabytes * recording::bytes_per_megabyte);

struct Options {
  std::string output;
  std::string machine;              ///< name, for the file's metadata
  std::vector<std::string> topics;  ///< handles or names; empty = all
  bus::Vendor vendor = bus::Vendor::cyclonedds;
  bus::NetworkSettings network;
  double duration = 0;  ///< s; 0 = until a signal
  std::size_t queue_mebibytes = 256;
  /// Bytes; with less no recording starts. SpaceWatch; 0 = it is not checked.
  std::uint64_t free_space = default_free_space;
  recording::Compression compression = recording::Compression::zstd;
  PartLimits parts;
  double last = 0;   ///< s; above 0: a flight recorder, which saves this time before an alarm
  double after = 1;  ///< s saved after the alarm
  idl::service::Severity severity = idl::service::Severity::WARNING;  ///< the least that saves
  std::size_t memory_mebibytes = 256;                                 ///< of the flight recorder
  bool json = false;
  bool parent_bound = false;
};

/// Records until SIGTERM, SIGINT or the end of the duration; returns the exit status: 0, or 1 when something
/// is missing from the file. Throws std::runtime_error when it cannot start.
int record(const Options& options);

}  // namespace trunnion::recorder
