// SPDX-License-Identifier: Apache-2.0
#include "snapshot/fields.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "contracts/types.hpp"

namespace trunnion::snapshot {
namespace {

enum class Colour : std::uint8_t { red, green };

class Part {
 public:
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", self.number_), visit("flags", self.flags_), visit("row", self.row_);
  }
  bool operator==(const Part&) const = default;

  double number_ = 0;
  std::vector<bool> flags_;
  std::array<std::uint16_t, 3> row_{};
};

struct Whole {
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("colour", self.colour), visit("parts", self.parts), visit("some", self.some);
    visit("none", self.none), visit("by_key", self.by_key), visit("count", self.count);
    visit("name", self.name);
  }
  bool operator==(const Whole&) const = default;

  Colour colour = Colour::red;
  std::vector<Part> parts;
  std::optional<Part> some, none;
  std::map<std::uint16_t, double> by_key;
  std::uint64_t count = 0;
  std::string name;
};

// By way of the text, as a recording has it.
template <class T>
T passed_on(const T& value) {
  T result;
  read(Json::parse(bus::text_of(written(value))), result);
  return result;
}

TEST(SnapshotFields, WhatIsWrittenIsRead) {
  const Whole whole{Colour::green,         {{1.5, {true, false}, {1, 2, 3}}},
                    Part{-2, {}, {}},      std::nullopt,
                    {{7, 0.1}, {9, -0.2}}, ~std::uint64_t{0},
                    "a \"name\"\n"};
  EXPECT_EQ(passed_on(whole), whole);
}

TEST(SnapshotFields, EveryFiniteNumberKeepsItsBits) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 20000; ++i) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(passed_on(Part{number, {}, {}}).number_),
              std::bit_cast<std::uint64_t>(number));
  }
  EXPECT_TRUE(std::signbit(passed_on(Part{-0.0, {}, {}}).number_));
}

TEST(SnapshotFields, TypesOfTheContractAreWrittenByTheirFields) {
  idl::stream::StageState state;
  state.cycle = 12;
  state.values = {0.1, -3e-300};
  const auto read = passed_on(state);
  EXPECT_EQ(read, state);
  EXPECT_EQ(written(state)["cycle"], 12);
}

TEST(SnapshotFields, ANewFieldKeepsItsValueAndAnOldOneIsPassedOver) {
  Whole whole;
  whole.name = "before";
  read(Json{{"count", 3}, {"removed_since", {1, 2}}}, whole);
  EXPECT_EQ(whole.count, 3u);
  EXPECT_EQ(whole.name, "before");
}

TEST(SnapshotFields, AnotherShapeIsRefused) {
  Whole whole;
  EXPECT_THROW(read(Json{{"count", "three"}}, whole), Json::exception);
  EXPECT_THROW(read(Json{{"parts", {{{"row", {1}}}}}}, whole), Json::exception);
}

}  // namespace
}  // namespace trunnion::snapshot
