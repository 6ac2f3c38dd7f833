// SPDX-License-Identifier: Apache-2.0
// The command line and the measurement service of the cluster that runs.
#pragma once

#include <string>
#include <vector>

#include "calibration/touches.hpp"
#include "cluster/client.hpp"

namespace trunnion::cli {

class MeasurementSession {
 public:
  /// Throws std::runtime_error when the machine has no measurement service, or it does not answer.
  explicit MeasurementSession(std::uint32_t domain);

  /// In the name of the user. Returns the number of the measurement. Throws std::runtime_error with the
  /// reason when it is refused.
  std::uint64_t order(idl::measurement::MeasurementRequest request);
  std::uint64_t order(idl::measurement::Operation operation);
  /// The newest state.
  const idl::measurement::MeasurementState& state();
  /// Until nothing of the measurement is under way; its progress goes to stderr. SIGINT and SIGTERM abort it.
  /// Throws std::runtime_error with the error of the service when it was interrupted.
  void follow(std::uint64_t measurement);
  /// The newest result. Throws std::runtime_error when there is none.
  idl::measurement::MeasurementResult result();

 private:
  void show(const idl::measurement::MeasurementState& state);

  cluster::Client client_;
  service::RequestClient<idl::measurement::MeasurementRequest, idl::measurement::MeasurementReply> requests_;
  bus::Reader<idl::measurement::MeasurementState> states_;
  idl::measurement::MeasurementState state_;
  std::uint32_t shown_ = 0;  // complete poses
  bool planned_ = false, repeated_ = false;
};

/// The complete poses of a result.
std::vector<calibration::TouchedPose> touched_poses(const idl::measurement::MeasurementResult& result);

}  // namespace trunnion::cli
