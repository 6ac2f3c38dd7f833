// SPDX-License-Identifier: Apache-2.0
#include "core/compression.hpp"

#include <gtest/gtest.h>

#include <random>

#include "gunzip.hpp"

namespace trunnion::gateway {
namespace {

TEST(Compression, IsUsedOnlyWhenTheClientPermitsIt) {
  for (const char* header : {"gzip", "gzip, deflate, br", "deflate,GZIP", "*", "br;q=1.0, gzip;q=0.8",
                             "x-gzip", "identity;q=0.5, gzip ; q=0.001", "*;q=0, gzip"})
    EXPECT_TRUE(accepts_gzip(header)) << header;
  for (const char* header :
       {"", "identity", "br, deflate", "gzip;q=0", "gzip; q=0.000", "*;q=0", "gzipped", "*, gzip;q=0"})
    EXPECT_FALSE(accepts_gzip(header)) << header;
}

TEST(Compression, GivesBackAnyTextAtEveryLevel) {
  std::mt19937 random(7);
  for (const std::size_t size : {0u, 1u, 1000u, 100000u})
    for (const int level : {1, 6, 9}) {
      std::string text(size, ' ');
      for (auto& c : text) c = static_cast<char>(random() % 7);
      const auto packed = gzip(text, level);
      EXPECT_EQ(packed, gzip(text, level));
      EXPECT_EQ(gunzip(packed), text);
    }
}

TEST(Compression, IsNotTriedOnPicturesAndRecordings) {
  EXPECT_TRUE(is_compressible("application/json"));
  EXPECT_TRUE(is_compressible("text/javascript; charset=utf-8"));
  EXPECT_FALSE(is_compressible("image/png"));
  EXPECT_FALSE(is_compressible("application/octet-stream"));
}

}  // namespace
}  // namespace trunnion::gateway
