// SPDX-License-Identifier: Apache-2.0
// Tests of servo loops (idl/servo.idl), where the hardware can do them.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::drive {

class ServoTester {
 public:
  virtual ~ServoTester() = default;
  /// Begins a test with the next period, renews it (same client and number) or ends one. Returns why it is
  /// refused, else an empty text. Not cyclic.
  virtual std::string request(const idl::servo::TestRequest& request) = 0;
  /// The parameters are in force again, at once. Cyclic.
  virtual void end(idl::servo::TestPhase phase) = 0;
  virtual bool running() const = 0;
  /// A test is running whose time passes while nothing moves.
  virtual bool needs_time() const = 0;
  /// There is a message to send: it is full, or the phase has changed.
  virtual bool ready() const = 0;
  /// What was not reported yet.
  virtual void fill(idl::servo::TestSamples& out) = 0;
};

}  // namespace trunnion::drive
