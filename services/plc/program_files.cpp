// SPDX-License-Identifier: Apache-2.0
#include "program_files.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "compiler.hpp"

namespace trunnion::plc {

void load_programs(const std::string& directory, PlcCore& core) {
  Compiler compiler(interface_symbols());
  Program programs[2];
  const char* names[] = {"/fast.il", "/main.il"};
  for (int i = 0; i < 2; ++i) {
    const auto path = directory + names[i];
    if (!std::filesystem::exists(path)) throw std::runtime_error(path + ": error: cannot be opened");
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    programs[i] = compiler.compile(text.str(), path);
  }
  core.load(std::move(programs[0]), std::move(programs[1]));
}

}  // namespace trunnion::plc
