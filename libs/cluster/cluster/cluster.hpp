// SPDX-License-Identifier: Apache-2.0
// Starting and stopping a cluster from the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/endpoint.hpp"
#include "cluster/cluster_files.hpp"
#include "cluster/executables.hpp"
#include "machine/machine.hpp"

namespace trunnion::cluster {

struct UpOptions {
  std::string machine;          ///< name or directory
  std::string vendor;           ///< empty, fastdds, cyclonedds or mixed
  std::string state_directory;  ///< empty: the default one; "temporary": inside the run directory
  std::optional<std::uint32_t> domain;
  bool own_domain = false;            ///< take a free one
  std::optional<std::uint16_t> port;  ///< absent: a free one with own_domain, else that of machine.yaml
  std::optional<bool> virtual_time;
  bool with_gateway = true;
  Executables executables;  ///< in the place of those beside the command
  std::string host;  ///< which host of machine.yaml this is; empty: the one with an address of this computer
  bool one_host = false;  ///< run everything here, whatever machine.yaml says of hosts
  bool foreground = false;
  bool keep_faulty = false;      ///< leave it running when a process names what must be corrected first
  bool take_over = false;        ///< end what a killed launcher has left
  bool of_this_process = false;  ///< it stops when the calling process ends, in whatever way
};

/// A cluster that is running, as its launcher wrote it down.
struct RunningCluster {
  RunDirectory run;
  std::string machine, machine_directory, state_directory;
  bool virtual_time = false;
  std::uint16_t port = 0;  ///< 0 without a gateway
  std::string host;        ///< which host this is; empty when the machine has none
  bus::NetworkSettings network;
  bool open = false;  ///< joined from other computers without security
  int session = 0;    ///< of the processes of a login or a terminal, getsid(2): the one that started it
  double start_seconds = 0;
  std::string fault;  ///< of one that was started and is not ready: what is to be corrected
};

/// Starts every process and waits until all are ready, or, with `keep_faulty`, until those that are not have
/// said what must be corrected. Throws std::runtime_error with one line; then nothing is left. Refused when
/// another cluster uses the state directory or the domain.
RunningCluster start_cluster(const UpOptions& options);
/// Writes down what find_cluster() gives: for the launcher, once it holds its locks.
void write_info(const RunningCluster& cluster);
/// Stops every process and removes the cluster's files; false when some process had to be killed.
void stop_cluster(const RunDirectory& run);
/// How a process takes part in the cluster of this computer in `domain`; the loopback when none is known.
bus::NetworkSettings network_in(std::uint32_t domain);
/// Of this user on this computer, by domain. One that has only begun to start is not among them.
std::vector<RunningCluster> running_clusters();
/// Throws std::runtime_error when there is none (or several and no domain was given).
RunningCluster find_cluster(std::optional<std::uint32_t> domain);

}  // namespace trunnion::cluster
