// SPDX-License-Identifier: Apache-2.0
// What of a machine's directory is in a backup, and what becomes of it.
#include "machine_state/machine_directory.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace trunnion::machine_state {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;

class MachineDirectory : public testing::Test {
 protected:
  MachineDirectory()
      : root_(fs::path(testing::TempDir()) / ("machine_directory_" + std::to_string(getpid()))) {
    fs::remove_all(root_);
    fs::create_directories(machine());
  }
  ~MachineDirectory() override { fs::remove_all(root_); }
  fs::path machine() const { return root_ / "mill"; }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((machine() / name).parent_path());
    std::ofstream(machine() / name) << text;
  }
  fs::path root_;
};

TEST_F(MachineDirectory, IsReadWithoutRecordingsKeysAndCertificates) {
  write("machine.yaml", "name: mill\n");
  write("programs/sub/a part.nc", "M30\n");
  write("recordings/golden.mcap", "x");
  write("security/ca.pem", "x");
  write("security/permissions.p7s", "x");
  write("tls.key", "x");
  fs::permissions(machine() / "tls.key", fs::perms::none);  // of another user
  write("secret", "-----BEGIN EC PRIVATE KEY-----\n");
  write(".git/config", "x");
  fs::create_directories(root_ / "shared");
  std::ofstream(root_ / "shared/main.st") << "PROGRAM main\n";
  fs::create_directory_symlink("../shared", machine() / "plc");
  const auto files = machine_files(machine().string());
  EXPECT_THAT(files, ElementsAre(Key("machine.yaml"), Key("plc/main.st"), Key("programs/sub/a part.nc")));
  EXPECT_EQ(files.at("plc/main.st"), "PROGRAM main\n");
}

TEST_F(MachineDirectory, WithALinkToItselfIsRefused) {
  write("plc/main.st", "");
  fs::create_directory_symlink("..", machine() / "plc/again");
  EXPECT_THROW(machine_files(machine().string()), std::runtime_error);
}

TEST_F(MachineDirectory, IsMadeWholeAndNeverOverAnotherOne) {
  const FileSet files{{"machine.yaml", "name: mill\n"}, {"plc/main.st", "x"}};
  const auto made = (root_ / "deep/made/").string();
  make_machine(files, made);
  EXPECT_EQ(machine_files(made), files);
  write("machine.yaml", "name: another\n");
  try {
    make_machine(files, machine().string());
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("is there already: name a new directory"));
  }
  EXPECT_THAT(machine_files(machine().string()), ElementsAre(std::pair("machine.yaml", "name: another\n")));
}

TEST_F(MachineDirectory, DiffersByName) {
  EXPECT_THAT(differing_files({{"a", "1"}, {"b", "2"}, {"c", "3"}}, {{"b", "2"}, {"c", "4"}, {"d", "5"}}),
              ElementsAre("a", "c", "d"));
}

TEST_F(MachineDirectory, NoNameLeadsOutOfIt) {
  for (const auto* name : {"", "/etc/passwd", "..", "../x", "plc/../../x", "plc//x", "plc/", ".ssh", "plc/.x",
                           "a\nb", "a\\b", "Geh\xe4use", "1/2/3/4/5/6/7/8/9/10"})
    EXPECT_FALSE(is_machine_file(name)) << name;
  EXPECT_FALSE(is_machine_file(std::string(300, 'x')));
  for (const auto* name : {"machine.yaml", "plc/main.st", "programs/Gehäuse (2).nc"})
    EXPECT_TRUE(is_machine_file(name)) << name;
}

}  // namespace
}  // namespace trunnion::machine_state
