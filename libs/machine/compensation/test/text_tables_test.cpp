// SPDX-License-Identifier: Apache-2.0
#include "compensation/text_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compensation/table_parameters.hpp"
#include "machine/parameter_constants.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::error_tables {
namespace {

using testing::HasSubstr;

machine::Parameters three_axes() {
  machine::Parameters p;
  // X Y Z are the logical axes 4, 1, 2.
  p.values[40001] = {4, ""}, p.values[40002] = {1, ""}, p.values[40003] = {2, ""};
  return p;
}

std::string refusal(const std::string& text) {
  return testing_support::refusal_of([&] { parse_tables(text, "t.txt"); });
}

const char* const manual =
    "table X_X\ndirection 1\npoints 20\noffset 3\nspacing 60000\nvalues 0 1 2 3 4 5 6 7 8 9\n"
    "10 11 12 13 14 15 16 17 18 19\nsquareness 1 10\n";

// The manual's example: 20 points of 60 mm, 3 below the reference point: from -180 to 960 mm.
TEST(TextTables, TheManualsExampleBecomesItsParameters) {
  const auto p = parameters_of(parse_tables(manual, "t.txt"), three_axes(), 0, 700100);
  EXPECT_EQ(p.at(304020).value, 1);
  EXPECT_EQ(p.at(304021).value, -180);
  EXPECT_EQ(p.at(304022).value, 20);
  EXPECT_EQ(p.at(304023).value, 60);
  EXPECT_EQ(p.at(304026).value, 700100);
  EXPECT_DOUBLE_EQ(p.at(700119).value, 0.019);
  EXPECT_EQ(p.at(301030).value, 1) << "code 1 is X_Y: Y is compensated";
  EXPECT_EQ(p.at(301031).value, 4);
  EXPECT_DOUBLE_EQ(p.at(301033).value, 0.01);
  EXPECT_EQ(p.at(302051).value, 0) << "what is not in the file is off";
}

TEST(TextTables, WhatIsExportedIsImportedAgain) {
  const std::string text =
      "table X_X\ndirection 4\npoints 2\noffset 0\nspacing 180000\nvalues 0 1 2 3.25\n"
      "table Y_Z\npoints 1\nspacing 1\nvalues 5\ntable X_Z\npoints 1\nspacing 1\nvalues 6\n"
      "angle X_Y Z\nreference -200000\npoints 2\nspacing 100000\nvalues 0 10\nsquareness 6 -2.5\n";
  auto machine = three_axes();
  const auto tables = parse_tables(text, "t.txt");
  for (const auto& [number, value] : parameters_of(tables, machine, 0, 700000))
    machine.values[number] = value;
  const auto written = text_of(tables_of(machine, 0));
  const auto again = parse_tables(written, "again");
  EXPECT_EQ(text_of(again), written);
  ASSERT_EQ(again.tables.size(), 4u);
  EXPECT_EQ(name_of(again.tables[0]), "X_X");
  EXPECT_EQ(again.tables[0].direction, Direction::bidirectional_modulo);
  EXPECT_DOUBLE_EQ(again.tables[0].values[3], 0.00325);
  EXPECT_EQ(name_of(again.tables[3]), "X_Y Z");
  EXPECT_DOUBLE_EQ(again.tables[3].reference, -200);
  ASSERT_EQ(again.squareness.size(), 1u);
  EXPECT_DOUBLE_EQ(again.squareness[0].angle, -0.0025);
}

TEST(TextTables, AFaultIsOneLineWithItsPlace) {
  EXPECT_EQ(refusal("tabel X_X"), "t.txt:1:1: 'tabel': expected table, angle or squareness");
  EXPECT_THAT(refusal("table X_Q"), HasSubstr("t.txt:1:7: 'X_Q': expected MOVING_COMPENSATED"));
  EXPECT_THAT(refusal("table X_X\npoints 2\nspacing 10\nvalues 1\n"),
              HasSubstr("t.txt:5:1: table X_X has 1 of its 2 values"));
  EXPECT_THAT(refusal("table X_X\ndirection 2\npoints 1\nspacing 10\nvalues 1\ntable Y_Y"),
              HasSubstr("t.txt:6:1: table X_X has 1 of its 2 values (both directions: twice the points)"));
  EXPECT_THAT(refusal("table X_X\npoints 1\nspacing 10\nvalues 1 2"),
              HasSubstr("t.txt:4:10: '2': expected the next table"));
  EXPECT_THAT(refusal("table X_X\npoints 1\nspacing 10\nvalues 1x"),
              HasSubstr("t.txt:4:8: '1x': expected a number"));
  EXPECT_THAT(refusal("table X_X\ndirection 5"), HasSubstr("t.txt:2:11: 5 is not within 1 .. 4"));
  EXPECT_THAT(refusal("table X_X\nvalues 1"), HasSubstr("t.txt:2:1: points and spacing must precede"));
  EXPECT_THAT(refusal("table X_X\npoints 1"), HasSubstr("t.txt:1:1: table X_X has no values"));
  EXPECT_THAT(refusal("squareness X_X 1"), HasSubstr("t.txt:1:12: an axis is square to another one"));
  EXPECT_THAT(refusal("squareness X_Y 5001"), HasSubstr("t.txt:1:16: 5001 is not within"));
  EXPECT_THAT(refusal("table X_X\npoints 1e99"), HasSubstr("t.txt:2:8:"));
  EXPECT_EQ(refusal(""), "taken");
}

TEST(TextTables, WhatTheChannelCannotHoldIsRefused) {
  const auto refused = [](const std::string& text, std::uint32_t first = 700000) {
    try {
      parameters_of(parse_tables(text, "t.txt"), three_axes(), 0, first);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto table = [](const std::string& name) {
    return "table " + name + " points 1 spacing 1 values 1\n";
  };
  EXPECT_EQ(refused(table("A_A")), "table A_A: channel 0 has no axis A");
  EXPECT_EQ(refused(table("X_X") + table("X_X")), "table X_X is there twice");
  EXPECT_EQ(refused(table("X_Y") + table("Z_Y") + table("X_Y")),
            "table X_Y: its axis has two tables of this kind already");
  EXPECT_EQ(refused(table("X_X") + table("Y_Y"), 709999), "table Y_Y: 1 values from 710000 end after 709999");
}

}  // namespace
}  // namespace trunnion::error_tables
