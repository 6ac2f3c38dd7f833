// SPDX-License-Identifier: Apache-2.0
// Two mapped files written in turn: every damage of either, a kill during a write.
#include "storage/retained_pair.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing_support/damage.hpp"

namespace trunnion::storage {
namespace {

using testing_support::Damage;
using testing_support::read_bytes;

constexpr std::size_t size = 24;

std::vector<std::uint8_t> filled(int value) {
  return std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(value));
}

class RetainedPairTest : public testing::Test {
 protected:
  RetainedPairTest() : directory_(testing::TempDir() + "pair_" + std::to_string(getpid())) { renew(); }
  ~RetainedPairTest() override { std::filesystem::remove_all(directory_); }
  void renew() {
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  std::string path() const { return directory_ + "/encoders.bin"; }
  RetainedPair pair() const { return {path(), "encoders", size}; }
  // Saves the contents 1 .. `last`, each twice: of one place at rest.
  void use(int last) const {
    auto files = pair();
    files.open(filled(0));
    for (int i = 1; i <= last; ++i) files.save(filled(i)), files.save(filled(i));
  }
  std::string directory_;
};

TEST_F(RetainedPairTest, IsAbsentAtFirstAndGivesTheNewestContentAfterwards) {
  EXPECT_EQ(pair().load().state, KeptState::absent);
  auto files = pair();
  files.open(filled(1));
  for (int i = 2; i < 9; ++i) {
    files.save(filled(i));
    const auto kept = pair().load();
    EXPECT_EQ(kept.state, KeptState::good) << kept.problem;
    EXPECT_EQ(kept.content, filled(i));
  }
}

TEST_F(RetainedPairTest, EveryDamageOfEitherFileIsFoundAndNamed) {
  const std::string names[] = {"encoders.bin", "encoders.bin.previous"};
  for (const auto& name : names)
    for (const auto how : testing_support::all_damages)
      for (unsigned seed = 0; seed < 20; ++seed) {
        renew();
        use(2);
        const auto file = directory_ + "/" + name;
        const auto old = read_bytes(file);
        use(5);
        testing_support::damage(file, how, old, "another file\n", seed);
        const auto kept = pair().load();
        EXPECT_EQ(kept.state, KeptState::previous) << name << " " << name_of(how) << " seed " << seed;
        EXPECT_EQ(kept.problem.substr(0, kept.problem.find(' ')), name) << kept.problem;
        EXPECT_EQ(kept.content, filled(5)) << "of the other file";
        if (HasFailure()) return;
      }
}

TEST_F(RetainedPairTest, WithBothFilesDamagedNothingIsUsed) {
  use(3);
  for (const auto& file : {path(), path() + previous_suffix}) testing_support::write_bytes(file, "");
  EXPECT_EQ(pair().load().state, KeptState::unusable);
  auto files = pair();
  files.open(filled(9));
  EXPECT_EQ(pair().load().state, KeptState::good);
  EXPECT_EQ(pair().load().content, filled(9));
  EXPECT_TRUE(std::filesystem::exists(path() + damaged_suffix));
}

TEST_F(RetainedPairTest, OpenedAgainItContinuesAndIsGood) {
  for (int life = 0; life < 3; ++life) {
    use(4);
    EXPECT_EQ(pair().load().state, KeptState::good) << pair().load().problem;
  }
  testing_support::damage(path(), Damage::half, "", "", 0);
  pair().open(filled(7));
  EXPECT_EQ(pair().load().state, KeptState::good) << pair().load().problem;
}

TEST_F(RetainedPairTest, AKillAtAnyInstantOfAWriteIsNoDamage) {
  auto random = std::mt19937(3);
  for (int round = 0; round < 60; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      auto files = pair();
      files.open(filled(0));
      for (int i = 0;; ++i) files.save(filled(i));
    }
    usleep(1000 + random() % 3000);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto kept = pair().load();
    if (kept.state == KeptState::absent) continue;  // killed before it had made the files
    // Killed while it made the first files there may be one only.
    if (!std::filesystem::exists(path()) || !std::filesystem::exists(path() + previous_suffix)) continue;
    ASSERT_EQ(kept.state, KeptState::good) << "round " << round << ": " << kept.problem;
    for (const auto byte : kept.content) ASSERT_EQ(byte, kept.content[0]) << "half of two saves";
  }
}

}  // namespace
}  // namespace trunnion::storage
