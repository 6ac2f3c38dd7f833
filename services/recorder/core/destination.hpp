// SPDX-License-Identifier: Apache-2.0
// The output of the recorder. Everything runs in the thread that writes files.
#pragma once

#include <string>
#include <vector>

#include "message_queue.hpp"

namespace trunnion::recorder {

/// A complete file, or the one that was open when the recorder ended.
struct FileReport {
  std::string path;
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
  std::string why;  ///< the alarm that made a flight recorder save it, else empty
};

class Destination {
 public:
  virtual ~Destination() = default;
  /// Takes the message, at `now` seconds of a monotonic clock. It may move its bytes.
  virtual void take(Message& message, double now) = 0;
  /// Called several times a second.
  virtual void idle(double now) = 0;
  virtual void finish(double now) = 0;
  /// There is no space for more: a recording ends here and its file is completed; `why` is its problem. A
  /// flight recorder goes on, there may be space for the next alarm.
  virtual void end(const std::string& why) = 0;
  /// It has ended with a problem, and nothing more is written.
  virtual bool ended() const = 0;

  /// Counts the recordings that have started with the states that were valid then.
  virtual std::uint32_t started() const = 0;
  /// Files so far, the oldest first; without those that were removed for new parts.
  virtual const std::vector<FileReport>& files() const = 0;
  /// Messages that could not be written, and why: one line, empty without a problem.
  virtual std::uint64_t unwritten() const = 0;
  virtual const std::string& problem() const = 0;
};

}  // namespace trunnion::recorder
