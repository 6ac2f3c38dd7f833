// Programs from CAM systems and post processors, run where they are; they are not part of this repository.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "check/check_program.hpp"
#include "check/default_machine.hpp"
#include "check/file_source.hpp"

namespace trunnion::check {
namespace {

/// Checks a program on the default machine; the summary and the alarm, if any.
std::string summary_of(const std::filesystem::path& path, bool& good) {
  DefaultMachine machine({});
  FileSource text(path.string());
  std::ostringstream out;
  good = check_program(
      text, machine, {}, {}, [&](std::uint32_t) { return path.filename().string(); }, out);
  return out.str();
}

struct RealProgram {
  const char* file;
  const char* moves;  ///< as the summary counts them
};

class RealPrograms : public testing::TestWithParam<RealProgram> {};

TEST_P(RealPrograms, RunsToItsEnd) {
  const auto path = std::filesystem::path(NC_PROGRAMS_DIRECTORY) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  bool good = false;
  const std::string summary = summary_of(path, good);
  EXPECT_TRUE(good) << summary;
  EXPECT_NE(summary.find(GetParam().moves), std::string::npos) << summary;
}
