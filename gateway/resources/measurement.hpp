// SPDX-License-Identifier: Apache-2.0
// The measurement of the kinematics over HTTP.
#pragma once

#include <filesystem>
#include <functional>

#include "answer.hpp"
#include "calibration/last_calibration.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/router.hpp"
#include "core/worker.hpp"
#include "machine/machine.hpp"

namespace trunnion::gateway {

struct MeasurementSettings {
  machine::MachineConfig machine;
  std::filesystem::path journal;  ///< of the parameters service
};

class KinematicMeasurement {
 public:
  KinematicMeasurement(Mailbox& mailbox, Worker& files, MeasurementSettings settings)
      : mailbox_(mailbox), files_(files), settings_(std::move(settings)) {}

  /// Every operation of the measurement; answers later. Refusals are problem details (RFC 9457).
  void handle(const Match& match, const RequestText& request, const Respond& respond);

 private:
  void order(Operation operation, const RequestText& request, const Respond& respond);
  void answer_inputs(const std::string& query, const Respond& respond);
  /// With the last calibration of the journal when it can be undone; otherwise answers why not.
  void with_last(const Respond& respond, std::function<void(const calibration::LastCalibration&)> then);
  void undo(const RequestText& request, const Respond& respond);
  Answer manual_guide(const std::string& query) const;
  void manual(bool write, const RequestText& request, const Respond& respond);

  Mailbox& mailbox_;
  Worker& files_;
  MeasurementSettings settings_;
};

}  // namespace trunnion::gateway
