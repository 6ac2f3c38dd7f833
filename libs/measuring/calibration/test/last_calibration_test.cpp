// SPDX-License-Identifier: Apache-2.0
#include "calibration/last_calibration.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "testing_support/refusal.hpp"

namespace trunnion::calibration::journal_test {
namespace {

std::string entry(const char* time, const char* who, int number, double before, double after) {
  return std::string(R"({"time":")") + time + R"(","who":")" + who + R"(","what":"parameter","number":)" +
         std::to_string(number) + R"(,"old":)" + std::to_string(before) + R"(,"new":)" +
         std::to_string(after) + "}\n";
}

std::string fault(const std::string& journal) {
  return testing_support::refusal_of([&] { last_calibration(journal); });
}

TEST(Journal, TheLastCalibrationHasWhatItReplaced) {
  const std::string first = entry("T1", "ann calibrate", 40433, 0, 0.1);
  const std::string second =
      entry("T2", "bob calibrate", 40433, 0.1, 0.2) + entry("T2", "bob calibrate", 40435, 1, 2);
  const auto last = last_calibration("torn\n" + first + second + entry("T3", "ann", 100034, 1, 2));
  EXPECT_EQ(last.time, "T2");
  EXPECT_EQ(last.before, (std::map<std::uint32_t, double>{{40433, 0.1}, {40435, 1}}));
  EXPECT_EQ(last.after, (std::map<std::uint32_t, double>{{40433, 0.2}, {40435, 2}}));
}

TEST(Journal, TwoCalibrationsOfTheSameSecondAreTwo) {
  const auto part = [](int number, const std::string& line) {
    return "{\"part\":" + std::to_string(number) + "," + line.substr(1);
  };
  const auto last = last_calibration(part(1, entry("T1", "ann calibrate", 40433, 0, 0.1)) +
                                     part(2, entry("T1", "ann calibrate", 40435, 1, 2)) +
                                     part(1, entry("T1", "ann calibrate", 40434, 0, 0.3)) +
                                     part(2, entry("T1", "ann calibrate", 40435, 2, 3)));
  EXPECT_EQ(last.before, (std::map<std::uint32_t, double>{{40434, 0}, {40435, 2}}));
  EXPECT_EQ(last.after, (std::map<std::uint32_t, double>{{40434, 0.3}, {40435, 3}}));
}

TEST(Journal, NothingIsUndoneTwiceOrOverALaterChange) {
  const std::string calibrated = entry("T1", "ann calibrate", 40433, 0, 0.1);
  EXPECT_EQ(fault(""), "the journal has no calibration");
  EXPECT_EQ(fault(calibrated), "taken");
  EXPECT_EQ(fault(calibrated + entry("T2", "ann calibrate undo", 40433, 0.1, 0)),
            "the last calibration was undone already, at T2");
  EXPECT_EQ(fault(calibrated + entry("T2", "ann", 40433, 0.1, 0.15)),
            "parameter 040433 was changed after the calibration of T1; nothing undone");
}

}  // namespace
}  // namespace trunnion::calibration::journal_test
