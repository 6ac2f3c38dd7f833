// SPDX-License-Identifier: Apache-2.0
#include "program_files.hpp"

namespace trunnion::plc {

std::vector<std::string> load_programs(const std::string& directory, PlcCore& core, bool simulated) {
  auto programs = translate(read_sources(directory), simulated, directory + "/");
  auto warnings = programs.warnings;
  core.load(std::move(programs));
  return warnings;
}

}  // namespace trunnion::plc
