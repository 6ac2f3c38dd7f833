// SPDX-License-Identifier: Apache-2.0
// The journal of the parameters service tells what a calibration has replaced.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace trunnion::calibration {

/// Ends the name of the author of a change which a calibration makes, and which its undo makes.
inline constexpr const char* calibrated_by = " calibrate";
inline constexpr const char* undone_by = " calibrate undo";

struct LastCalibration {
  std::string time, who;
  std::map<std::uint32_t, double> before, after;  ///< by the number of the parameter
};

/// The last calibration in a journal (a JSON object in each line; lines that are none are left out). Throws
/// std::runtime_error when there is none, when it was undone, or when one of its parameters was changed
/// since.
LastCalibration last_calibration(const std::string& journal);

}  // namespace trunnion::calibration
