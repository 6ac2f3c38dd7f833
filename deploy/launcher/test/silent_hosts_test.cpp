// SPDX-License-Identifier: Apache-2.0
// One cut is one alarm on either side of it.
#include "silent_hosts.hpp"

#include <gmock/gmock.h>

#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What the launcher of one host of three sees of the others.
class Host {
 public:
  explicit Host(const std::string& name) : hosts_({"control", "motion", "drives"}, name) {
    const std::vector<std::pair<std::string, std::string>> all = {
        {"control", "channel 0"}, {"control", "plc"},         {"motion", "kinematics"},
        {"motion", "gantry"},     {"motion", "compensation"}, {"drives", "drive"}};
    for (std::uint32_t i = 0; i < all.size(); ++i)
      if (all[i].first != name) services_.push_back({all[i].first, all[i].second, i + 1, nullptr});
    faults_.resize(services_.size());
    for (std::size_t i = 0; i < services_.size(); ++i) services_[i].fault = &faults_[i];
  }
  void lose(const std::string& name, bool redundant = false) {
    for (std::size_t i = 0; i < services_.size(); ++i)
      if (services_[i].name == name || services_[i].host == name)
        faults_[i].lose("Service " + services_[i].name + " is silent",
                        redundant ? Loss::redundant : Loss::holds);
  }
  void hear(const std::string& name) {
    for (std::size_t i = 0; i < services_.size(); ++i)
      if (services_[i].name == name || services_[i].host == name) faults_[i].active(), faults_[i].in_step();
  }
  std::vector<AlarmCause> causes(double now) {
    std::vector<AlarmCause> causes;
    hosts_.add_causes(services_, now, causes);
    return causes;
  }
  std::vector<std::string> texts(double now) {
    std::vector<std::string> all;
    for (const auto& cause : causes(now)) all.push_back(cause.text);
    return all;
  }

 private:
  SilentHosts hosts_;
  std::vector<RemoteService> services_;
  std::vector<ServiceFault> faults_;
};

TEST(SilentHosts, AHostThatIsCutOffIsOneAlarmOfTheFirstThatDoesNotHearItAndOneOfItsOwn) {
  Host control("control"), motion("motion"), drives("drives");
  for (auto* host : {&control, &motion}) {
    host->lose("drives");
    EXPECT_THAT(host->texts(10), IsEmpty());
  }
  for (const auto* other : {"control", "motion"}) drives.lose(other);
  const auto causes = control.causes(10.5);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].alarm, &alarm::service_lost);
  EXPECT_EQ(causes[0].part, cluster::launcher_instance + 2);
  EXPECT_EQ(causes[0].text,
            "Host drives is silent, and with it drive: check its network and whether it runs");
  EXPECT_THAT(motion.texts(10.5), IsEmpty());
  EXPECT_THAT(drives.texts(10), ElementsAre("Host drives hears no other host: check its network"));
  // The others come back one after the other.
  for (const auto* other : {"plc", "gantry", "compensation", "channel 0"}) {
    drives.hear(other);
    EXPECT_THAT(drives.texts(13), ElementsAre("Host drives hears no other host: check its network"));
  }
  for (const auto* other : {"control", "motion"}) drives.hear(other);
  EXPECT_THAT(drives.texts(13.2), IsEmpty());
}

// The first host's services are the first to be missed in one case, the second's in the other.
TEST(SilentHosts, OfAHostThatMissesTheOthersOneAfterTheOtherNothingElseIsSaid) {
  for (const auto& [first, second] : {std::pair("control", "motion"), std::pair("motion", "control")}) {
    Host drives("drives");
    drives.lose(first);
    EXPECT_THAT(drives.texts(10), IsEmpty());
    EXPECT_THAT(drives.texts(10.2), IsEmpty());
    drives.lose(second);
    EXPECT_THAT(drives.texts(10.3), ElementsAre("Host drives hears no other host: check its network"));
  }
}

TEST(SilentHosts, TheFirstHostIsReportedByTheSecondAlone) {
  Host motion("motion"), drives("drives");
  for (auto* host : {&motion, &drives}) host->lose("control"), host->causes(10);
  EXPECT_THAT(motion.texts(10.5),
              ElementsAre(HasSubstr("Host control is silent, and with it channel 0, plc")));
  EXPECT_THAT(drives.texts(10.5), IsEmpty());
}

// Heartbeats are 0.25 s apart, and services of a host that is heard again come back one after the other.
TEST(SilentHosts, ServicesThatFallSilentAndComeBackOneAfterTheOtherAreNoAlarmsOfTheirOwn) {
  Host control("control");
  double now = 10;
  for (const auto* service : {"kinematics", "gantry", "compensation"}) {
    control.lose(service);
    EXPECT_THAT(control.texts(now += 0.1), IsEmpty());
  }
  const auto whole =
      ElementsAre(HasSubstr("Host motion is silent, and with it kinematics, gantry, compensation"));
  EXPECT_THAT(control.texts(now += 0.5), whole);
  control.hear("gantry");
  EXPECT_THAT(control.texts(now += 3), whole);
  control.hear("motion");
  EXPECT_THAT(control.texts(now), IsEmpty());
}

TEST(SilentHosts, OneServiceThatIsSilentAloneIsNamed) {
  Host control("control");
  control.lose("gantry");
  EXPECT_THAT(control.texts(10), IsEmpty());
  EXPECT_THAT(control.texts(10.6), ElementsAre("Service gantry is silent"));
}

TEST(SilentHosts, AHostOfReplicasHoldsNothing) {
  Host control("control");
  control.lose("motion", true);
  for (const auto& cause : control.causes(10)) EXPECT_EQ(cause.alarm, &alarm::redundancy_lost) << cause.text;
  EXPECT_EQ(control.causes(10).size(), 3u);
}

}  // namespace
}  // namespace trunnion::launcher
