// Starting and stopping a cluster from the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cluster_files.hpp"
#include "machine/machine.hpp"

namespace trunnion::deploy {

struct UpOptions {
  std::string machine;          ///< name or directory
  std::string vendor;           ///< empty, fastdds, cyclonedds or mixed
  std::string state_directory;  ///< empty: the default one; "temporary": inside the run directory
  std::optional<std::uint32_t> domain;
  bool own_domain = false;  ///< take a free one
  std::optional<std::uint16_t> port;
  std::optional<bool> virtual_time;
  bool with_gateway = true;
  bool foreground = false;
};

/// A cluster that is running, as its launcher wrote it down.
struct RunningCluster {
  RunDirectory run;
  std::string machine, machine_directory, state_directory;
  bool virtual_time = false;
  std::uint16_t port = 0;  ///< 0 without a gateway
  double start_seconds = 0;
};

/// Starts every process and waits until all are ready. Throws std::runtime_error with one line; then nothing
/// is left.
RunningCluster start_cluster(const UpOptions& options);
/// Stops every process and removes the cluster's files; false when some process had to be killed.
void stop_cluster(const RunDirectory& run);
/// Throws std::runtime_error when there is none (or several and no domain was given).
RunningCluster find_cluster(std::optional<std::uint32_t> domain);

}  // namespace trunnion::deploy
