// SPDX-License-Identifier: Apache-2.0
#include "core/paging.hpp"

#include <gtest/gtest.h>

#include "core/requests.hpp"

namespace trunnion::gateway {
namespace {

/// What is left of 0 .. 9, as text.
std::string page(const std::string& query) {
  auto list = bus::Json::array({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(cut_to_page(list, query), 10u) << query;
  return list.dump();
}

TEST(Paging, OffsetAndLimitGiveAPartOfAListAndHowManyThereAre) {
  EXPECT_EQ(page(""), "[0,1,2,3,4,5,6,7,8,9]");
  EXPECT_EQ(page("offset=8"), "[8,9]");
  EXPECT_EQ(page("limit=2"), "[0,1]");
  EXPECT_EQ(page("offset=3&limit=2"), "[3,4]");
  EXPECT_EQ(page("offset=9&limit=5"), "[9]");
  EXPECT_EQ(page("offset=10"), "[]");
  EXPECT_EQ(page("offset=99999&limit=99999"), "[]");
  EXPECT_EQ(page("limit=0"), "[]");
}

TEST(Paging, WhatIsNoCountIsRefused) {
  for (const char* query : {"offset=-1", "limit=x", "limit=1.5", "offset=100001"})
    EXPECT_THROW(page(query), BadRequest) << query;
}

}  // namespace
}  // namespace trunnion::gateway
