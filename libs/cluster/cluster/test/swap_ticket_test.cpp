// SPDX-License-Identifier: Apache-2.0
// Which requests to swap a service are believed, and which executables may be started.
#include "cluster/swap_ticket.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace trunnion::cluster {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SwapTicket : public testing::Test {
 protected:
  SwapTicket() : directory_(fs::temp_directory_path() / ("ticket-" + std::to_string(getpid()))) {
    fs::remove_all(directory_);
    fs::create_directories(directory_ / "allowed" / "sub");
    for (const auto* name : {"allowed/good", "allowed/sub/good", "elsewhere"}) {
      std::ofstream(directory_ / name) << "#!/bin/sh\n";
      chmod((directory_ / name).c_str(), 0755);
    }
    request_.service = "kinematics", request_.executable = "/opt/new";
  }
  ~SwapTicket() override { fs::remove_all(directory_); }
  std::string refused(const std::string& name) const {
    return refused_executable((directory_ / name).string(), {(directory_ / "allowed").string()});
  }
  fs::path directory_;
  SwapRequest request_;
};

TEST_F(SwapTicket, IsValidOnceForItsRequestWhateverClientAndNumberItIsSentWith) {
  put_ticket(directory_, request_);
  auto sent = request_;
  sent.client = 5, sent.number = 6;
  EXPECT_EQ(take_ticket(directory_, sent), "");
  EXPECT_NE(take_ticket(directory_, sent), "") << "a repetition by somebody who has listened";
}

TEST_F(SwapTicket, IsUsedUpByAnotherRequest) {
  put_ticket(directory_, request_);
  auto other = request_;
  other.executable = "/tmp/evil";
  EXPECT_THAT(take_ticket(directory_, other), HasSubstr("is not the one"));
  EXPECT_NE(take_ticket(directory_, request_), "");
}

TEST_F(SwapTicket, WithoutATokenOrWithOneThatLeadsElsewhereARequestIsRefused) {
  for (const auto* token : {"", "../../etc/passwd", "00000000000000000000000000000000", "x"}) {
    request_.token = token;
    EXPECT_THAT(take_ticket(directory_, request_), HasSubstr("launcher's user")) << token;
  }
}

TEST_F(SwapTicket, AllowsExecutablesBelowTheDirectoriesOnly) {
  EXPECT_EQ(refused("allowed/good"), "");
  EXPECT_EQ(refused("allowed/sub/good"), "");
  EXPECT_THAT(refused("elsewhere"), HasSubstr("'swap_directories' of machine.yaml"));
  EXPECT_THAT(refused("allowed/../elsewhere"), HasSubstr("'swap_directories' of machine.yaml"));
  fs::create_symlink(directory_ / "elsewhere", directory_ / "allowed" / "link");
  EXPECT_THAT(refused("allowed/link"), HasSubstr("'swap_directories' of machine.yaml"));
  EXPECT_THAT(refused("allowed/none"), HasSubstr("No such file"));
}

TEST_F(SwapTicket, RefusesWhatOtherUsersCouldHaveWritten) {
  for (const auto* name : {"allowed", "allowed/sub", "allowed/sub/good"}) {
    const auto path = directory_ / name;
    fs::permissions(path, fs::perms::others_write, fs::perm_options::add);
    EXPECT_THAT(refused("allowed/sub/good"), HasSubstr(path.string() + " is writable for other users"));
    fs::permissions(path, fs::perms::others_write, fs::perm_options::remove);
  }
  EXPECT_EQ(refused("allowed/sub/good"), "");
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  ASSERT_EQ(chown((directory_ / "allowed/sub/good").c_str(), 65534, 65534), 0);
  EXPECT_THAT(refused("allowed/sub/good"), HasSubstr("belongs to another user than the launcher's"));
}

}  // namespace
}  // namespace trunnion::cluster
