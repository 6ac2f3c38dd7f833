// SPDX-License-Identifier: Apache-2.0
// A backup gives the state back to the byte; a damaged one changes nothing.
#include "machine_state/backup.hpp"

#include <gmock/gmock.h>

#include <random>
#include <thread>

#include "machine_state/archive.hpp"
#include "state_fixture.hpp"
#include "storage/crc32.hpp"
#include "storage/kept_text.hpp"

namespace trunnion::machine_state {
namespace {

using testing::HasSubstr;

class BackupTest : public StateFixture {
 protected:
  Backup taken() const { return collect(state(), "mill", "0.3.0", "2026-01-31T08:00:00Z"); }
  static std::map<std::string, std::string> contents(const std::string& directory) {
    std::map<std::string, std::string> all;
    for (const auto& name : state_files(directory))
      all[name] = testing_support::read_bytes(directory + "/" + name);
    return all;
  }
  static std::string refusal(const std::string& bytes) {
    try {
      read_backup(bytes);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(BackupTest, GivesTheStateBackToTheByteAndKeepsTheOldOne) {
  const auto before = contents(state());
  const auto bytes = write_backup(taken());
  EXPECT_EQ(bytes, write_backup(taken())) << "the same state gives the same bytes";
  storage::write_kept(state() + "/tools.yaml", "value: 3\n");
  std::ofstream(state() + "/programs/later.nc") << "M30\n";
  const auto changed = contents(state());
  const auto old = restore(read_backup(bytes), state());
  EXPECT_EQ(contents(state()), before);
  EXPECT_EQ(contents(old), changed);
  EXPECT_EQ(old, state() + ".before-restore");
  EXPECT_FALSE(std::filesystem::exists(state() + "/cluster.boot")) << "no file of a run";
  restore(read_backup(bytes), state());
  EXPECT_EQ(contents(state()), before) << "again";
}

TEST_F(BackupTest, MakesAStateWhereThereIsNone) {
  const auto bytes = write_backup(taken());
  EXPECT_EQ(restore(read_backup(bytes), root_ + "/new"), "");
  EXPECT_EQ(contents(root_ + "/new"), contents(state()));
}

TEST_F(BackupTest, ADamagedBackupIsRefusedAndTheStateStays) {
  const auto bytes = write_backup(taken());
  const auto before = contents(state());
  const auto files = taken().files;
  std::mt19937 random(8);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    auto damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<char>(1u << random() % 8);
    // The padding of a tar archive has no checksum: a bit of it may differ, but then nothing else does.
    const auto why = refusal(damaged);
    if (why == "accepted") {
      EXPECT_EQ(read_backup(damaged).files, files);
    }
    refused += why != "accepted" ? 1 : 0;
  }
  EXPECT_GT(refused, 50);
  for (std::size_t size = 0; size < bytes.size(); size += 512)
    if (refusal(bytes.substr(0, size)) == "accepted") {
      EXPECT_EQ(read_backup(bytes.substr(0, size)).files, files) << "only padding is missing";
    }
  EXPECT_NE(refusal(bytes.substr(0, bytes.size() / 2)), "accepted");
  auto wrong = taken();
  wrong.files["tools.yaml"] = "no kept text, and a previous generation beside it";
  EXPECT_THROW(restore(wrong, state()), std::runtime_error);
  EXPECT_EQ(contents(state()), before);
  EXPECT_FALSE(std::filesystem::exists(state() + ".restoring"));
}

TEST_F(BackupTest, ANewerFormatOrANameThatLeadsElsewhereIsRefused) {
  const std::string manifest = "{\"format\": " + std::to_string(backup_format + 1) + "}\n";
  EXPECT_EQ(refusal(write_tar({{"MANIFEST.json", storage::seal("MANIFEST.json", 1, manifest)}})),
            "the backup has format " + std::to_string(backup_format + 1) + ", and this version reads up to " +
                std::to_string(backup_format) + ": install a newer version");
  auto backup = taken();
  backup.files["../evil"] = "x";
  EXPECT_THAT(refusal(write_backup(backup)), HasSubstr("unexpected file: ../evil"));
}

TEST_F(BackupTest, HasTheFilesOfTheMachineBesideTheState) {
  auto backup = taken();
  backup.configuration = {{"machine.yaml", "name: mill\n"},
                          {"plc/main.st", "PROGRAM main\n"},
                          {"programs/Gehäuse 夹具.nc", "M30\n"}};
  const auto back = read_backup(write_backup(backup));
  EXPECT_EQ(back.configuration, backup.configuration);
  EXPECT_EQ(back.files, backup.files);
  backup.configuration["plc/../../evil"] = "x";
  EXPECT_THAT(refusal(write_backup(backup)), HasSubstr("unexpected file: configuration/plc/../../evil"));
}

TEST_F(BackupTest, OfFormat1HasTheStateOnly) {
  const std::string text = "{}\n", manifest = R"({"format": 1, "machine": "mill", "version": "0.3.0",
    "time": "2026-01-31T08:00:00Z", "files": [{"name": "journal.jsonl", "size": 3, "crc32": )" +
                                              std::to_string(storage::crc32(text)) + "}]}\n";
  const auto backup = read_backup(
      write_tar({{"MANIFEST.json", storage::seal("MANIFEST.json", 1, manifest)}, {"journal.jsonl", text}}));
  EXPECT_EQ(backup.files, (FileSet{{"journal.jsonl", text}}));
  EXPECT_TRUE(backup.configuration.empty());
}

TEST_F(BackupTest, ADamagedStateIsNotBackedUp) {
  std::filesystem::resize_file(state() + "/tools.yaml", 3);
  try {
    taken();
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("tools.yaml: its last line is incomplete"));
  }
}

// As of a running cluster: the memory of the drive changes all the time.
TEST_F(BackupTest, OfAStateThatIsBeingWrittenIsWhole) {
  std::atomic<bool> stop = false;
  std::thread writer([&] {
    storage::RetainedPair encoders(state() + "/encoders.bin", "encoders", 64);
    encoders.open(std::vector<std::uint8_t>(64, 1));
    for (std::uint8_t i = 0; !stop; ++i) {
      encoders.save(std::vector<std::uint8_t>(64, i));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  for (int i = 0; i < 10; ++i) EXPECT_NO_THROW(restore(taken(), root_ + "/copy"));
  stop = true;
  writer.join();
  EXPECT_EQ(problems(root_ + "/copy"), "");
}

}  // namespace
}  // namespace trunnion::machine_state
