// SPDX-License-Identifier: Apache-2.0
#include "machine_check/machine_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace trunnion::machine_check {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

/// A copy of a delivered machine, changed.
class Copy {
 public:
  explicit Copy(const std::string& machine)
      : directory_(fs::path(testing::TempDir()) / ("machine_check-" + std::to_string(getpid()))) {
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    for (const auto& entry : fs::directory_iterator(fs::path(TRUNNION_MACHINES) / machine))
      if (entry.path().filename() != "recordings")
        fs::copy(entry.path(), directory_ / entry.path().filename(), fs::copy_options::recursive);
  }
  ~Copy() { fs::remove_all(directory_); }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  Copy& append(const std::string& file, const std::string& text) {
    std::ofstream(directory_ / file, std::ios::app) << text;
    return *this;
  }
  Copy& write(const std::string& file, const std::string& text) {
    std::ofstream(directory_ / file) << text;
    return *this;
  }
  Copy& remove(const std::string& file) {
    fs::remove_all(directory_ / file);
    return *this;
  }
  Copy& replace(const std::string& file, const std::string& from, const std::string& to) {
    std::ostringstream text;
    text << std::ifstream(directory_ / file).rdbuf();
    auto content = text.str();
    const auto at = content.find(from);
    EXPECT_NE(at, std::string::npos) << file << " does not have '" << from << "'";
    if (at != std::string::npos) content.replace(at, from.size(), to);
    return write(file, content);
  }
  /// Without the directory.
  std::vector<std::string> findings() const {
    std::vector<std::string> lines;
    for (const auto& finding : check_machine(directory_.string()).findings)
      lines.push_back(to_string(finding).substr(directory_.string().size() + 1));
    return lines;
  }
  std::string path() const { return directory_.string(); }

 private:
  fs::path directory_;
};

TEST(MachineCheck, EveryDeliveredMachineIsGood) {
  for (const auto& entry : fs::directory_iterator(TRUNNION_MACHINES)) {
    const auto report = check_machine(entry.path().string());
    for (const auto& finding : report.findings) ADD_FAILURE() << to_string(finding);
    EXPECT_EQ(report.name, entry.path().filename());
    EXPECT_GE(report.axes, 3u) << entry.path();
    EXPECT_GE(report.spindles, 1u) << entry.path();
  }
}

TEST(MachineCheck, SaysWhatItHasChecked) {
  const auto report = check_machine(TRUNNION_MACHINES "/two-channel");
  EXPECT_EQ(report.axes, 6u);
  EXPECT_EQ(report.spindles, 2u);
  EXPECT_EQ(report.channels, 2u);
  EXPECT_THAT(report.files, IsSupersetOf({"machine.yaml", "parameters.yaml", "tools.yaml",
                                          "work_offsets.yaml", "plc/devices.yaml"}));
}

// Line 2 of parameters.yaml is "040001", its value is in column 11.
TEST(MachineCheck, NamesTheLineOfTheParameterAndAllFindings) {
  Copy copy("two-channel");
  copy.replace("parameters.yaml", "\"040001\": 0", "\"040001\": 1")
      .replace("parameters.yaml", "\"041001\": 3", "\"041001\": 2")
      .replace("parameters.yaml", "\"100006\": 400", "\"100006\": -500");
  EXPECT_THAT(
      copy.findings(),
      ElementsAre("parameters.yaml:3:11: error: parameter 040002 (channel_axis): Y of channel 0 is axis 1 "
                  "(Y1), which is X of channel 0 already (parameter 040001): an axis has one letter of one "
                  "channel",
                  "parameters.yaml:7:11: error: parameter 041001 (channel_axis): X of channel 1 is axis 2 "
                  "(Z1), which is Z of channel 0 already (parameter 040003): an axis has one letter of one "
                  "channel",
                  "parameters.yaml:14:11: error: parameter 100007 (negative_limit): axis 0 (X1) has its "
                  "negative travel limit at -400 mm, which is not below the positive one at -500 mm "
                  "(parameter 100006)"));
}

// The reference point of no file: the limit that excludes it is named.
TEST(MachineCheck, NamesTheLineOfAnotherParameterWhereOneIsLeftAtItsDefault) {
  Copy copy("two-channel");
  copy.replace("parameters.yaml", "\"100007\": -400", "\"100007\": 10");
  EXPECT_THAT(copy.findings(), ElementsAre(HasSubstr("parameters.yaml:14:11: error: parameter 100012 "
                                                     "(reference_coordinate): axis 0 (X1)")));
}

TEST(MachineCheck, WhatTheChannelRefuses) {
  Copy copy("ac-table");
  copy.append("parameters.yaml", "\"040907\": 1\n");
  EXPECT_THAT(copy.findings(), ElementsAre(HasSubstr("040905 .. 040907: a linear axis is carried by more")));
  EXPECT_THAT(copy.findings()[0], testing::MatchesRegex("parameters.yaml:[0-9]+:11: error: .*"));
  Copy letter("ac-table");
  letter.replace("parameters.yaml", "\"040006\": 4", "\"040006\": -1");
  EXPECT_THAT(letter.findings(), ElementsAre(HasSubstr("turns C, which is no axis of the channel")));
  Copy compensation("ac-table");
  compensation.append("parameters.yaml", "\"300050\": 1\n\"300051\": 1\n\"300053\": 5\n\"300054\": 0\n");
  EXPECT_THAT(compensation.findings(),
              ElementsAre(testing::MatchesRegex(
                  "parameters.yaml:[0-9]+:11: error: parameter 300054 .straightness_first_interval. .*")));
}

TEST(MachineCheck, AGantryThatTheChannelRefusesIsNamedOnce) {
  Copy copy("gantry-cb-head");
  copy.replace("parameters.yaml", "\"102101\": 1", "\"102101\": 2");
  EXPECT_THAT(copy.findings(), ElementsAre(HasSubstr("an axis cannot follow itself")));
}

TEST(MachineCheck, WhatIsWrongInEachFile) {
  Copy copy("ac-table");
  copy.append("parameters.yaml", "\"100036\": 0\n\"999999\": 1\n")
      .write("tools.yaml", "- {number: 1, length: long}\n")
      .write("work_offsets.yaml", "- {channel: 0, offset: G99}\n")
      .append("plc/main.st", "PROGRAM wrong\nx := 1;\nEND_PROGRAM\n")
      .write("plc/modbus.yaml", "nothing: 1\n");
  const auto found = copy.findings();
  for (const auto* file :
       {"parameters.yaml:", "tools.yaml:1:", "work_offsets.yaml:1:", "plc/main.st:", "plc/modbus.yaml:1:"})
    EXPECT_THAT(found, testing::Contains(testing::StartsWith(file)));
}

// Without machine.yaml nothing else is known, but the other files are read.
TEST(MachineCheck, AMachineWithoutItsFiles) {
  Copy copy("ac-table");
  copy.remove("machine.yaml").write("tools.yaml", "x");
  EXPECT_THAT(copy.findings(), ElementsAre("machine.yaml: error: cannot be opened",
                                           testing::StartsWith("tools.yaml:1:1: error: ")));
  Copy bare("ac-table");
  bare.remove("parameters.yaml").remove("plc");
  EXPECT_THAT(bare.findings(),
              ElementsAre("parameters.yaml: error: cannot be opened", "plc: error: is no directory"));
}

// As `cp -r configs/machines/four-axis mine` leaves it.
TEST(MachineCheck, ALinkThatLeadsNowhereIsNamedOnce) {
  Copy copy("four-axis");
  copy.remove("plc").remove("parameters.yaml");
  for (const auto* name : {"plc", "parameters.yaml"})
    fs::create_symlink(fs::path("../ac-table") / name, fs::path(copy.path()) / name);
  EXPECT_THAT(copy.findings(),
              ElementsAre(testing::StartsWith("parameters.yaml: error: is a link to "),
                          "plc: error: is a link to '../ac-table/plc', which is not there: 'trunnion new "
                          "machine NAME --from MACHINE' copies a machine whole"));
}

TEST(MachineCheck, TheBodiesAndTheTruth) {
  Copy copy("ac-table");
  copy.append("bodies.yaml", "\nnothing: 1\n").write("truth.yaml", "nothing: 1\n");
  EXPECT_THAT(copy.findings(),
              ElementsAre(testing::StartsWith("bodies.yaml:"), testing::StartsWith("truth.yaml:1:1")));
  Copy none("ac-table");
  none.append("machine.yaml", "\ncollision: stop\n").remove("bodies.yaml");
  EXPECT_THAT(
      none.findings(),
      ElementsAre("bodies.yaml: error: the file is missing, and 'collision' in machine.yaml needs it"));
}

TEST(MachineCheck, AChainOfMachineYamlIsNamedThere) {
  Copy copy("four-axis");
  copy.append(
      "machine.yaml",
      "\nchains:\n  - channel: 0\n    elements:\n      - {name: A, rotary: A, direction: [-1, 0, 0]}\n"
      "      - {name: X, linear: X}\n      - {name: Y, linear: Y}\n      - {name: Z, linear: Z}\n");
  EXPECT_THAT(copy.findings(),
              ElementsAre(HasSubstr("parameter 040425 belongs to the kinematic chain of the channel")));
  copy.replace("parameters.yaml", "\"040425\": 3", "")
      .replace("parameters.yaml", "\"040429\": -1", "")
      .replace("parameters.yaml", "\"040436\": 4", "")
      .replace("parameters.yaml", "\"040437\": -380", "");
  EXPECT_THAT(copy.findings(), IsEmpty());
  copy.replace("machine.yaml", "- {name: A,", "- {name: O, offset: [0, 0, 1]}\n      - {name: A,");
  copy.replace("machine.yaml", "direction: [-1, 0, 0]", "direction: [0, 0, 0]");
  EXPECT_THAT(copy.findings(), ElementsAre(testing::StartsWith("machine.yaml:")));
}

// Of what is saved only that counts which no channel could start with.
TEST(MachineCheck, WhatUsersHaveSaved) {
  Copy copy("ac-table");
  const auto state = copy.path() + "/state";
  fs::create_directories(state);
  copy.write("state/parameters.yaml", "# saved\n\"100006\": -500\n\"040425\": 33\n");
  const auto found = check_machine(copy.path(), state).findings;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].file, state + "/parameters.yaml");
  EXPECT_THAT(found[0].text, HasSubstr("two rotary axes have the same letter"));
  EXPECT_THAT(check_machine(copy.path(), copy.path() + "/none").findings, IsEmpty());
}

TEST(MachineCheck, AGoodMachineMayStart) {
  EXPECT_NO_THROW(require_good(TRUNNION_MACHINES "/ac-table"));
  Copy copy("two-channel");
  copy.replace("parameters.yaml", "\"041001\": 3", "\"041001\": 2").write("tools.yaml", "x");
  try {
    require_good(copy.path());
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(),
                testing::ContainsRegex("tools.yaml:1:1: error: [^\n]*\n[^\n]*parameters.yaml:7:11: error: "));
  }
}

const char* const continues = "gateway_loss:\n  continue_with: {feed_hold: X200.0, emergency_stop: X200.1}\n";
const char* const reads_them = "feed_hold := feed_hold_button OR %X200.0 OR %X200.1;";

TEST(MachineCheck, AMachineRunsOnWithoutItsPageOnlyWithInputsThatHoldAndStop) {
  Copy copy("ac-table");
  copy.append("machine.yaml", continues);
  EXPECT_THAT(copy.findings(),
              ElementsAre(HasSubstr("feed_hold is X200.0, which no block of plc/modbus.yaml writes"),
                          HasSubstr("feed_hold is X200.0, which no program of the PLC reads"),
                          HasSubstr("emergency_stop is X200.1, which no block of plc/modbus.yaml writes"),
                          HasSubstr("emergency_stop is X200.1, which no program of the PLC reads")));
  copy.replace("plc/fast.st", "feed_hold := feed_hold_button;", reads_them)
      .write("plc/modbus.yaml", "server: {inputs: [{table: coils, address: 0, count: 1, at: X200.0}]}\n");
  EXPECT_THAT(copy.findings(),
              ElementsAre(HasSubstr("emergency_stop is X200.1, which no block of plc/modbus.yaml writes")));
  // A word is two bytes: X199 and X200.
  copy.write("plc/modbus.yaml",
             "server: {inputs: [{table: holding_registers, address: 0, count: 1, at: X199}]}\n");
  EXPECT_THAT(copy.findings(), IsEmpty());
}

// The panel of hal-sim-xyz is read as an array of bytes from X100 on.
TEST(MachineCheck, AnInputOfAnArrayIsRead) {
  Copy copy("hal-sim-xyz");
  copy.append("machine.yaml", "gateway_loss:\n  continue_with: {feed_hold: X100.5, emergency_stop: X24.0}\n");
  EXPECT_THAT(copy.findings(), IsEmpty());
}

}  // namespace
}  // namespace trunnion::machine_check
