// SPDX-License-Identifier: Apache-2.0
#include "core/byte_range.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using Kind = ByteRange::Kind;

void expect(std::string_view header, std::uint64_t size, Kind kind, std::uint64_t first,
            std::uint64_t count) {
  const auto range = byte_range(header, size);
  EXPECT_EQ(range.kind, kind) << header;
  EXPECT_EQ(range.first, first) << header;
  EXPECT_EQ(range.count, count) << header;
}

TEST(ByteRange, AFirstAndALastByteAreBothIncluded) {
  expect("bytes=0-499", 10000, Kind::part, 0, 500);  // the examples of RFC 9110, 14.1.2
  expect("bytes=500-999", 10000, Kind::part, 500, 500);
  expect("bytes=-500", 10000, Kind::part, 9500, 500);
  expect("bytes=9500-", 10000, Kind::part, 9500, 500);
  expect("bytes=0-0", 10000, Kind::part, 0, 1);
}

TEST(ByteRange, EndsWithTheContent) {
  expect("bytes=9990-99999", 10000, Kind::part, 9990, 10);
  expect("bytes=-20000", 10000, Kind::part, 0, 10000);
  expect("bytes=5-18446744073709551616", 10, Kind::part, 5, 5);
}

TEST(ByteRange, OutsideOfTheContentThereIsNothing) {
  expect("bytes=10000-", 10000, Kind::outside, 0, 0);
  expect("bytes=99999999999999999999-", 10000, Kind::outside, 0, 0);
  expect("bytes=-0", 10000, Kind::outside, 0, 0);
  expect("bytes=0-", 0, Kind::outside, 0, 0);
  expect("bytes=-1", 0, Kind::outside, 0, 0);
}

TEST(ByteRange, WhatIsNoSingleRangeOfBytesIsIgnored) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=5-4", "bytes=0-1,4-5", "bytes=a-b",
                             "lines=0-1", "bytes=+1-2", "bytes= 1-2", "bytes=1--2"})
    expect(header, 100, Kind::whole, 0, 100);
}

}  // namespace
}  // namespace trunnion::gateway
