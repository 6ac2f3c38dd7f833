// SPDX-License-Identifier: Apache-2.0
#include "plc/online/task_times.hpp"

#include <gtest/gtest.h>

namespace trunnion::plc_online {
namespace {

TEST(TaskTimes, ComeOutOfAnAnswerAsTheyWentIn) {
  const std::vector<TaskTime> times = {{"scan", 1000, 9500, 41000, 1000000, 60, 90, 0},
                                       {"main", 100, 4000, 21000, 1000000, 55, 80, 200}};
  idl::plc::OnlineReply reply;
  for (const auto& time : times) add(time, reply);
  EXPECT_EQ(task_times(reply), times);
  const auto json = json_of(times);
  EXPECT_EQ(json[1]["name"], "main");
  EXPECT_EQ(json[1]["last_us"], 4.0);
  EXPECT_EQ(json[0]["worst_us"], 41.0);
  EXPECT_EQ(json[0]["budget_us"], 1000.0);
  EXPECT_EQ(json[1]["statement_budget"], 200);
}

TEST(TaskTimes, AnAnswerWithoutThemIsRefused) {
  idl::plc::OnlineReply reply;
  EXPECT_THROW(task_times(reply), std::runtime_error);
  reply.variables.resize(2);
  reply.cells = {1, 2, 3};
  EXPECT_THROW(task_times(reply), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::plc_online
