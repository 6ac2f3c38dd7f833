// SPDX-License-Identifier: Apache-2.0
// Where machines, executables and the files of a running cluster are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trunnion::cluster {

/// Directory of this executable and of the services beside it.
std::string binary_directory();
/// A directory with machine.yaml, or the name of a machine under configs/machines. Throws std::runtime_error.
std::string find_machine(const std::string& name);
/// The built page, or empty.
std::string web_directory();
/// <XDG_STATE_HOME or ~/.local/state>/trunnion/<machine>. Throws std::runtime_error when there is no home.
std::string default_state_directory(const std::string& machine);

/// What was swapped for what, one JSON object per line, in the state directory.
inline constexpr const char* swap_journal_file = "swaps.jsonl";

/// Where the run directories of this user are. Nothing that is to survive may be below it.
std::string run_directory_base();

/// Whether the process of this number lives and is a launcher.
bool is_launcher(int pid);

/// Files of one running cluster; all of them are gone after `down`.
struct RunDirectory {
  std::uint32_t domain = 0;
  std::string path() const;
  std::string pid_file() const { return path() + "/launcher.pid"; }
  std::string info_file() const { return path() + "/cluster.json"; }
  /// Locked by those who record.
  std::string recording_file() const { return path() + "/recording.lock"; }
  std::string log_file(const std::string& service) const { return path() + "/" + service + ".log"; }
  /// Process id of the launcher when it is alive.
  std::optional<int> launcher() const;
  /// A cluster has run here whose launcher was killed, so that nobody cleared up.
  bool abandoned() const;
  /// Where this process keeps the files of a verification.
  std::string verification() const;
  /// Some process that is alive has such a place here.
  bool verifies() const;
  /// Makes the directory, which only this user can enter. Throws std::runtime_error when it is another
  /// user's.
  void make() const;
  void remove() const;
};

/// A domain in 80 .. 99 that no cluster of this computer runs in. Throws std::runtime_error when all are
/// still taken after `timeout` seconds.
std::uint32_t free_domain(double timeout = 0);
/// Of every cluster of this user, running or abandoned, by domain.
std::vector<RunDirectory> run_directories();

}  // namespace trunnion::cluster
