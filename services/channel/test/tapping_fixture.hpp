// SPDX-License-Identifier: Apache-2.0
// A channel with a spindle that taps, for its unit tests.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "channel_fixture.hpp"

namespace trunnion::channel::tapping_test {

using idl::channel::CommandKind;
using testing::Channel;

// R 2, depth -10, lead 1.25: the hole is 12 mm, 9.6 turns.
inline const std::string hole = "G90 G94 G0 Z5\nS400 M3\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nG0 Z20\nM30\n";

struct Tap : Channel {
  // A spindle that gains 2000 1/min in a second: 12000 deg/s2.
  void SetUp() override {
    parameters->values[105000] = {0, "S"}, parameters->values[105001] = {10, ""};
    parameters->values[105036] = {12000, ""};
    begin();
  }
  void start(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  void by_hand(const std::string& line) {
    ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI).accepted);
    ASSERT_TRUE(ask(CommandKind::MDI_LINE, line).accepted);
    run();
  }
  /// A reset in the hole leaves the tap there.
  void leave_tap_in_hole() {
    cycles_per_round = 8;
    start(hole);
    while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
    ask(CommandKind::RESET);
    run();
  }
  /// Rows in which the spindle was coupled, as (Z, revolutions).
  std::vector<std::pair<double, double>> coupled() const {
    std::vector<std::pair<double, double>> result;
    for (std::size_t i = 0; i < drive.rows.size(); ++i)
      if (drive.spindle[i]) result.emplace_back(drive.rows[i][2], *drive.spindle[i]);
    return result;
  }
  std::vector<int> m_codes() const {
    std::vector<int> codes;
    for (const auto& a : auxiliaries)
      if (a.kind == idl::channel::AuxiliaryKind::M) codes.push_back(static_cast<int>(a.code));
    return codes;
  }
};

}  // namespace trunnion::channel::tapping_test
