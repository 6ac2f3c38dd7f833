// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>

#include "plc/machine/verify.hpp"
#include "plc/tools/source_run.hpp"

namespace trunnion::st {

/// The compilation itself, whose byte code must pass its check. Throws std::runtime_error with its messages.
inline const Compilation& checked(const Compilation& compilation) {
  if (!compilation.good()) throw std::runtime_error(testing::PrintToString(compilation.lines()));
  EXPECT_EQ(verify(*compilation.code), "");
  return compilation;
}

}  // namespace trunnion::st
