// Comparing whole streams with what they should be.
#pragma once

#include <gmock/gmock.h>

#include <span>

#include "test_machine.hpp"

namespace trunnion::language::test {

inline void expect_streams(TestMachine& machine, std::span<const Golden> goldens) {
  for (const Golden& golden : goldens) {
    EXPECT_THAT(stream(run(machine, golden.program)), testing::ElementsAreArray(golden.commands))
        << golden.rule << "\n"
        << golden.program;
  }
}

}  // namespace trunnion::language::test
