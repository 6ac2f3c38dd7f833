// SPDX-License-Identifier: Apache-2.0
// Locks between real processes: who is refused, whom the refusal names, and that a killed holder holds
// nothing.
#include "cluster/cluster_locks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <thread>

namespace trunnion::cluster {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t domain = 3;

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Locked& e) {
    return e.what();
  }
  return "accepted";
}

class Locks : public testing::Test {
 protected:
  Locks() : directory_(testing::TempDir() + "locks_" + std::to_string(getpid())) {
    std::filesystem::create_directories(directory_);
  }
  ~Locks() override { std::filesystem::remove_all(directory_); }
  // The host makes the name unique among tests that run beside this one.
  std::string host() const { return "test-" + std::to_string(getpid()); }
  static Identity identity() { return make_identity("mill", 1000, false); }
  // A process that holds both locks.
  pid_t holder() const {
    int ready[2];
    EXPECT_EQ(pipe(ready), 0);
    const auto name = host();
    const pid_t child = fork();
    if (child == 0) {
      const StateLock state(directory_, identity(), domain);
      DomainLock lock(domain, name, identity());
      static_cast<void>(write(ready[1], "r", 1) == 1);
      for (;;) {
        lock.answer();
        usleep(1000);
      }
    }
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]), close(ready[1]);
    return child;
  }
  static void end(pid_t pid) {
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  std::string directory_;
};

TEST_F(Locks, ASecondHolderIsRefusedInOneLineThatNamesTheFirst) {
  const auto pid = holder();
  const auto named = "launcher " + std::to_string(pid) + " of user ";
  for (const auto& text : {refusal([&] { StateLock(directory_, identity(), domain); }),
                           refusal([&] { DomainLock(domain, host(), identity()); })}) {
    EXPECT_THAT(text, HasSubstr(named));
    EXPECT_THAT(text, HasSubstr(" on host " + identity().host + " (machine mill, domain 3, since 20"));
    EXPECT_THAT(text, testing::Not(HasSubstr("\n")));
  }
  EXPECT_THAT(state_holder(directory_).value_or(""), HasSubstr(named));
  EXPECT_THAT(domain_holder(domain, host()).value_or(""), HasSubstr(named));
  end(pid);
}

TEST_F(Locks, AKilledHolderHoldsNothing) {
  end(holder());
  EXPECT_FALSE(state_holder(directory_));
  EXPECT_FALSE(domain_holder(domain, host()));
  EXPECT_EQ(refusal([&] { StateLock(directory_, identity(), domain); }), "accepted");
  EXPECT_EQ(refusal([&] { DomainLock(domain, host(), identity()); }), "accepted");
}

TEST_F(Locks, AHolderThatDoesNotAnswerIsNamedByItsProcess) {
  const auto pid = holder();
  kill(pid, SIGSTOP);
  EXPECT_THAT(refusal([&] { DomainLock(domain, host(), identity()); }),
              HasSubstr("launcher " + std::to_string(pid) + " of user "));
  end(pid);
}

TEST_F(Locks, OtherDomainsAndHostsAreFree) {
  const DomainLock lock(domain, host(), identity());
  EXPECT_EQ(refusal([&] { DomainLock(domain + 1, host(), identity()); }), "accepted");
  EXPECT_EQ(refusal([&] { DomainLock(domain, host() + "2", identity()); }), "accepted");
}

TEST(Identities, ConflictWhenTheMachinesDifferOrTheHostIsTheSame) {
  auto a = make_identity("mill", 1000, false), b = make_identity("mill", 1001, false);
  EXPECT_FALSE(conflict(a, a)) << "itself";
  EXPECT_FALSE(conflict(a, b)) << "two hosts of one machine";
  b.instance = 1000;
  EXPECT_TRUE(conflict(a, b)) << "the same host twice";
  b.instance = 1001, b.machine = "lathe";
  EXPECT_TRUE(conflict(a, b));
}

TEST(Identities, AreReadBackAndNothingElseIs) {
  const auto identity = make_identity("mill", 1000, true);
  std::uint32_t read_domain = 0;
  EXPECT_EQ(read_identity(write_identity(identity, 17), read_domain), identity);
  EXPECT_EQ(read_domain, 17u);
  for (const auto* line : {"", "{", "[]", "{\"pid\": \"x\"}"})
    EXPECT_EQ(read_identity(line, read_domain).pid, 0) << line;
}

}  // namespace
}  // namespace trunnion::cluster
