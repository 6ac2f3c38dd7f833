// SPDX-License-Identifier: Apache-2.0
// A machine as a whole, by the files of its folder: what its services would refuse one after the other, some
// of it only after their start.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trunnion::machine_check {

struct Finding {
  std::string file;
  int line = 0, column = 0;  ///< from 1; 0: of the file as a whole, or of something that is missing in it
  std::string text;          ///< what, where, value and limits
  bool operator==(const Finding&) const = default;
};
/// "file:line:column: error: text", without what is 0.
std::string to_string(const Finding& finding);

/// A finding for each link in the folder that leads nowhere, as in a folder that was copied away from the one
/// its links lead to.
std::vector<Finding> broken_links(const std::string& directory);

struct MachineReport {
  std::vector<Finding> findings;
  std::string name;      ///< of the machine
  std::size_t axes = 0;  ///< servo axes
  std::size_t spindles = 0;
  std::size_t channels = 0;
  std::vector<std::string> files;  ///< that were read, relative to the folder
};

/// Throws nothing for what is in the files: of the parameters every error is a finding, of other files the
/// first. With `state_directory` also what the parameters that users have saved there would keep a channel
/// from.
MachineReport check_machine(const std::string& directory, const std::string& state_directory = "");

/// Throws std::runtime_error with a line for each finding of check_machine(). What is saved does not count:
/// only a machine that runs can correct it.
void require_good(const std::string& directory);

}  // namespace trunnion::machine_check
