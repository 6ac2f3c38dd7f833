// SPDX-License-Identifier: Apache-2.0
#include "access/secrets.hpp"

#include <gtest/gtest.h>

namespace trunnion::access {
namespace {

TEST(Secrets, APasswordIsRecognisedByItsHashAlone) {
  const auto hash = hash_password("correct horse");
  EXPECT_EQ(hash.rfind("$argon2id$v=19$m=19456,t=2,p=1$", 0), 0u) << hash;
  EXPECT_TRUE(is_password("correct horse", hash));
  EXPECT_FALSE(is_password("correct horsf", hash));
  EXPECT_FALSE(is_password("", hash));
  EXPECT_NE(hash, hash_password("correct horse")) << "a salt of its own";
}

TEST(Secrets, WhatIsNoHashRecognisesNothing) {
  for (const char* hash : {"", "x", "$argon2id$", "$argon2i$v=19$m=8,t=1,p=1$c2FsdHNhbHQ$aGFzaA"})
    EXPECT_FALSE(is_password("", hash)) << hash;
}

TEST(Secrets, ADigestIsSha256) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Secrets, ARandomSecretIsAnotherOneEachTime) {
  EXPECT_EQ(random_secret().size(), 64u);
  EXPECT_NE(random_secret(), random_secret());
}

}  // namespace
}  // namespace trunnion::access
