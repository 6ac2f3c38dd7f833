// SPDX-License-Identifier: Apache-2.0
#include "plc/online/shown_variables.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace trunnion::plc_online {
namespace {

using idl::plc::ValueKind;
using idl::plc::VariableInfo;

VariableInfo variable(const char* path, const char* type, ValueKind kind, std::uint16_t cells = 1) {
  VariableInfo info;
  info.path = path, info.type = type, info.kind = kind, info.cells = cells;
  return info;
}

TEST(ShownVariables, EachKindIsALiteralOfTheLanguage) {
  auto state = variable("main.state", "State", ValueKind::ENUMERATED_VALUE);
  state.names = {{"idle", 0}, {"moving", 3}};
  const ShownVariables shown({variable("main.on", "BOOL", ValueKind::BOOL_VALUE),
                              variable("main.n", "INT", ValueKind::SIGNED_VALUE),
                              variable("main.x", "LREAL", ValueKind::LREAL_VALUE),
                              variable("main.wait", "TIME", ValueKind::DURATION_VALUE),
                              variable("main.name", "STRING[8]", ValueKind::STRING_VALUE, 2), state});
  EXPECT_EQ(shown.cells(), 7u) << "one each, and two of the string";
  // "ab" is two bytes: its length, then 'a' (97) lowest and 'b' (98) next.
  const std::vector<std::uint64_t> cells = {
      1, static_cast<std::uint64_t>(-5), std::bit_cast<std::uint64_t>(1.5), 1500000000, 2, 97 + 98 * 256, 3};
  EXPECT_EQ(shown.texts(cells),
            (std::vector<std::string>{"TRUE", "-5", "1.5", "T#1s500ms", "'ab'", "moving"}));
}

TEST(ShownVariables, JsonHasUnitAndNamesOnlyWhereThereAreSome) {
  auto state = variable("main.state", "State", ValueKind::ENUMERATED_VALUE);
  state.names = {{"idle", 0}}, state.retained = true;
  EXPECT_EQ(
      json_of(state),
      bus::Json({{"path", "main.state"}, {"type", "State"}, {"retained", true}, {"names", {{"idle", 0}}}}));
  auto speed = variable("%G300", "UINT", ValueKind::UNSIGNED_VALUE);
  speed.unit = "rpm";
  EXPECT_EQ(json_of(speed),
            bus::Json({{"path", "%G300"}, {"type", "UINT"}, {"unit", "rpm"}, {"retained", false}}));
  EXPECT_EQ(ShownVariables({speed}).json().size(), 1u);
}

}  // namespace
}  // namespace trunnion::plc_online
