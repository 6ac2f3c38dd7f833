// SPDX-License-Identifier: Apache-2.0
// The parameters of macros: codes that call programs, and what PRM reads.
#include "channel_setup/macro_settings.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "channel_setup/channel_setup.hpp"
#include "parameter_store/tool_tables.hpp"

namespace trunnion::channel_setup::macro_settings_test {
namespace {

TEST(MacroSettings, WithoutParametersNoCodeCalls) {
  const auto settings = macro_settings({}, 0);
  EXPECT_EQ(settings.calls, language::CodeCalls{});
  EXPECT_TRUE(settings.prints_blanks);
  EXPECT_FALSE(settings.offsets_by_axis);
}

TEST(MacroSettings, AreThoseOfTheChannel) {
  machine::Parameters parameters;
  parameters.values[41691].value = 150;
  parameters.values[41700].value = 6;
  parameters.values[41718].value = 60;
  parameters.values[41719].value = 1;
  parameters.values[41721].value = 0;
  const auto settings = macro_settings(parameters, 1);
  EXPECT_EQ(settings.calls.g[1], 150);
  EXPECT_EQ(settings.calls.m[0], 6);
  EXPECT_EQ(settings.calls.m_subprograms[8], 60);
  EXPECT_TRUE(settings.calls.t);
  EXPECT_FALSE(settings.calls.s);
  EXPECT_FALSE(settings.prints_blanks);
  EXPECT_EQ(macro_settings(parameters, 0).calls, language::CodeCalls{});
}

TEST(MacroSettings, CodesThatCallOrEndProgramsAreRefusedByTheirParameter) {
  const auto refusal = [](std::uint32_t number, double code) {
    machine::Parameters parameters;
    parameters.values[number].value = code;
    try {
      macro_settings(parameters, 0);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(40690, 65),
            "parameter 040690 (macro_g_code): G65 belongs to the control and calls no other program");
  EXPECT_NE(refusal(40699, 67), "");
  EXPECT_NE(refusal(40700, 30), "");
  EXPECT_NE(refusal(40710, 99), "");
  EXPECT_EQ(refusal(40690, 30), "");
}

TEST(ChannelSetup, AProgramReadsNumbersOfParametersAndNoTexts) {
  auto tables = tool_tables::load_machine_tables(MACHINES_DIRECTORY "/ac-table");
  tables.parameters.values[40030].value = 1234;
  const ChannelSetup setup(tables);
  EXPECT_EQ(setup.parameter(40030), 1234);
  EXPECT_EQ(setup.parameter(40910), 1) << "the default";
  EXPECT_EQ(setup.parameter(40944), std::nullopt) << "a text";
  EXPECT_EQ(setup.parameter(1320), std::nullopt) << "of another control";
}

}  // namespace
}  // namespace trunnion::channel_setup::macro_settings_test
