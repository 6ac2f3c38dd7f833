// SPDX-License-Identifier: Apache-2.0
// The files of a directory with what is in them.
#pragma once

#include <map>
#include <string>

namespace trunnion::machine_state {

/// By their names below the directory, '/' between folders.
using FileSet = std::map<std::string, std::string>;

/// Throws storage::StorageError.
std::string read_file(const std::string& path);
/// Into `directory`, which has nothing else then; on the disk when it returns. Throws storage::StorageError.
void write_files(const std::string& directory, const FileSet& files);

}  // namespace trunnion::machine_state
