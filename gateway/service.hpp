// The gateway: the bus on one side, HTTP on the other.
#pragma once

#include <filesystem>

#include "api.hpp"
#include "http/server.hpp"
#include "node/node.hpp"
#include "node/parameter_client.hpp"
#include "src/state_document.hpp"

namespace trunnion::gateway {

struct GatewayOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;     ///< 0 = the one of machine.yaml
  std::filesystem::path web;  ///< the built page
};

class GatewayService : public node::Service {
 public:
  GatewayService(node::Node& node, const GatewayOptions& options);
  ~GatewayService() override;
  void pump() override;
  double period() const override;
  node::Health health() const override;

 private:
  /// Seconds between two snapshots.
  static constexpr double snapshot_period = 0.05;
  void drain(double now);
  void publish(double now);

  // Answers that are under way hold HTTP sessions, so the server is destroyed after everything that may hold
  // one.
  std::unique_ptr<HttpServer> server_;
  std::unique_ptr<Api> api_;
  Mailbox mailbox_;
  Links links_;

  bus::Reader<idl::service::Announcement> announcements_;
  bus::Reader<idl::service::ServiceState> service_states_;
  bus::Reader<idl::service::Alarm> alarms_;
  bus::Reader<idl::service::Cluster> cluster_;
  bus::Reader<idl::channel::ChannelState> channel_states_;
  bus::Reader<idl::stream::FeedbackFrame> feedback_;
  bus::Reader<idl::plc::Outputs> outputs_;
  bus::Reader<idl::plc::Image> image_;
  bus::Reader<idl::parameters::ParameterSet> parameters_;
  bus::Reader<idl::parameters::ToolTable> tools_;
  bus::Reader<idl::parameters::WorkOffsets> offsets_;
  bus::Reader<idl::program::ProgramList> programs_;

  StateDocument document_;
  Snapshot next_;
  std::uint64_t frames_ = 0;
  double published_ = 0;
  std::string where_;
};

}  // namespace trunnion::gateway
