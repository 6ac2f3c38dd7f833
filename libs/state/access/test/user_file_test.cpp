// SPDX-License-Identifier: Apache-2.0
#include "access/user_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace trunnion::access {
namespace {

namespace fs = std::filesystem;

class UserFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(directory_); }
  void TearDown() override { fs::remove_all(directory_); }
  const std::string directory_ = testing::TempDir() + "/user_file_" + std::to_string(getpid());
  const Users users_{{{"ann", Role::administrator, "hash a"}, {"bob", Role::machine_operator, "hash b"}},
                     {{"mes", Role::setter, "00ff"}}};
};

TEST_F(UserFile, IsReadAsItWasWrittenAndByItsOwnerAlone) {
  EXPECT_FALSE(load_users(directory_)) << "there is none at first";
  save_users(directory_, users_);
  struct stat status {};
  ASSERT_EQ(::stat((directory_ + "/users.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  const auto read = load_users(directory_);
  ASSERT_TRUE(read);
  EXPECT_EQ(text_of(*read), text_of(users_));
  EXPECT_EQ(read->find("bob")->role, Role::machine_operator);
  EXPECT_EQ(read->find("eve"), nullptr);
  EXPECT_EQ(read->find_token("00ff")->name, "mes");
  EXPECT_EQ(read->find_token(""), nullptr);
  save_users(directory_, {});
  EXPECT_TRUE(load_users(directory_)->users.empty());
}

TEST_F(UserFile, IsRefusedWhenOthersMayReadIt) {
  save_users(directory_, users_);
  fs::permissions(directory_ + "/users.json", fs::perms(0640));
  EXPECT_THROW(load_users(directory_), std::runtime_error);
}

TEST_F(UserFile, IsOldOrNewWhenAWriteWasInterrupted) {
  save_users(directory_, users_);
  std::ofstream(directory_ + "/users.json.next") << "{ torn";
  EXPECT_EQ(text_of(*load_users(directory_)), text_of(users_));
  save_users(directory_, {});
  EXPECT_FALSE(fs::exists(directory_ + "/users.json.next"));
}

TEST_F(UserFile, NamesTheFileWhenItIsDamaged) {
  for (
      const char* text :
      {"", "{", "[]", "{}", R"({"users":[],"tokens":{}})", R"({"users":[1],"tokens":[]})",
       R"({"users":[{"name":"a","role":"king","argon2id":"x"}],"tokens":[]})",
       R"({"users":[{"name":"","role":"setter","argon2id":"x"}],"tokens":[]})",
       R"({"users":[{"name":"a","role":"setter"}],"tokens":[]})",
       R"({"users":[{"name":"a","role":"setter","argon2id":"x"},{"name":"a","role":"setter","argon2id":"y"}],"tokens":[]})"}) {
    try {
      parse_users(text, "users.json");
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind("users.json: error: ", 0), 0u) << error.what();
    }
  }
}

TEST_F(UserFile, TheJournalHasALineForEachEvent) {
  journal(directory_, "2026-01-01T00:00:00Z", "ann", "login from 127.0.0.1");
  journal(directory_, "2026-01-01T00:00:01Z", "b\"\n", "x");
  std::ifstream in(directory_ + "/access.jsonl");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, R"({"time":"2026-01-01T00:00:00Z","what":"login from 127.0.0.1","who":"ann"})");
  std::getline(in, line);
  EXPECT_EQ(line, R"({"time":"2026-01-01T00:00:01Z","what":"x","who":"b\"\n"})");
  EXPECT_FALSE(std::getline(in, line));
}

TEST(UserNames, AreShortAndPlain) {
  for (const char* name : {"ann", "A.b-c_9", "01234567890123456789012345678901"})
    EXPECT_TRUE(is_user_name(name));
  for (const char* name : {"", "a b", "a/b", "ä", "012345678901234567890123456789012"})
    EXPECT_FALSE(is_user_name(name));
  EXPECT_EQ(password_problem("12345678"), "");
  EXPECT_NE(password_problem("1234567"), "");
  EXPECT_NE(password_problem(std::string(257, 'x')), "");
}

}  // namespace
}  // namespace trunnion::access
