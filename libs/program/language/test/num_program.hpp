// SPDX-License-Identifier: Apache-2.0
// Programs of the NUM dialect and the streams that they give.
#pragma once

#include <string>
#include <vector>

#include "test_machine.hpp"

namespace trunnion::language::test {

inline TestMachine num_machine() {
  TestMachine machine;
  machine.dialect = ProgramDialect::num;
  return machine;
}

inline std::vector<std::string> num_stream(const std::string& program) {
  TestMachine machine = num_machine();
  return stream(run(machine, program));
}

}  // namespace trunnion::language::test
