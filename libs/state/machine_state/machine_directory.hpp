// SPDX-License-Identifier: Apache-2.0
// The directory of a machine in a backup: machine.yaml, parameters, tools, PLC sources, programs.
#pragma once

#include <string>
#include <vector>

#include "machine_state/file_set.hpp"

namespace trunnion::machine_state {

/// What makes up the machine: neither recordings, keys and certificates nor what is hidden. Throws
/// std::runtime_error.
FileSet machine_files(const std::string& directory);

/// A name that machine_files() can give: it leads to no place outside the directory.
bool is_machine_file(const std::string& name);

/// The names of files that are in one of them only or not the same in both.
std::vector<std::string> differing_files(const FileSet& a, const FileSet& b);

/// Makes the directory, with all the files or not at all. Throws std::runtime_error when it is there already
/// and not empty.
void make_machine(const FileSet& files, const std::string& directory);

}  // namespace trunnion::machine_state
