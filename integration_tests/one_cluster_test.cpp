// SPDX-License-Identifier: Apache-2.0
// One machine, one cluster: second starts, what a killed launcher leaves, who may swap what, and alarms that
// end with their cause. With real launchers.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "bus/bus.hpp"
#include "cluster/child_process.hpp"
#include "cluster/cluster_locks.hpp"
#include "cluster/swap_ticket.hpp"
#include "cluster_harness.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using idl::service::SwapOutcome;
using idl::service::SwapReply;
using idl::service::SwapRequest;
using testing::AllOf;
using testing::HasSubstr;

class OneCluster : public testing::Test {
 protected:
  OneCluster() : root_(fs::temp_directory_path() / ("trunnion-one-" + std::to_string(getpid()))) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~OneCluster() override { fs::remove_all(root_); }
  std::string state() const { return (root_ / "state").string(); }
  static cluster::UpOptions options() {
    cluster::UpOptions up;
    up.machine = "ac-table";
    up.vendor = "cyclonedds";
    up.virtual_time = true;
    up.with_gateway = false;
    return up;
  }
  // Why the start is refused; a start that is not ends again.
  static std::string refusal(const cluster::UpOptions& up) {
    try {
      cluster::stop_cluster(cluster::start_cluster(up).run);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "started";
  }
  static SwapReply swap(Cluster& cluster, const SwapRequest& request) {
    service::RequestClient<SwapRequest, SwapReply> client(cluster.client().bus(), topics::swap_request,
                                                          topics::swap_reply);
    client.send(request);
    std::optional<SwapReply> reply;
    EXPECT_TRUE(cluster.until([&] { return (reply = client.poll()).has_value(); }, 60)) << cluster.told();
    return reply.value_or(SwapReply{});
  }
  fs::path root_;
};

TEST_F(OneCluster, ASecondStartInTheDomainOrTheStateDirectoryIsRefusedAndNamesTheFirst) {
  Cluster cluster("ac-table", Time::virtual_, "cyclonedds", false, std::nullopt, state());
  const auto launcher = cluster.running().run.launcher().value_or(0);
  const auto named = AllOf(HasSubstr("launcher " + std::to_string(launcher) + " of user "),
                           HasSubstr("(machine ac-table, domain "), testing::Not(HasSubstr("\n")));
  auto up = options();
  up.domain = cluster.running().run.domain;
  up.state_directory = (root_ / "other").string();
  EXPECT_THAT(refusal(up), AllOf(named, HasSubstr("domain " + std::to_string(*up.domain) + " is in use")));
  up.domain.reset();
  up.own_domain = true;
  up.state_directory = state();
  EXPECT_THAT(refusal(up), AllOf(named, HasSubstr("the state directory " + state() + " is in use")));
  EXPECT_FALSE(fs::exists(root_ / "other")) << "nothing was made";
  // An empty run directory is one that another start has just reserved, or one that this start has left.
  for (std::uint32_t domain = 80; domain < 100; ++domain) {
    const auto run = cluster::RunDirectory{domain}.path();
    std::error_code gone;
    EXPECT_TRUE(cluster.until([&] { return !fs::is_empty(run, gone) || gone; })) << run << " is left";
  }
  EXPECT_TRUE(cluster.until([&] { return cluster.ready(); })) << "the first one is undisturbed";
  EXPECT_EQ(cluster.running().run.launcher(), launcher);
}

// The launcher checks by itself what the command has checked before: two commands may be started at once.
TEST_F(OneCluster, OfTenStartsAtOnceOneSucceeds) {
  const auto domain = cluster::free_domain(10);
  std::vector<cluster::ChildProcess> ups;
  for (int i = 0; i < 10; ++i) {
    cluster::ChildOptions child;
    child.arguments = {cluster::binary_directory() + "/trunnion",
                       "up",
                       "ac-table",
                       "--domain",
                       std::to_string(domain),
                       "--state",
                       state(),
                       "--time",
                       "virtual",
                       "--port",
                       std::to_string(http_client::free_port())};
    child.log = (root_ / ("up-" + std::to_string(i))).string();
    ups.emplace_back(child);
  }
  int started = 0;
  for (std::size_t i = 0; i < ups.size(); ++i) {
    while (!ups[i].status()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const bool good = WIFEXITED(*ups[i].status()) && WEXITSTATUS(*ups[i].status()) == 0;
    started += good ? 1 : 0;
    if (!good) {
      EXPECT_THAT(cluster::last_line((root_ / ("up-" + std::to_string(i))).string()),
                  HasSubstr(" is in use by launcher "));
    }
  }
  EXPECT_EQ(started, 1);
  const cluster::RunDirectory run{domain};
  ASSERT_TRUE(run.launcher());
  EXPECT_EQ(cluster::find_cluster(domain).machine, "ac-table") << "its files are there";
  cluster::stop_cluster(run);
}

TEST_F(OneCluster, AStateDirectoryAmongTheRunFilesIsRefused) {
  auto up = options();
  up.domain = 55;
  up.state_directory = cluster::RunDirectory{55}.path();
  EXPECT_THAT(refusal(up), HasSubstr("whose files are removed when a cluster stops"));
}

// `trunnion up` leaves such a machine running, to be corrected; who has started a cluster for a task of its
// own does not.
TEST_F(OneCluster, AStartWithParametersThatNoChannelCanUseFailsAndLeavesNothing) {
  fs::create_directories(state());
  std::ofstream(state() + "/parameters.yaml") << "# saved\n\"040425\": 33\n";
  auto up = options();
  up.domain = cluster::free_domain(10);
  up.state_directory = state();
  EXPECT_THAT(refusal(up), AllOf(HasSubstr("not ready: channel (channel 0, parameters "),
                                 HasSubstr("two rotary axes have the same letter")));
  EXPECT_FALSE(fs::exists(cluster::RunDirectory{*up.domain}.path()));
}

TEST_F(OneCluster, WhatAKilledLauncherHasLeftIsNamedAndTakenOver) {
  auto up = options();
  up.domain = cluster::free_domain(10);
  up.state_directory = state();
  const auto first = cluster::start_cluster(up);
  int plc = 0;
  {
    cluster::Client client(first.network);
    for (const auto& service : client.newest(topics::cluster).services)
      if (service.service == "plc") plc = service.pid;
  }
  ASSERT_GT(plc, 0);
  ASSERT_EQ(kill(plc, SIGSTOP), 0);  // it does not see that its launcher is gone
  ASSERT_EQ(kill(*first.run.launcher(), SIGKILL), 0);
  const auto text = refusal(up);
  EXPECT_THAT(text, AllOf(HasSubstr("launcher was killed"), HasSubstr(" " + std::to_string(plc) + "."),
                          HasSubstr("--take-over")));
  EXPECT_EQ(kill(plc, 0), 0) << "not without being told to";
  up.take_over = true;
  const auto second = cluster::start_cluster(up);
  EXPECT_NE(kill(plc, 0), 0);
  cluster::stop_cluster(second.run);
}

TEST_F(OneCluster, AnotherUserIsRefusedToo) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to become another user";
  Cluster cluster("ac-table", Time::virtual_, "cyclonedds", false, std::nullopt, state());
  fs::permissions(root_, fs::perms::all);
  const auto domain = std::to_string(cluster.running().run.domain);
  for (const auto& [domain_of_other, state_of_other, what] :
       {std::tuple{domain, (root_ / "other").string(), "domain " + domain + " is in use by launcher "},
        std::tuple{std::string("56"), state(),
                   "the state directory " + state() + " is in use by launcher "}}) {
    cluster::ChildOptions child;
    child.arguments = {"/usr/bin/setpriv",
                       "--reuid=65534",
                       "--regid=65534",
                       "--clear-groups",
                       "env",
                       "HOME=" + root_.string(),
                       cluster::binary_directory() + "/trunnion",
                       "up",
                       "ac-table",
                       "--domain",
                       domain_of_other,
                       "--state",
                       state_of_other};
    child.log = (root_ / ("other-user-" + domain_of_other)).string();
    std::ofstream(child.log).close();
    fs::permissions(child.log, fs::perms::all);
    cluster::ChildProcess other(child);
    while (!other.status()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(WEXITSTATUS(*other.status()), 0);
    EXPECT_THAT(cluster::last_line(child.log), AllOf(HasSubstr(what), HasSubstr(" of user root ")));
  }
  fs::remove_all("/tmp/trunnion-65534");
}

// A participant of the domain, as any local user can be one.
TEST_F(OneCluster, ASwapThatIsNotTheLaunchersUsersIsRefusedJournalledAndAnAlarm) {
  Cluster cluster("ac-table", Time::virtual_, "cyclonedds", false, std::nullopt, state());
  const auto script = root_ / "script";
  std::ofstream(script) << "#!/bin/sh\ntouch " << (root_ / "was-run").string() << "\n";
  chmod(script.c_str(), 0755);
  SwapRequest request;
  request.service = "compensation", request.executable = script.string(), request.cycles = 10;
  EXPECT_EQ(swap(cluster, request).outcome, SwapOutcome::REFUSED) << "no token";
  cluster::put_ticket(cluster.running().run.path(), request);
  const auto reply = swap(cluster, request);
  EXPECT_EQ(reply.outcome, SwapOutcome::REFUSED);
  EXPECT_THAT(reply.reason, HasSubstr("'swap_directories' of machine.yaml"));
  EXPECT_TRUE(
      cluster.until([&] { return cluster.has_alarm(alarm::swap_unauthorized.number, "compensation"); }));
  EXPECT_FALSE(fs::exists(root_ / "was-run"));
  std::ifstream journal(state() + "/" + cluster::swap_journal_file);
  std::string text(std::istreambuf_iterator<char>(journal), {});
  EXPECT_THAT(text, AllOf(HasSubstr("\"refused\":"), HasSubstr(script.string())));
  request.executable.clear();
  EXPECT_EQ(swap(cluster, request).outcome, SwapOutcome::REFUSED) << "the token was used up";
  cluster::put_ticket(cluster.running().run.path(), request);
  EXPECT_EQ(swap(cluster, request).outcome, SwapOutcome::SWAPPED);
  cluster.reset_alarms();
  EXPECT_TRUE(cluster.until([&] { return !cluster.has_alarm(alarm::swap_unauthorized.number); }));
  struct stat status {};
  ASSERT_EQ(stat(cluster.running().run.path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u);
}

TEST_F(OneCluster, TheLossOfAProcessDuringItsOwnSwapCanBeReset) {
  Cluster cluster("ac-table", Time::virtual_, "cyclonedds");
  SwapRequest request;
  request.service = "program", request.cycles = 10;
  cluster::put_ticket(cluster.running().run.path(), request);
  service::RequestClient<SwapRequest, SwapReply> client(cluster.client().bus(), topics::swap_request,
                                                        topics::swap_reply);
  const auto old = cluster.service("program")->pid;
  client.send(request);
  ASSERT_EQ(kill(old, SIGKILL), 0);
  EXPECT_TRUE(cluster.until([&] { return client.poll().has_value(); }, 60)) << cluster.told();
  EXPECT_TRUE(cluster.until([&] { return cluster.ready(); }));
  EXPECT_TRUE(cluster.until(
      [&] {
        cluster.reset_alarms();
        return cluster.ready() && cluster.active_alarms().empty();
      },
      10))
      << cluster.active_alarms();
}

TEST_F(OneCluster, AStrayOfAnotherContractIsAnAlarmUntilItHasLeft) {
  Cluster cluster("ac-table", Time::virtual_, "cyclonedds");
  {
    bus::Bus stray(bus::Vendor::cyclonedds, cluster.running().network);
    auto writer = stray.writer(topics::announcement);
    writer.write({77, "drive", "cyclonedds", "elsewhere", 4711, "another", "9"});
    EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(101, "another"); }));
    cluster.reset_alarms();
    cluster.until([] { return false; }, 0.5);
    EXPECT_TRUE(cluster.has_alarm(101)) << "it is still there";
  }
  EXPECT_TRUE(cluster.until(
      [&] {
        cluster.reset_alarms();
        return !cluster.has_alarm(101);
      },
      10));
}

// Clients as `trunnion calibrate` makes them: one reads the parameters, the next runs programs. The first of
// these ends while the services still tell it of their topics.
TEST_F(OneCluster, ASecondClientOfOneProcessReceivesWhateverTimeTheFirstHadLived) {
  const Cluster cluster("ac-table", Time::virtual_, "cyclonedds");
  const std::string second = cluster::binary_directory() + "/second-client --domain " +
                             std::to_string(cluster.running().run.domain) + " --first-lives-ms ";
  for (const int lived : {0, 0, 4, 4, 8, 8, 12, 40, 100})
    EXPECT_EQ(std::system((second + std::to_string(lived)).c_str()), 0)
        << "the first lived " << lived << " ms";
}

}  // namespace
}  // namespace trunnion::integration
