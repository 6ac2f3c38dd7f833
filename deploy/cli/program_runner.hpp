// SPDX-License-Identifier: Apache-2.0
// Runs generated programs on a channel of the cluster that runs and reads their macro variables.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "calibration/measuring_program.hpp"
#include "cluster/client.hpp"

namespace trunnion::cli {

/// While one lives, SIGINT and SIGTERM are only noted.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  static bool requested();
};

class ProgramRunner {
 public:
  /// Throws std::runtime_error when the channel is not idle, not homed, or an alarm is active that stops it.
  ProgramRunner(std::uint32_t domain, std::uint16_t channel);
  ~ProgramRunner();

  /// Stores `text` under `name`, runs it in AUTO and returns the macro variables it has left, which must say
  /// completed(variables, serial). Throws std::runtime_error with the cause in one line: the alarms that came
  /// meanwhile, a stop, a channel that does not answer; "interrupted: ..." after a signal, with the channel
  /// held.
  calibration::MacroVariables run(const std::string& name, const std::string& text, std::uint32_t serial);
  /// Stores `text` under `name` unless there is a program of this name.
  void provide(const std::string& name, const std::string& text);
  void remove(const std::string& name);
  /// Where the axes are at rest, machine coordinates.
  calibration::AxisPosition position();

 private:
  struct Readers;

  void drain();
  void select(const std::string& name);
  void hold();
  bool wait(double seconds, const std::function<bool()>& condition);
  std::string alarms() const;
  [[noreturn]] void fail(const std::string& otherwise);

  std::uint16_t channel_;
  cluster::Client client_;
  std::unique_ptr<Readers> readers_;
};

}  // namespace trunnion::cli
