// SPDX-License-Identifier: Apache-2.0
// Any text as inputs or as readings is taken, or refused with its place.
#include "calibration/manual_calibration.hpp"
#include "calibration/measurement_file.hpp"
#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"
#include "true_machine.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  static const calibration::TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused(
      "inputs.yaml", [&] { calibration::parse_inputs(text, "inputs.yaml", machine.measured); });
  testing_support::taken_or_refused("readings.yaml", [&] {
    calibration::parse_readings(text, "readings.yaml", calibration::ManualKind::ac_table);
  });
  testing_support::taken_or_refused("d.txt", [&] { calibration::parse_displacements(text, "d.txt"); });
  return 0;
}
