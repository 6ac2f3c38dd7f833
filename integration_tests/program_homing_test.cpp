// SPDX-License-Identifier: Apache-2.0
// Axes that have lost their references are homed by one line of MDI, as the key of the page gives it.
#include <cmath>

#include "cluster_harness.hpp"
#include "machine/alarm_constants.hpp"
#include "machine_copy.hpp"
#include "testing_support/damage.hpp"

namespace trunnion::integration {
namespace {

/// The lathe with home switches, searched in positive direction, whose axes X, Z and W (0, 1 and 2) have no
/// reference: the file of the encoders is empty. X words are diameters.
class UnreferencedLathe {
 public:
  /// Parameter 04c959: 0 ISO, 1 NUM.
  explicit UnreferencedLathe(int dialect) : machine_("lathe"), state_(machine_.path() + ".state") {
    std::filesystem::remove_all(state_);
    machine_.append("parameters.yaml")
        << "\"040959\": " << dialect << "\n\"100920\": 1\n\"101920\": 1\n\"102920\": 1\n";
    start();
    cluster_.reset();
    testing_support::write_bytes(state_ + "/encoders.bin", "");
    start();
  }
  ~UnreferencedLathe() {
    cluster_.reset();
    std::filesystem::remove_all(state_);
  }
  UnreferencedLathe(const UnreferencedLathe&) = delete;
  UnreferencedLathe& operator=(const UnreferencedLathe&) = delete;

  Cluster& cluster() { return *cluster_; }
  /// Until `move` is refused because of the references: a drive that is new has answered by then.
  void await_refusal(const std::string& move) {
    EXPECT_TRUE(cluster_->until([&] { return !cluster_->channels[0].homed; })) << cluster_->told();
    std::string answer;
    EXPECT_TRUE(cluster_->until([&] {
      try {
        cluster_->client().set_mode(0, Mode::MDI);
        cluster_->client().mdi(0, move);
        answer = "accepted";
      } catch (const std::exception& e) {
        answer = e.what();
      }
      return answer.find("(alarm 1142)") != std::string::npos;
    })) << answer
        << cluster_->told();
  }
  /// In mode MDI: `line` gives all axes their references.
  void home(const std::string& line) {
    cluster_->client().set_mode(0, Mode::MDI);
    cluster_->client().mdi(0, line);
    ASSERT_TRUE(cluster_->until([&] {
      return cluster_->channels[0].homed && cluster_->state() == RunState::IDLE &&
             !cluster_->has_alarm(alarm::not_homed.number);
    })) << cluster_->told();
    // The edges of the switches are the reference coordinates: 150, 400 and 520. They are taken at 1 mm/s,
    // within a micrometre in a period of 1 ms.
    const auto& machine = cluster_->channels[0].machine;
    ASSERT_EQ(machine.size(), 3u);
    EXPECT_NEAR(machine[0], 150, 0.01);
    EXPECT_NEAR(machine[1], 400, 0.01);
    EXPECT_NEAR(machine[2], 520, 0.01);
  }
  /// X is at machine position 100, of X200.
  void move_to_100(const std::string& line) {
    cluster_->client().mdi(0, line);
    EXPECT_TRUE(cluster_->until([&] {
      return std::abs(cluster_->channels[0].machine[0] - 100) < 0.01 && cluster_->state() == RunState::IDLE;
    })) << cluster_->told();
  }

 private:
  void start() { cluster_.emplace(machine_.path(), Time::virtual_, "", false, std::nullopt, state_); }

  MachineCopy machine_;
  std::string state_;
  std::optional<Cluster> cluster_;
};

// The order is the builder's: Z first.
TEST(ProgramHoming, ALineCallsTheStoredProgramOfTheBuilder) {
  UnreferencedLathe lathe(0);
  lathe.await_refusal("G53 G0 X200");
  auto& client = lathe.cluster().client();
  client.upload("O9990", "G28.2 Z0\nG28.2 X0 W0\nM99\n");
  cluster::MachineSession(client, 0).select("O9990");  // the channel knows it
  lathe.home("M98 P9990");
  lathe.move_to_100("G53 G0 X200");
}

TEST(ProgramHoming, ALineOfTheNumDialectNamesAllAxes) {
  UnreferencedLathe lathe(1);
  lathe.await_refusal("G0 X200");
  lathe.home("G159 X Z W");
  lathe.move_to_100("G0 X200");
}

}  // namespace
}  // namespace trunnion::integration
