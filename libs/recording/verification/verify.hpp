// SPDX-License-Identifier: Apache-2.0
// Runs one service alone against what a recording says it was given, and compares what it answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "verification/coverage.hpp"
#include "verification/difference.hpp"

namespace trunnion::verification {

struct VerifyOptions {
  std::string recording;            ///< file
  std::string service;              ///< name as in machine.yaml
  std::string executable;           ///< empty: the one beside this program
  std::string vendor;               ///< empty: cyclonedds
  std::string machine;              ///< name or directory; empty: the name the recording has
  bool machine_parameters = false;  ///< those of the machine's directory instead of the recording's
  std::uint16_t channel = 0;        ///< of a channel service
  std::optional<std::uint32_t> domain;
  double timeout = 5;  ///< s without progress after which the service has failed
  DiffOptions comparison;
};

struct VerifyResult {
  Difference difference;
  std::string parameters;    ///< which were used, in one line, when the machine's are or differ
  std::string cut_off;       ///< where the recording ends too early; it was verified up to there
  std::string not_compared;  ///< of the outputs, and why, in one line
  std::string problem;       ///< that kept the service from answering everything, or an alarm; one line
  std::size_t inputs = 0, outputs = 0, unrecorded = 0;
  /// Of the gateway: requests over HTTP, lines of its journal that could not be sent again, and how often
  /// what it shows was compared.
  std::size_t requests = 0, left_out = 0, samples = 0;
  std::uint64_t cycles = 0;
  std::vector<Feature> features;  ///< of the service, and which of them the outputs show
  double seconds = 0;             ///< from the first input to the last output
  double times_real_time = 0;     ///< cycles of the stream against the cycle time
  bool equal() const { return problem.empty() && difference.equal(); }
};

/// The service is started in a domain of its own and stopped again, however this ends. Throws
/// std::runtime_error when the recording cannot be used, as one of which something is missing in the middle,
/// or the service cannot be started; NothingToVerify (verify_plan.hpp) when the recording has nothing for it.
VerifyResult verify(const VerifyOptions& options);

}  // namespace trunnion::verification
