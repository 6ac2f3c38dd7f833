#include "@NAME@_core.hpp"

namespace @IDENTIFIER@ {

// Read here what the computation needs, by number and unit: parameters.get(300001, axis), for example.
// What makes no sense is a std::runtime_error with number and limits; the stage then stops with an alarm.
void Core::configure(const trunnion::machine::Parameters&, std::uint16_t) {}

// One batch: `count` rows of one setpoint for each of `axes`, in mm or deg.
bool Core::process(const trunnion::idl::stream::AxisFrame& in, const trunnion::stream::FeedbackWindow&,
                   trunnion::idl::stream::AxisFrame& out) {
  const auto width = in.axes.size();
  out.axes = in.axes;
  out.setpoints = in.setpoints;
  newest_.resize(width);
  for (std::size_t row = 0; row < in.count; ++row)
    for (std::size_t axis = 0; axis < width; ++axis) {
      double& setpoint = out.setpoints[row * width + axis];
      // Change `setpoint` here. Whatever a later cycle needs of this one belongs into the state, or a process
      // that is started in mid-motion computes something else.
      newest_[axis] = setpoint;
    }
  return true;
}

}  // namespace @IDENTIFIER@
