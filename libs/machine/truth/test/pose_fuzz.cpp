// SPDX-License-Identifier: Apache-2.0
// Any text as lines of poses: each is answered with finite numbers, or refused with line and column.
#include <cstdlib>
#include <sstream>

#include "outline.hpp"
#include "testing_support/refusal.hpp"
#include "truth/pose_report.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  static const auto machine = truth::outline(geometry::ac_table_with_b_head());
  truth::GeometryTruth errors;
  errors.axes[1].inclination[2] = 1e-5;
  truth::PoseReport report(std::get<truth::TrueGeometry>(truth::TrueGeometry::make(machine.design, errors)),
                           geometry::make(machine.design), machine);
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    testing_support::taken_or_refused("poses", [&] {
      try {
        const auto answer = report.answer(line, number);
        if (answer && (!answer->actual.tip.allFinite() || text_of(*answer).empty())) std::abort();
      } catch (const std::runtime_error& e) {
        throw std::runtime_error(std::string("poses:") + e.what());
      }
    });
  }
  return 0;
}
