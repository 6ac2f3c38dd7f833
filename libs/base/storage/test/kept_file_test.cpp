// SPDX-License-Identifier: Apache-2.0
// Kept texts: the last line that proves them, every damage on a real disk, a kill at every step of a write.
#include "storage/kept_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "storage/file.hpp"
#include "testing_support/damage.hpp"

namespace trunnion::storage {
namespace {

using testing_support::Damage;
using testing_support::read_bytes;
using testing_support::write_bytes;

TEST(KeptText, IsTheContentAndOneReadableLine) {
  const auto text = seal("tools.yaml", 7, "revision: 3\n");
  EXPECT_TRUE(text.starts_with("revision: 3\n# trunnion-state format=1 file=tools.yaml generation=7 crc32="));
  std::string problem;
  const auto back = unseal("tools.yaml", text, problem);
  ASSERT_TRUE(back) << problem;
  EXPECT_EQ(back->content, "revision: 3\n");
  EXPECT_EQ(back->generation, 7u);
}

TEST(KeptText, GivesBackEveryContentToTheByte) {
  const std::vector<std::string> contents = {
      "", "\n", "a", "a\n", "a\n\n", "a\n# b", std::string("\0\xff\n\n x", 6)};
  for (const auto& content : contents) {
    std::string problem;
    const auto back = unseal("f", seal("f", 1, content), problem);
    ASSERT_TRUE(back) << problem;
    EXPECT_EQ(back->content, content);
  }
}

TEST(KeptText, FindsEveryFlippedBitAndEveryTruncation) {
  const auto text = seal("f", 12, "100000: X\n\"100034\": 25000\n");
  std::string problem;
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    auto damaged = text;
    damaged[bit / 8] ^= static_cast<char>(1 << bit % 8);
    EXPECT_FALSE(unseal("f", damaged, problem)) << "bit " << bit;
  }
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(unseal("f", text.substr(0, size), problem)) << size << " bytes";
}

TEST(KeptText, SaysWhatIsWrong) {
  std::string problem;
  unseal("a", seal("b", 1, "x\n"), problem);
  EXPECT_EQ(problem, "it has the content of b");
  unseal("a", "x: 1\n", problem);
  EXPECT_EQ(problem, "its last line, with the checksum, is missing");
  EXPECT_EQ(decide("a", std::nullopt, "half", false).problem,
            "it is missing; of its previous generation: its last line is incomplete");
}

class KeptFileTest : public testing::Test {
 protected:
  KeptFileTest() : directory_(testing::TempDir() + "kept_" + std::to_string(getpid())) {
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  ~KeptFileTest() override { std::filesystem::remove_all(directory_); }
  std::string path(const std::string& name = "tools.yaml") const { return directory_ + "/" + name; }
  std::string directory_;
};

TEST_F(KeptFileTest, IsAbsentOnANewMachineOnly) {
  EXPECT_EQ(read_kept(path()).state, KeptState::absent);
  write_kept(path(), "one\n");
  std::filesystem::remove(path());
  EXPECT_EQ(read_kept(path()).state, KeptState::previous) << "the first generation has a copy";
  EXPECT_EQ(read_kept(path()).content, "one\n");
}

TEST_F(KeptFileTest, KeepsThePreviousGeneration) {
  write_kept(path(), "one\n");
  write_kept(path(), "two\n");
  const auto kept = read_kept(path());
  EXPECT_EQ(kept.state, KeptState::good);
  EXPECT_EQ(kept.content, "two\n");
  EXPECT_EQ(kept.generation, 2u);
  std::string problem;
  EXPECT_EQ(unseal("tools.yaml", read_bytes(path() + previous_suffix), problem)->content, "one\n");
}

TEST_F(KeptFileTest, UsesThePreviousGenerationAfterEveryDamageAndIsGoodAfterTheRepair) {
  for (const auto how : testing_support::all_damages) {
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
    write_kept(path(), "one\n");
    write_kept(path(), "two\n");
    const auto old = read_bytes(path());
    write_kept(path(), "three\n");
    testing_support::damage(path(), how, old, seal("work_offsets.yaml", 3, "three\n"), 5);
    const auto kept = read_kept(path());
    EXPECT_EQ(kept.state, KeptState::previous) << name_of(how);
    EXPECT_EQ(kept.content, "two\n") << name_of(how);
    EXPECT_FALSE(kept.problem.empty());
    repair_kept(path(), kept);
    EXPECT_EQ(read_kept(path()).state, KeptState::good) << name_of(how) << read_kept(path()).problem;
    EXPECT_EQ(read_kept(path()).content, "two\n");
    EXPECT_EQ(std::filesystem::exists(path() + damaged_suffix), how != Damage::missing);
  }
}

TEST_F(KeptFileTest, ANewerPreviousGenerationShowsThatTheFileIsAnOldCopy) {
  write_kept(path(), "one\n");
  const auto old = read_bytes(path());
  for (const auto* content : {"two\n", "three\n", "four\n"}) write_kept(path(), content);
  write_bytes(path(), old);  // generation 1 beside generation 3
  const auto kept = read_kept(path());
  EXPECT_EQ(kept.state, KeptState::previous);
  EXPECT_EQ(kept.content, "three\n");
  EXPECT_EQ(kept.problem, "it is an old copy of generation 1");
}

TEST_F(KeptFileTest, WithBothGenerationsDamagedNothingIsUsedAndAWriteMakesItGood) {
  write_kept(path(), "one\n");
  write_bytes(path(), "x");
  write_bytes(path() + previous_suffix, "");
  EXPECT_EQ(read_kept(path()).state, KeptState::unusable);
  write_kept(path(), "entered again\n");
  EXPECT_EQ(read_kept(path()).state, KeptState::good);
  EXPECT_EQ(read_kept(path()).content, "entered again\n");
  EXPECT_EQ(read_bytes(path() + damaged_suffix), "x") << "put aside, not lost";
}

TEST_F(KeptFileTest, AFileOfTheVersionBeforeIsTakenAndBecomesThePreviousGeneration) {
  write_bytes(path(), "revision: 1\n");
  EXPECT_EQ(read_kept(path()).state, KeptState::good);
  EXPECT_EQ(read_kept(path()).generation, 0u);
  write_kept(path(), "revision: 2\n");
  write_bytes(path(), "");
  EXPECT_EQ(read_kept(path()).content, "revision: 1\n");
}

// The states of the directory between the steps of publish_kept().
TEST_F(KeptFileTest, ACrashBetweenTwoStepsOfAWriteLosesNothing) {
  write_kept(path(), "one\n");
  write_kept(path(), "two\n");
  prepare_kept(path(), "three\n");
  EXPECT_EQ(read_kept(path()).content, "two\n");
  std::filesystem::remove(path() + previous_suffix);
  EXPECT_EQ(read_kept(path()).state, KeptState::good);
  std::filesystem::create_hard_link(path(), path() + previous_suffix);
  EXPECT_EQ(read_kept(path()).state, KeptState::good) << "linked, and the temporary file still there";
  publish_kept(path());
  EXPECT_EQ(read_kept(path()).content, "three\n");
  prepare_kept(path(), "four\n");
  discard_kept(path());
  EXPECT_EQ(read_kept(path()).content, "three\n");
  EXPECT_FALSE(std::filesystem::exists(path() + ".new"));
}

TEST_F(KeptFileTest, AlarmTextsNameFileGenerationAndRemedy) {
  write_kept(path(), "one\n");
  write_kept(path(), "two\n");
  write_bytes(path(), "");
  EXPECT_EQ(
      damage_text(path(), read_kept(path()), "tools"),
      "tools.yaml is damaged (it is empty): the tools of generation 1 are used, the newest changes are lost. "
      "Check them, or 'trunnion restore' a backup");
  write_bytes(path() + previous_suffix, "");
  EXPECT_EQ(
      damage_text(path(), read_kept(path()), "tools"),
      "tools.yaml is damaged (it is empty; of its previous generation: it is empty): the tools are lost. "
      "'trunnion restore' a backup, or enter them again");
}

}  // namespace
}  // namespace trunnion::storage
