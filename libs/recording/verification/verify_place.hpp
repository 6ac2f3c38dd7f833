// SPDX-License-Identifier: Apache-2.0
// Where a service that is verified runs, and how it is started.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cluster/child_process.hpp"
#include "cluster/cluster_files.hpp"
#include "verification/verify.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {

/// That a writer of the stream keeps.
constexpr int stream_batches = 4096;
/// s for what a process writes beyond what is recorded.
constexpr double final_messages = 0.05;

/// A domain and a directory that nobody else has while this lives.
class VerifyPlace {
 public:
  explicit VerifyPlace(std::optional<std::uint32_t> domain);
  ~VerifyPlace();
  VerifyPlace(const VerifyPlace&) = delete;
  VerifyPlace& operator=(const VerifyPlace&) = delete;
  std::uint32_t domain() const { return run_.domain; }
  std::string state() const { return directory_ + "/state"; }
  /// Where the state is put that the service continues from.
  std::string snapshot() const { return directory_ + "/snapshot.json"; }
  std::string log() const { return directory_ + "/service.log"; }

 private:
  cluster::RunDirectory run_;
  std::string directory_;
};

/// Of the machine that the options or else the recording name. Throws std::runtime_error when neither does,
/// or when there is none.
std::string machine_directory(const VerifyOptions& options, const StoredRecording& recording);

/// Of the service, on the recorded machine. Throws std::runtime_error when the recording names none.
std::vector<std::string> command_line(const VerifyOptions& options, const StoredRecording& recording,
                                      const VerifyPlan& plan, const VerifyPlace& place);

/// How the service is started in its place. Throws std::runtime_error when it cannot be.
cluster::ChildOptions child_options(std::vector<std::string> arguments, const VerifyPlace& place);

}  // namespace trunnion::verification
