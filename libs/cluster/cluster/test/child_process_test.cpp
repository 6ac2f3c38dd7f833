// SPDX-License-Identifier: Apache-2.0
#include "cluster/child_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "testing_support/eventually.hpp"

namespace trunnion::cluster {
namespace {

using testing_support::eventually;

ChildOptions shell(const std::string& script) {
  ChildOptions options;
  options.arguments = {"/bin/sh", "-c", script};
  return options;
}

TEST(ChildProcess, SaysHowItEndedAndWhatItWroteLast) {
  auto options = shell("echo first; echo 'the reason' >&2; exit 7");
  options.log = testing::TempDir() + "child_process_test.log";
  std::filesystem::remove(options.log);
  ChildProcess child(options);
  EXPECT_GT(child.pid(), 0);
  ASSERT_TRUE(eventually([&] { return !child.ended().empty(); }));
  EXPECT_EQ(child.ended(), "/bin/sh ended with status 7: the reason");
  EXPECT_EQ(child.pid(), 0);
  std::filesystem::remove(options.log);
}

TEST(ChildProcess, TheHintBehindAWrongArgumentIsNotTheReason) {
  auto options = shell(
      "echo 'The following argument was not expected: --standby'; "
      "echo 'Run with --help for more information.'; exit 109");
  options.log = testing::TempDir() + "child_process_test_hint.log";
  std::filesystem::remove(options.log);
  ChildProcess child(options);
  ASSERT_TRUE(eventually([&] { return child.status().has_value(); }));
  EXPECT_EQ(last_line(options.log), "The following argument was not expected: --standby");
  std::filesystem::remove(options.log);
}

TEST(ChildProcess, AProgramThatCannotBeExecutedEndsWith127) {
  ChildOptions options;
  options.arguments = {"/nonexistent"};
  options.log = testing::TempDir() + "child_process_test_127.log";
  std::filesystem::remove(options.log);
  ChildProcess child(options);
  ASSERT_TRUE(eventually([&] { return child.status().has_value(); }));
  EXPECT_EQ(WEXITSTATUS(*child.status()), 127);
  EXPECT_EQ(last_line(options.log), "/nonexistent: cannot be started");
  std::filesystem::remove(options.log);
}

TEST(ChildProcess, ItsOutputIsReadLineByLineOrWhole) {
  auto options = shell("echo ready; echo more; echo rest");
  options.read_from = 1;
  ChildProcess child(options);
  EXPECT_EQ(child.read_line(), "ready");
  EXPECT_EQ(child.read_all(), "more\nrest\n");
  EXPECT_EQ(child.read_line(), "");
}

TEST(ChildProcess, ADescriptorOfItsOwnCarriesAReport) {
  auto options = shell("echo report >&3; echo noise");
  options.read_from = 3;
  options.log = "/dev/null";
  ChildProcess child(options);
  EXPECT_EQ(child.read_all(), "report\n");
}

TEST(ChildProcess, StopEndsOneThatIgnoresTheSignalToEnd) {
  auto options = shell("trap '' TERM; echo deaf; while :; do sleep 0.01; done");
  options.read_from = 1;
  ChildProcess child(options);
  ASSERT_EQ(child.read_line(), "deaf");
  child.stop(0.1);
  ASSERT_TRUE(child.status());
  EXPECT_EQ(WTERMSIG(*child.status()), SIGKILL);
}

TEST(ChildProcess, IsEndedByItsDestructorAndMovesWithoutBeingEnded) {
  ChildProcess first(shell("exec sleep 60"));
  const auto pid = first.pid();
  {
    ChildProcess second(std::move(first));
    EXPECT_EQ(second.pid(), pid);
    EXPECT_EQ(first.pid(), 0);  // NOLINT(bugprone-use-after-move): a moved one has no process
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_NE(kill(pid, 0), 0);
}

TEST(ChildProcess, ADetachedOneOutlivesItsObject) {
  auto options = shell("echo $$; exec sleep 60");
  options.read_from = 1;
  options.detached = true;
  pid_t pid = 0;
  {
    ChildProcess child(options);
    EXPECT_EQ(child.pid(), 0);
    pid = std::stoi(child.read_line());
  }
  EXPECT_EQ(kill(pid, 0), 0);
  EXPECT_EQ(getsid(pid) == getsid(0), false);
  kill(pid, SIGKILL);
}

TEST(ChildProcess, InheritsNoDescriptorButTheOneThatIsRead) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  auto options = shell("ls /proc/$$/fd; :");
  options.read_from = 1;
  ChildProcess child(options);
  EXPECT_EQ(child.read_all(), "0\n1\n2\n");
  close(ends[0]), close(ends[1]);
}

}  // namespace
}  // namespace trunnion::cluster
