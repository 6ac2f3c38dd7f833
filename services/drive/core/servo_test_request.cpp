// SPDX-License-Identifier: Apache-2.0
// Tests of servo loops: when the executor permits one.
#include "drive_core.hpp"

namespace trunnion::drive {

std::string DriveCore::request_test(const idl::servo::TestRequest& request) {
  auto* tester = hardware_->tester();
  if (tester == nullptr) return "the hardware of the drive has no tests of servo loops";
  if (!request.end && mode_ != Mode::FOLLOWING)
    return "the drives are off, or the axes are held: switch the drives on and reset";
  for (const auto number : request.axes) {
    const int column = machine::column_of(axes_, number);
    if (!request.end && column >= 0 && !status_.axes[static_cast<std::size_t>(column)].homed)
      return "axis " + axes_[static_cast<std::size_t>(column)].name + " has no reference";
  }
  return tester->request(request);
}

}  // namespace trunnion::drive
