// SPDX-License-Identifier: Apache-2.0
#include "snapshot/assembly.hpp"

#include <gtest/gtest.h>

namespace trunnion::snapshot {
namespace {

ServiceSnapshot head(std::uint64_t number) {
  ServiceSnapshot head;
  head.instance = 3;
  head.pid = 77;
  head.number = number;
  head.time = 1000;
  head.taken = {{"feedback", 990}};
  return head;
}

// One part has 60,000 bytes.
std::string text(std::size_t size) {
  std::string text(size, 'x');
  for (std::size_t i = 0; i < size; i += 7) text[i] = static_cast<char>('a' + i % 26);
  return text;
}

TEST(SnapshotAssembly, PartsBecomeTheWholeAgain) {
  for (const std::size_t size : {0u, 1u, 60000u, 60001u, 150000u}) {
    const auto parts = parts_of(head(1), text(size));
    EXPECT_EQ(parts.size(), std::max<std::size_t>(1, (size + 59999) / 60000));
    Assembly assembly;
    std::optional<Snapshot> whole;
    for (const auto& part : parts) {
      EXPECT_FALSE(whole.has_value()) << "before the last part";
      whole = assembly.add(part);
    }
    ASSERT_TRUE(whole.has_value()) << size;
    EXPECT_EQ(whole->state, text(size));
    EXPECT_EQ(whole->head.taken, head(1).taken);
    EXPECT_EQ(whole->head.time, 1000u);
  }
}

TEST(SnapshotAssembly, AMissingPartOrOneOfAnotherSnapshotOrAWrongByteIsNoSnapshot) {
  const auto first = parts_of(head(1), text(150000)), second = parts_of(head(2), text(150000));
  Assembly assembly;
  EXPECT_FALSE(assembly.add(first[0]));
  EXPECT_FALSE(assembly.add(first[2])) << "part 1 is missing";
  EXPECT_FALSE(assembly.add(second[0]));
  EXPECT_FALSE(assembly.add(first[1])) << "of the other snapshot";
  EXPECT_FALSE(assembly.add(second[1]));
  auto wrong = second[2];
  wrong.state.front() ^= 1;
  EXPECT_FALSE(assembly.add(wrong));
}

TEST(SnapshotAssembly, TheNextSnapshotIsFoundBehindAnIncompleteOne) {
  Assembly assembly;
  EXPECT_FALSE(assembly.add(parts_of(head(1), text(150000))[0]));
  const auto whole = assembly.add(parts_of(head(2), text(5))[0]);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->head.number, 2u);
}

}  // namespace
}  // namespace trunnion::snapshot
