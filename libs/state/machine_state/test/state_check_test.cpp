// SPDX-License-Identifier: Apache-2.0
// What is reported of a state directory: every kind of file, every damage of each.
#include "state_fixture.hpp"

namespace trunnion::machine_state {
namespace {

using testing_support::Damage;
class StateCheck : public StateFixture {};

TEST_F(StateCheck, AWholeStateIsListedWithGenerations) {
  EXPECT_EQ(problems(state()), "");
  std::string names;
  for (const auto& report : check_state(state()))
    names += report.name + " " + name_of(report.kind) + " " + std::to_string(report.generation) + "\n";
  EXPECT_EQ(
      names,
      "channel-0.variables text 2\nencoders.bin memory 0\njournal.jsonl journal 0\nparameters.yaml text 2\n"
      "programs.yaml text 1\nprograms/part.nc program 1\ntools.yaml text 2\n");
}

TEST_F(StateCheck, EveryDamageOfEveryFileIsReportedByItsName) {
  const auto old = root_ + "/old";
  fill(old);
  for (const std::string name :
       {"parameters.yaml", "tools.yaml", "channel-0.variables", "programs.yaml", "programs/part.nc",
        "encoders.bin", "encoders.bin.previous", "tools.yaml.previous"})
    for (const auto how : testing_support::all_damages) {
      // Of a text whose previous generation is gone or old nothing is lost.
      if (name == "tools.yaml.previous" && (how == Damage::missing || how == Damage::old_generation))
        continue;
      std::filesystem::remove_all(state());
      fill(state());
      auto earlier =
          testing_support::read_bytes(old + "/" + name + (name.ends_with(".yaml") ? ".previous" : ""));
      if (name == "programs/part.nc") earlier = "G0 X0\n";
      if (name == "channel-0.variables")
        earlier = testing_support::read_bytes(old + "/" + name + ".previous");
      if (name.starts_with("encoders.bin") && how == Damage::old_generation) {
        for (int i = 0; i < 2; ++i)
          storage::RetainedPair(state() + "/encoders.bin", "encoders", 64)
              .open(std::vector<std::uint8_t>(64, 8));
      }
      testing_support::damage(state() + "/" + name, how, earlier,
                              testing_support::read_bytes(old + "/journal.jsonl"), 11);
      const auto found = problems(state());
      const auto expected = name == "encoders.bin.previous" ? "encoders.bin" : name;
      EXPECT_TRUE(found.starts_with(expected + ": ")) << name << " " << name_of(how) << ": " << found;
    }
}

TEST_F(StateCheck, AnEditedTextIsTakenWhenTheOperatorAcceptsIt) {
  auto text = testing_support::read_bytes(state() + "/tools.yaml");
  text.replace(text.find("value: 2"), 8, "value: 9");
  testing_support::write_bytes(state() + "/tools.yaml", text);
  EXPECT_EQ(problems(state()), "tools.yaml: its checksum is wrong\n");
  accept(state(), "tools.yaml");
  EXPECT_EQ(problems(state()), "");
  EXPECT_EQ(storage::read_kept(state() + "/tools.yaml").content, "value: 9\n");
  EXPECT_EQ(storage::read_kept(state() + "/tools.yaml").generation, 2u) << "behind the previous one, 1";
}

TEST_F(StateCheck, AnEditedProgramIsTakenWhenTheOperatorAcceptsIt) {
  std::ofstream(state() + "/programs/part.nc") << "M30\n";
  EXPECT_EQ(problems(state()), "programs/part.nc: it does not match its checksum\n");
  accept(state(), "programs/part.nc");
  EXPECT_EQ(problems(state()), "");
}

TEST_F(StateCheck, ADirectoryInThePlaceOfAFileIsNamed) {
  for (const std::string name : {"journal.jsonl", "tools.yaml"}) {
    std::filesystem::remove(state() + "/" + name);
    std::filesystem::create_directories(state() + "/" + name);
  }
  EXPECT_TRUE(std::filesystem::exists(state() + "/tools.yaml.previous")) << "which is a file";
  EXPECT_EQ(problems(state()),
            "journal.jsonl: it is no file: move it away\ntools.yaml: it is no file: move it away\n");
}

TEST_F(StateCheck, NothingElseCanBeAccepted) {
  for (const auto* name : {"encoders.bin", "../state/tools.yaml", "none.yaml", "cluster.boot"})
    EXPECT_THROW(accept(state(), name), std::runtime_error) << name;
}

TEST_F(StateCheck, FilesOfTheVersionBeforeAreGood) {
  std::filesystem::remove_all(state());
  std::filesystem::create_directories(state());
  std::ofstream(state() + "/tools.yaml") << "revision: 1\n";
  std::ofstream(state() + "/encoders.bin") << std::string(696, 'x');
  EXPECT_EQ(problems(state()), "");
}

}  // namespace
}  // namespace trunnion::machine_state
