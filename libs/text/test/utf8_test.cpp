// SPDX-License-Identifier: Apache-2.0
#include "text/utf8.hpp"

#include <gtest/gtest.h>

namespace trunnion::text {
namespace {

TEST(Utf8, WellFormedAndIllFormedSequences) {
  // Unicode 15 table 3-7: first and last sequence of each row, and their neighbours outside.
  for (const char* good :
       {"", "abc", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf",
        "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "12345678\u00e412345678"}) {
    EXPECT_EQ(valid_utf8_prefix(good), std::string_view(good).size()) << good;
  }
  for (const char* bad :
       {"ab\x80", "ab\xc1\xbf", "ab\xc3", "ab\xe0\x9f\xbf", "ab\xed\xa0\x80", "ab\xf0\x8f\xbf\xbf",
        "ab\xf4\x90\x80\x80", "ab\xf5\x80\x80\x80", "ab\xe2\x82", "ab\xff"}) {
    EXPECT_EQ(valid_utf8_prefix(bad), 2u) << bad;
  }
}

}  // namespace
}  // namespace trunnion::text
