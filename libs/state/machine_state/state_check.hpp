// SPDX-License-Identifier: Apache-2.0
// What is in a state directory, and what of it can be used.
#pragma once

#include <string>
#include <vector>

#include "storage/kept_text.hpp"

namespace trunnion::machine_state {

enum class Kind { text, memory, program, journal };
const char* name_of(Kind kind);

/// One file, or the two files of a cyclic memory.
struct FileReport {
  std::string name;  ///< below the state directory
  Kind kind = Kind::text;
  storage::KeptState state = storage::KeptState::good;
  std::uint64_t generation = 0;  ///< of texts; 0: of a version without generations
  std::string problem;           ///< empty when nothing is wrong with it
};

/// Reads every kept file; changes nothing. Ascending by name. Throws storage::StorageError when the directory
/// or a file cannot be read.
std::vector<FileReport> check_state(const std::string& directory);

/// The files that make up the state, both generations, ascending: what a backup has. Not the run-time files
/// of a cluster, and not what was put aside as damaged.
std::vector<std::string> state_files(const std::string& directory);

/// The operator takes a file as it is now: a text whose last line was removed or no longer fits becomes a new
/// generation, a program is adopted at the next start. `name` is below the directory. Throws
/// std::runtime_error.
void accept(const std::string& directory, const std::string& name);

}  // namespace trunnion::machine_state
