// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "service/node.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::service {
namespace {

using idl::service::StandbyState;
using testing_support::eventually;

constexpr std::uint32_t domain = 68;

// What works on standby in the place of a service: its health is the test's.
struct Compared : Service {
  void pump() override {}
  Health health() const override {
    Health health;
    health.lifecycle = idl::service::Lifecycle::INACTIVE;
    health.in_step = in_step;
    health.compared = 7;
    if (differs) health.difference = "tool 3, 10 and 11";
    return health;
  }
  std::atomic<bool> in_step = false, differs = false;
};

TEST(Standby, EndsWithAPromotionOfThisProcessAndNoOtherAndItsStateIsPublished) {
  Options options;
  options.service = "program", options.instance = 10005, options.standby = true;
  options.network.domain = domain;
  bus::Bus launcher(bus::Vendor::cyclonedds, {domain});
  auto promotions = launcher.writer(topics::promotion);
  auto states = launcher.reader(topics::service_state);
  idl::service::ServiceState state;
  const auto published = [&](StandbyState expected) {
    return eventually([&] {
      while (states.take(state)) {
      }
      return state.beats > 0 && state.standby == expected;
    });
  };
  // A promotion that waits for a process of the same instance that was there before.
  promotions.write({10005, getpid() + 1});

  Compared compared;
  std::atomic<bool> promoted = false;
  std::thread service([&] {
    Node node(options);
    promoted = node.stand_by(&compared) && !node.on_standby();
  });
  EXPECT_TRUE(published(StandbyState::JOINING));
  compared.in_step = true;
  EXPECT_TRUE(published(StandbyState::MATCHING));
  EXPECT_EQ(state.compared, 7u);
  EXPECT_EQ(state.difference, "");
  compared.differs = true;
  EXPECT_TRUE(published(StandbyState::DIFFERING));
  EXPECT_EQ(state.difference, "tool 3, 10 and 11");
  promotions.write({5, getpid()});
  EXPECT_FALSE(promoted) << "neither promotion was its own";
  promotions.write({10005, getpid()});
  EXPECT_TRUE(eventually([&] { return promoted.load(); }));
  service.join();
}

}  // namespace
}  // namespace trunnion::service
