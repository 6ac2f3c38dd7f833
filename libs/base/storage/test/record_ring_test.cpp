// SPDX-License-Identifier: Apache-2.0
#include "storage/record_ring.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <thread>

namespace trunnion::storage {
namespace {

using Ring = RecordRing<1 << 12>;
using Bytes = std::vector<std::uint8_t>;

// Bytes that follow from the record's number, so that a torn one is seen.
Bytes record(std::uint32_t number) {
  Bytes bytes(number * 37 % 300);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(number * 7 + i);
  return bytes;
}

TEST(RecordRing, RecordsAreReadInTheirOrderWithTheirStampsAcrossTheEndOfTheRing) {
  const auto ring = std::make_unique<Ring>();
  std::uint64_t at = ring->oldest();
  Ring::Header header;
  Bytes bytes;
  for (std::uint32_t n = 0; n < 500; ++n) {  // 80 kB through 4
    ASSERT_TRUE(ring->write(-static_cast<std::int64_t>(n), record(n)));
    ASSERT_EQ(ring->read(at, header, bytes), Ring::Read::record);
    EXPECT_EQ(header.number, n);
    EXPECT_EQ(header.stamp, -static_cast<std::int64_t>(n));
    EXPECT_EQ(bytes, record(n));
    EXPECT_EQ(ring->read(at, header, bytes), Ring::Read::nothing);
  }
}

TEST(RecordRing, AReaderThatIsOvertakenGoesOnAtTheOldestAndSeesHowManyItMissed) {
  const auto ring = std::make_unique<Ring>();
  std::uint64_t at = ring->oldest();
  Ring::Header header;
  Bytes bytes;
  constexpr std::uint32_t written = 100;
  for (std::uint32_t n = 0; n < written; ++n) ASSERT_TRUE(ring->write(0, record(n)));
  ASSERT_EQ(ring->read(at, header, bytes), Ring::Read::overwritten);
  EXPECT_EQ(at, 0u);
  at = ring->oldest();
  // Counted from the end, as many whole records as fit into the ring.
  std::uint32_t kept = 0;
  for (std::size_t size = 0; (size += sizeof header + record(written - 1 - kept).size()) <= 1 << 12;) ++kept;
  for (std::uint32_t n = written - kept; n < written; ++n) {
    ASSERT_EQ(ring->read(at, header, bytes), Ring::Read::record);
    EXPECT_EQ(header.number, n);
    EXPECT_EQ(bytes, record(n));
  }
  EXPECT_EQ(ring->read(at, header, bytes), Ring::Read::nothing);
}

TEST(RecordRing, WhatIsLargerThanTheRingIsNotWritten) {
  const auto ring = std::make_unique<Ring>();
  EXPECT_TRUE(ring->write(0, Bytes((1 << 12) - sizeof(Ring::Header))));
  EXPECT_FALSE(ring->write(0, Bytes((1 << 12) - sizeof(Ring::Header) + 1)));
}

TEST(RecordRing, AReaderBesideAWriterInFullFlowNeverTakesARecordThatIsTorn) {
  const auto ring = std::make_unique<Ring>();
  constexpr std::uint32_t written = 300000;
  std::thread writer([&] {
    for (std::uint32_t n = 0; n < written; ++n) ring->write(n, record(n));
  });
  std::uint64_t at = ring->oldest();
  std::uint32_t next = 0, taken = 0;
  Ring::Header header;
  Bytes bytes;
  while (next < written) {
    const auto outcome = ring->read(at, header, bytes);
    if (outcome == Ring::Read::overwritten) at = ring->oldest();
    if (outcome != Ring::Read::record) continue;
    ASSERT_GE(header.number, next);
    ASSERT_EQ(header.stamp, header.number);
    ASSERT_EQ(bytes, record(header.number));
    next = header.number + 1;
    ++taken;
  }
  writer.join();
  EXPECT_GT(taken, 0u);
}

// A writer that was killed in the middle, or memory that is no ring.
TEST(RecordRing, NoLengthIsTrusted) {
  const auto ring = std::make_unique<Ring>();
  std::mt19937_64 random(7);
  for (int k = 0; k < 20000; ++k) {
    auto* words = reinterpret_cast<std::uint32_t*>(ring.get());
    for (std::size_t i = 0; i < sizeof(Ring) / 4; i += 1 + random() % 64)
      words[i] = static_cast<std::uint32_t>(random() >> (random() % 64));
    std::uint64_t at = random() % 2 == 0 ? ring->oldest() : random() % 10000;
    Ring::Header header;
    Bytes bytes;
    if (ring->read(at, header, bytes) == Ring::Read::record) {
      EXPECT_LE(bytes.size(), std::size_t{1} << 12);
    }
    ring->write(0, record(static_cast<std::uint32_t>(random() % 200)));
  }
}

}  // namespace
}  // namespace trunnion::storage
