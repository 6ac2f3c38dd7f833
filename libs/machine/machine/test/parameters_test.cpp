// SPDX-License-Identifier: Apache-2.0
#include "machine/parameters.hpp"
#include "machine/parameter_constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "machine/alarm_constants.hpp"
#include "machine/axes.hpp"

namespace trunnion::machine::parameters_test {
namespace {

TEST(Catalogue, NumbersFollowClassUnitAndOffset) {
  const auto& catalogue = Catalogue::instance();
  EXPECT_EQ(parameter::rapid_feed.number(2), 102034u) << "10axxx of axis 2";
  EXPECT_EQ(parameter::table_offset_2.number(1, 2), 41437u) << "041437 is Zc of channel 1";
  EXPECT_EQ(parameter::backlash.number(12), 312001u);
  EXPECT_EQ(catalogue.find(41437)->name, "table_offset_2");
  EXPECT_EQ(catalogue.find(1)->name, "interpolation_cycle");
  EXPECT_EQ(catalogue.find(700123)->name, "table_value");
  EXPECT_EQ(catalogue.find(999999), nullptr);
}

// A name of another type than the parameter's, or none at all, does not compile.
template <class Key>
constexpr bool can_be_read_as_integer = requires(const Parameters& p, Key key) {
  p.integer(key);
};
static_assert(can_be_read_as_integer<IntegerParameter>);
static_assert(!can_be_read_as_integer<RealParameter> && !can_be_read_as_integer<TextParameter>);
static_assert(!can_be_read_as_integer<const char*>);

TEST(Catalogue, TheConstantsAreTheCatalogue) {
  const ParameterKey keys[] = {parameter::interpolation_cycle, parameter::gantry_slave_axis,
                               parameter::channel_name,        parameter::tool_direction,
                               parameter::maximum_feed,        parameter::pitch_table,
                               parameter::table_value};
  for (const auto& key : keys) {
    ASSERT_NE(Catalogue::instance().find(key.number()), nullptr) << key.name;
    EXPECT_EQ(Catalogue::instance().find(key.number())->name, key.name);
  }
}

TEST(Catalogue, EveryNumberBelongsToOneDefinition) {
  const auto& catalogue = Catalogue::instance();
  for (const auto& d : catalogue.definitions())
    for (std::uint32_t i = 0; i < d.count; ++i) EXPECT_EQ(catalogue.find(d.number(0, i)), &d) << d.name;
}

TEST(Catalogue, RefusesValuesOutsideTheLimitsAndNamesThem) {
  const auto& catalogue = Catalogue::instance();
  EXPECT_EQ(catalogue.check(100900, 60, ""), "");
  EXPECT_EQ(catalogue.check(100900, 1001, ""),
            "parameter 100900 (position_gain): 1001 is outside 1 .. 1000 1/s");
  EXPECT_EQ(catalogue.check(100900, std::nan(""), "").substr(0, 16), "parameter 100900");
  EXPECT_EQ(catalogue.check(1, 1000.5, ""),
            "parameter 000001 (interpolation_cycle): 1000.5 is not a whole number");
  EXPECT_EQ(catalogue.check(5, 1, ""), "parameter 000005 does not exist");
}

TEST(Catalogue, IntegerDefaultsPerIndexAreKept) {
  Parameters parameters;
  EXPECT_EQ(parameters.get(parameter::tool_direction, 0, 2), 1)
      << "the tool points along Z unless said otherwise";
  EXPECT_EQ(parameters.get(parameter::tool_direction, 0, 0), 0);
}

std::string file_with(const std::string& text) {
  const std::string path = testing::TempDir() + "parameters.yaml";
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_parameter_file(file_with(text));
  } catch (const std::runtime_error& e) {
    return std::string(e.what()).substr(testing::TempDir().size());
  }
  return "";
}

TEST(ParameterFile, EveryErrorIsNamedAndTheRestIsRead) {
  const auto read = check_parameter_text(
      "\"101034\": fast\n\"101035\": 20000\nX: 1\n\"999999\": 1\n\"101035\": 1\n\"101036\": 0\n", "p.yaml");
  EXPECT_EQ(read.errors,
            (std::vector<std::string>{
                "p.yaml:1:11: error: parameter 101034 (rapid_feed): 'fast' is not a number",
                "p.yaml:3:1: error: 'X' is not a parameter number of six digits",
                "p.yaml:4:1: error: parameter 999999 does not exist",
                "p.yaml:5:1: error: parameter 101035 is given twice",
                "p.yaml:6:11: error: parameter 101036 (maximum_acceleration): 0 is outside 1 .. 1000000 "
                "mm/s2|deg/s2"}));
  EXPECT_EQ(read.values.size(), 1u);
  EXPECT_EQ(read.places.at(101035), "p.yaml:2:11: error: ");
  EXPECT_EQ(check_parameter_text("- 1\n", "p.yaml").errors.size(), 1u);
  EXPECT_EQ(check_parameter_text("\"101034\": [\n", "p.yaml").errors.size(), 1u);
}

TEST(ParameterFile, ErrorsNameLineAndColumn) {
  EXPECT_EQ(error_of("\"100900\": 60\n\"100901\": fast\n"),
            "parameters.yaml:2:11: error: parameter 100901 (speed_gain): 'fast' is not a number");
  EXPECT_EQ(error_of("\"1009\": 60\n"),
            "parameters.yaml:1:1: error: '1009' is not a parameter number of six digits");
  EXPECT_EQ(error_of("\"100900\": 0\n"),
            "parameters.yaml:1:11: error: parameter 100900 (position_gain): 0 is outside 1 .. 1000 1/s");
  EXPECT_NE(error_of("\"100900\": [1\n").find("parameters.yaml:2:1: error:"), std::string::npos);
}

TEST(Catalogue, ATextThatCouldNotBeReadBackIsRefused) {
  EXPECT_EQ(Catalogue::instance().check(100000, 0, "\xc3\xa4"), "");
  EXPECT_EQ(Catalogue::instance().check(100000, 0, "\xe4"),
            "parameter 100000 (axis_name): the text is not UTF-8");
}

TEST(ParameterFile, WrittenTextReadsBackTheSame) {
  std::map<std::uint32_t, ParameterValue> values{{100000, {0, "X: \"1\" # no"}}, {100900, {0.1 + 60, ""}}};
  EXPECT_EQ(read_parameter_file(file_with(write_parameter_text(values))), values);
  // What a plain scalar would turn into something else, and noncharacters (U+FFFF, U+FFFFF).
  for (const auto* text : {"X", "null", "yes", "", "~", "1", " a ", "a\n\tb", "\x01\x7f",
                           "\xc2\x85\xef\xbb\xbf", "\xef\xbf\xbf", "\xf3\xbf\xbf\xbf"}) {
    values = {{100000, {0, text}}};
    EXPECT_EQ(read_parameter_file(file_with(write_parameter_text(values))), values) << text;
  }
}

TEST(Alarms, NumbersAndNamesAreUniqueAndFindTheirAlarm) {
  std::map<std::uint32_t, int> numbers;
  std::map<std::string, int> names;
  for (const auto* one : alarm::all) {
    EXPECT_EQ(numbers[one->number]++, 0) << one->number;
    EXPECT_EQ(names[one->name]++, 0) << one->name;
    EXPECT_EQ(&alarm::numbered(one->number), one);
  }
  EXPECT_THROW(alarm::numbered(0), std::out_of_range);
}

TEST(Alarms, ThoseOfTheLanguageEndTheProgramAndNothingElse) {
  EXPECT_STREQ(alarm::numbered(1001).text, "line longer than 16384 bytes");
  for (const auto* one : alarm::all) {
    if (one->number < 1000 || one->number > 1999) continue;
    EXPECT_EQ(one->severity, Severity::error) << one->name;
    EXPECT_EQ(one->reaction, Reaction::show) << one->name;
    EXPECT_EQ(one->subject, Subject::channel) << one->name;
  }
}

TEST(Catalogue, AnAxisParameterIsInTheUnitOfItsAxis) {
  // 10a006 is the positive travel limit; axis 3 is a rotary axis (10a001 = 3), axis 0 a linear one by
  // default.
  const std::map<std::uint32_t, ParameterValue> values{{103001, {3, ""}}};
  EXPECT_EQ(unit_of(100006, values), "mm");
  EXPECT_EQ(unit_of(103006, values), "deg");
  EXPECT_EQ(unit_of(103034, values), "deg/min");
  EXPECT_EQ(unit_of(1, values), "us");
}

TEST(Axes, ThereAreNoneFromTheLargestNumberOn) {
  Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y"};
  EXPECT_EQ(drive_axes(p).size(), 2u);
  EXPECT_EQ(channel_axes(p, 0).letters, "XY");
  p.values[10049] = {1, ""};
  EXPECT_EQ(drive_axes(p).size(), 1u);
  EXPECT_EQ(channel_axes(p, 0).letters, "X");
}

TEST(Catalogue, LimitsAreWrittenInFull) {
  const auto& d = parameter::maximum_feed;
  EXPECT_NE(Catalogue::instance().check(d.number(0), -1, "").find("1 .. 1000000 "), std::string::npos)
      << Catalogue::instance().check(d.number(0), -1, "");
}

}  // namespace
}  // namespace trunnion::machine::parameters_test
