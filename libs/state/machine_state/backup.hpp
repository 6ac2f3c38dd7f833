// SPDX-License-Identifier: Apache-2.0
// The whole state of a machine and the files that make it up in one file: a tar archive with a list of its
// files, their sizes and checksums.
#pragma once

#include <string>

#include "machine_state/file_set.hpp"

namespace trunnion::machine_state {

/// Version of the layout of a backup. Version 1 has the state only. What it contains states its own formats
/// (storage::kept_format), and the services read older ones, so older backups need no migration.
inline constexpr unsigned backup_format = 2;

struct Backup {
  std::string machine;  ///< its name
  std::string version;  ///< of the product that wrote it
  std::string time;     ///< ISO 8601, UTC
  FileSet files;        ///< of the state directory
  FileSet
      configuration;  ///< of the machine's directory (machine_directory.hpp); none in a backup of format 1
};

/// The state in `directory` now, of a cluster that runs or not. Throws std::runtime_error when something in
/// it is damaged.
Backup collect(const std::string& directory, const std::string& machine, const std::string& version,
               const std::string& time);

/// The bytes of the archive, and back. Throws std::runtime_error with one line when they are no backup, of a
/// newer format, incomplete or damaged.
std::string write_backup(const Backup& backup);
Backup read_backup(const std::string& bytes);

/// Puts the files in the place of the state directory in one step; after a crash at any instant it is old or
/// new. Returns the directory beside it where the old state is now, empty when there was none. The caller
/// holds the lock of the directory. Throws std::runtime_error, and the state is as before then.
std::string restore(const Backup& backup, const std::string& directory);

}  // namespace trunnion::machine_state
