#pragma once

#include <memory>
#include <optional>

#include "node/node.hpp"
#include "node/parameter_client.hpp"
#include "src/drive_core.hpp"
#include "storage/mapped_file.hpp"

namespace trunnion::drive {

class DriveService : public node::Service {
 public:
  DriveService(node::Node& node, std::unique_ptr<DriveHardware> hardware);
  void pump() override;
  double period() const override;
  node::Health health() const override;
  void alarms_reset() override { core_.acknowledge(); }
  void end() override { core_.hardware().end(); }

 private:
  void start();
  void drain();
  void run_virtual();
  void run_real();
  void send();
  void applied(idl::stream::Input input, std::uint64_t identity);
  void configure(const machine::Parameters& parameters);

  node::Node& node_;
  node::ParameterClient parameters_;
  storage::MappedFile encoders_;  ///< as an absolute encoder would, it survives kill -9 of the process
  Memory* memory_;
  DriveCore core_;
  std::optional<bus::Reader<idl::stream::AxisFrame>> frames_;
  std::optional<bus::Reader<idl::stream::StreamRequest>> requests_;
  std::optional<bus::Reader<idl::plc::Outputs>> outputs_;
  std::optional<bus::Reader<idl::service::ServiceState>> services_;
  std::optional<bus::Reader<idl::service::Alarm>> alarms_;
  std::optional<bus::Writer<idl::stream::FeedbackFrame>> writer_;
  idl::stream::AxisFrame frame_;
  idl::stream::FeedbackFrame feedback_;
  std::vector<idl::stream::AppliedInput> applied_;  // not reported yet
  idl::plc::Outputs plc_;
  bool have_plc_ = false;
  double plc_seen_ = 0;
  std::uint64_t frames_in_ = 0, frames_out_ = 0, revision_ = 0;
  std::uint32_t frame_cycles_ = 4;
  double next_tick_ = 0, waiting_since_ = 0, last_sent_ = 0, last_drain_ = 0;
  bool changed_ = false;
};

}  // namespace trunnion::drive
