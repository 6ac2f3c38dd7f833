// SPDX-License-Identifier: Apache-2.0
// What takes the moves of a program.
#pragma once

#include "canonical/canonical.hpp"

namespace trunnion::motion {

using canonical::AxisValues;

/// Motion, or what only judges as motion would. The calls mean what they mean to a Trajectory.
class MoveTaker {
 public:
  virtual ~MoveTaker() = default;
  virtual void start(const AxisValues& position, canonical::Transformation transformation,
                     double tool_length) = 0;
  virtual bool can_accept() const = 0;
  virtual bool push(const canonical::Command& command) = 0;
  virtual bool push_from(const canonical::Command& command, double fraction) = 0;
  virtual void finish() = 0;
  virtual const AxisValues& end_position() const = 0;
};

}  // namespace trunnion::motion
