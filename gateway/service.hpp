// SPDX-License-Identifier: Apache-2.0
// The gateway: the bus on one side, HTTP on the other.
#pragma once

#include <filesystem>
#include <optional>

#include "api.hpp"
#include "cluster_side/alarm_file.hpp"
#include "cluster_side/cluster_view.hpp"
#include "http/server.hpp"
#include "http/tls_certificate.hpp"
#include "mtconnect/server.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"

namespace trunnion::gateway {

struct GatewayOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;
  std::string title;                    ///< of the machine
  std::filesystem::path web;            ///< the built page
  std::vector<std::string> host_names;  ///< as of Site
  RecordingSettings recordings;
  AccessSettings access;
  bool one_operates = false;  ///< one station at a time
  MeasurementSettings measurement;
  std::string alarm_file;            ///< of AlarmFile; empty: the history ends with the process
  std::string command_socket;        ///< as of CommandSocket
  std::uint16_t mtconnect_port = 0;  ///< 0 = no agent
  mtconnect::AgentSettings mtconnect;
  TlsFiles tls;
  FeedbackChange change;  ///< as of ClusterView
};

class GatewayService : public service::Service {
 public:
  GatewayService(service::Node& node, const GatewayOptions& options);
  ~GatewayService() override;
  void pump() override;
  double period() const override;
  service::Health health() const override;

 private:
  /// Seconds between two states.
  static constexpr double state_period = 0.05;
  void publish(double now, bool with_replies);
  /// Looks at the files of the certificate, and says by alarms what is wrong with them.
  void watch_certificate(double now);
  /// To the system, what large bodies and answers have held. On the thread of the files.
  void give_memory_back(double now);
  void begin_alarm_history(const std::string& file);
  /// Writes what is new of the alarm history, on the thread of the files.
  void keep_alarm_history(double now);

  // Answers that are under way hold HTTP sessions, so the server is destroyed after everything that may hold
  // one.
  std::unique_ptr<HttpServer> server_;
  std::unique_ptr<Api> api_;
  Mailbox mailbox_;
  Links links_;

  ClusterView view_;
  std::shared_ptr<AlarmFile> alarm_file_;
  bool alarm_file_failed_ = false;
  double written_again_ = 0;  ///< not before, after a failure
  double settles_ = 0;        ///< when alarms of before that were not heard of are over; 0: they are
  std::size_t appended_ = 0;  ///< bytes since the file was rewritten
  service::AlarmBoard& alarms_;
  std::optional<TlsCertificate> certificate_;
  double watched_ = 0, given_back_ = 0;
  std::unique_ptr<mtconnect::Server> mtconnect_;
  double published_ = 0;
  std::string where_;
};

}  // namespace trunnion::gateway
