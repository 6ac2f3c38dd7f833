// SPDX-License-Identifier: Apache-2.0
// A PLC core with programs in Structured Text, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "force_request.hpp"
#include "machine/parameters.hpp"
#include "places.hpp"
#include "plc/tools/value_text.hpp"
#include "programs.hpp"

namespace trunnion::plc {

inline constexpr const char* empty_fast = "PROGRAM fast\nEND_PROGRAM\n";
inline constexpr const char* counting =
    "PROGRAM main\n"
    "VAR scans : UDINT; timer : TON; limit : INT := 7; last : BOOL; list : ARRAY[1..3] OF INT; END_VAR\n"
    "VAR RETAIN hours : UDINT; END_VAR VAR CONSTANT most : UDINT := 3; END_VAR\n"
    "scans := scans + 1; timer(IN := %X16.0, PT := T#1s); %Y16.0 := timer.Q; list[2] := limit;\n"
    "%W50 := UDINT_TO_UINT(scans); last := %Y17.0; %Y17.0 := %X16.1; hours := hours + most;\n"
    "END_PROGRAM\n";

inline machine::Parameters axis_parameters() {
  machine::Parameters p;
  p.values[100000] = {0, "X"};
  return p;
}

inline Programs programs_of(const std::string& main) {
  return translate({{"fast.st", empty_fast}, {"main.st", main}}, true);
}

struct Running {
  explicit Running(const std::string& main) {
    auto programs = programs_of(main);
    variables = programs.variables;
    core.configure(axis_parameters(), true);
    core.load(std::move(programs));
    core.advance(1000);
  }
  std::string force(const std::string& path, const std::string& value, bool permanent = false) {
    idl::plc::OnlineRequest request;
    request.action = idl::plc::OnlineAction::FORCE;
    request.paths = {path}, request.values = {value}, request.permanent = permanent;
    return change_forces(request, variables, core);
  }
  std::string release(const std::vector<std::string>& paths) {
    idl::plc::OnlineRequest request;
    request.action = idl::plc::OnlineAction::RELEASE;
    request.paths = paths;
    return change_forces(request, variables, core);
  }
  std::string value(const std::string& path) const {
    const auto at = variables.find(path);
    std::vector<std::uint64_t> cells(at.type->cells);
    copy_value(core.memory(), place_of(at), cells);
    return st::value_text(*at.type, cells);
  }
  void input(std::uint32_t byte, std::uint32_t value) {
    idl::plc::PanelRequest request;
    request.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
    request.address = byte, request.value = value;
    EXPECT_EQ(core.panel(request), "");
  }
  /// In steps: no scan is skipped to catch up.
  void pass(std::uint64_t ticks) {
    for (; ticks > 10; ticks -= 10) core.advance(core.memory().tick + 10);
    core.advance(core.memory().tick + ticks);
  }

  PlcCore core;
  st::Variables variables;
};

}  // namespace trunnion::plc
