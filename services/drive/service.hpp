// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "core/drive_core.hpp"
#include "core/emergency_press.hpp"
#include "machine/gantry_pairs.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"
#include "service/running_time.hpp"
#include "storage/retained_pair.hpp"
#include "stream/batch_reader.hpp"

namespace trunnion::drive {

class DriveService : public service::Service {
 public:
  DriveService(service::Node& node, std::unique_ptr<DriveHardware> hardware);
  void pump() override;
  double period() const override;
  service::Health health() const override;
  void alarms_reset(std::uint16_t) override { core_.acknowledge(); }
  bool axis_concerns(std::uint16_t axis, std::uint16_t channel) const override {
    return parameters_.newest() && machine::axis_moves_with(*parameters_.newest(), axis, channel);
  }
  service::SnapshotAnswer snapshot() override;
  void end() override { core_.hardware().end(); }

 private:
  void start();
  void restore();
  void restore_kept();
  void watch_references();
  void continue_from_snapshot();
  bool parameters_are_here();
  void drain();
  bool time_passes() const;
  void run_virtual();
  void run_real();
  void send();
  void send_samples();
  bool request_test(const idl::servo::TestRequest& request);
  void applied(idl::stream::Input input, std::uint64_t identity);
  void configure(const machine::Parameters& parameters);

  service::Node& node_;
  service::ParameterClient parameters_;
  storage::RetainedPair encoders_;  ///< as an absolute encoder would, it survives kill -9 of the process
  std::optional<storage::RetainedPair> simulation_;  ///< what the hardware keeps besides positions
  std::vector<machine::AxisInfo> unreferenced_;      ///< axes of alarm 115
  DriveCore core_;
  std::optional<stream::BatchReader<idl::stream::AxisBatch>> batches_;
  std::optional<bus::Reader<idl::stream::StreamRequest>> requests_;
  std::optional<bus::Reader<idl::plc::Outputs>> outputs_;
  std::optional<bus::Reader<idl::plc::PanelRequest>> panel_;
  std::optional<bus::Reader<idl::service::ServiceState>> services_;
  std::optional<bus::Reader<idl::service::Alarm>> alarms_;
  std::optional<bus::Reader<idl::servo::TestRequest>> test_requests_;
  std::optional<bus::Writer<idl::servo::TestSamples>> samples_writer_;
  std::optional<bus::Writer<idl::stream::Feedback>> writer_;
  idl::stream::AxisBatch batch_;
  idl::stream::Feedback feedback_;
  idl::servo::TestSamples samples_;
  std::vector<idl::stream::AppliedInput> applied_;  // not reported yet
  idl::plc::Outputs plc_;
  bool have_plc_ = false;
  EmergencyPress press_;
  double plc_seen_ = 0, test_seen_ = 0;
  std::uint64_t messages_in_ = 0, messages_out_ = 0, revision_ = 0;
  std::uint32_t batch_cycles_ = 4;
  double next_tick_ = 0, waiting_since_ = 0, last_sent_ = 0;
  service::RunningTime running_time_;  ///< by which the silence of others is measured
  bool changed_ = false;
  bool unfinished_ = false;  ///< in virtual time: it goes on at the next call
};

}  // namespace trunnion::drive
