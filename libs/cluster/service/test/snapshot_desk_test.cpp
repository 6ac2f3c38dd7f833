// SPDX-License-Identifier: Apache-2.0
#include "service/snapshot_desk.hpp"

#include <gtest/gtest.h>

#include "service/node.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::service {
namespace {

using idl::service::SnapshotKind;
using testing_support::eventually;

class Counting : public Service {
 public:
  void pump() override {}
  Health health() const override { return {}; }
  SnapshotAnswer snapshot() override {
    ++asked;
    return answer;
  }
  SnapshotAnswer answer;
  int asked = 0;
};

class SnapshotDeskTest : public testing::Test {
 protected:
  SnapshotDeskTest() {
    EXPECT_TRUE(eventually([&] { return requests_.matched() > 0 && snapshots_.matched() > 0; }));
  }
  bool answered() {
    return eventually([&] {
      desk_.serve(service_);
      return snapshots_.take(snapshot_);
    });
  }

  bus::Bus service_bus_{bus::Vendor::cyclonedds, {59}}, recorder_{bus::Vendor::cyclonedds, {59}};
  bus::Reader<idl::service::AlarmReset> resets_ = service_bus_.reader(topics::alarm_reset);
  SnapshotDesk desk_{service_bus_, [] {
                       Options options;
                       options.service = "channel";
                       options.instance = 4;
                       options.channel = 1;
                       return options;
                     }()};
  bus::Writer<idl::service::SnapshotRequest> requests_ = recorder_.writer(topics::snapshot_request);
  bus::Writer<idl::service::AlarmReset> reset_writer_ = recorder_.writer(topics::alarm_reset);
  bus::Reader<idl::service::ServiceSnapshot> snapshots_ = recorder_.reader(topics::service_snapshot);
  idl::service::ServiceSnapshot snapshot_;
  Counting service_;
};

TEST_F(SnapshotDeskTest, IsAskedOnlyOnRequestAndNamesWhatWasTaken) {
  ASSERT_TRUE(eventually([&] { return reset_writer_.matched() > 0; }));
  reset_writer_.write({1, 1, 0});
  idl::service::AlarmReset reset;
  ASSERT_TRUE(eventually([&] { return resets_.take(reset); }));
  desk_.serve(service_);
  EXPECT_EQ(service_.asked, 0);

  service_.answer = {SnapshotKind::GIVEN, "", "{\"a\":1}"};
  requests_.write({1, 1});
  ASSERT_TRUE(answered());
  EXPECT_EQ(service_.asked, 1);
  EXPECT_EQ(snapshot_.service, "channel");
  EXPECT_EQ(snapshot_.channel, 1);
  EXPECT_EQ(snapshot_.kind, SnapshotKind::GIVEN);
  EXPECT_EQ(std::string(snapshot_.state.begin(), snapshot_.state.end()), "{\"a\":1}");
  bool found = false;
  for (const auto& input : snapshot_.taken)
    if (input.topic == topics::alarm_reset.name) {
      found = true;
      EXPECT_EQ(input.time, static_cast<std::uint64_t>(resets_.info().source_timestamp));
    }
  EXPECT_TRUE(found);
}

TEST_F(SnapshotDeskTest, AStateThatIsNotGivenNowIsRefusedOnceAndGivenAsSoonAsPossible) {
  service_.answer = {SnapshotKind::LATER, "in motion", ""};
  requests_.write({1, 1});
  ASSERT_TRUE(answered());
  EXPECT_EQ(snapshot_.kind, SnapshotKind::LATER);
  EXPECT_EQ(snapshot_.detail, "in motion");
  for (int i = 0; i < 10; ++i) desk_.serve(service_);
  EXPECT_FALSE(snapshots_.take(snapshot_)) << "refused once";
  service_.answer = {SnapshotKind::GIVEN, "", "{}"};
  ASSERT_TRUE(answered());
  EXPECT_EQ(snapshot_.kind, SnapshotKind::GIVEN);
  const auto asked = service_.asked;
  desk_.serve(service_);
  EXPECT_EQ(service_.asked, asked) << "the request is answered";
}

}  // namespace
}  // namespace trunnion::service
