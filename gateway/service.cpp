// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <iostream>

namespace trunnion::gateway {

GatewayService::GatewayService(service::Node& node, const GatewayOptions& options)
    : mailbox_([&node] { node.bus().signal().notify(); }), links_(node.bus()), view_(node.bus()) {
  api_ = std::make_unique<Api>(mailbox_, topics::contract_hash, options.web, options.recordings,
                               options.access, options.one_operates);
  server_ = std::make_unique<HttpServer>(options.address, options.port, *api_, Site(options.host_names),
                                         options.command_socket);
  where_ = "http://" + options.address + ":" + std::to_string(options.port);
  if (options.mtconnect_port == 0) return;
  try {
    mtconnect_ = std::make_unique<mtconnect::Server>(options.address, options.mtconnect_port, mailbox_,
                                                     options.mtconnect);
  } catch (const std::runtime_error& error) {
    // The machine is operated without it: another machine of this computer may have the port.
    where_ += std::string(", no MTConnect: ") + error.what();
    std::cerr << "trunnion-gateway: MTConnect: " << error.what() << ": set mtconnect_port in machine.yaml\n";
  }
}

GatewayService::~GatewayService() {
  mtconnect_.reset();
  server_->stop();
  api_->stop();
}

double GatewayService::period() const { return links_.busy() ? 0.02 : snapshot_period; }

service::Health GatewayService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::ACTIVE;
  health.detail = where_ + ", " + std::to_string(server_->clients()) + " viewing";
  health.frames_in = view_.frames();
  health.revision = view_.revision();
  return health;
}

void GatewayService::publish(double now) {
  mailbox_.publish(view_.snapshot(now, api_->operating().document()));
  published_ = now;
}

void GatewayService::pump() {
  const double now = service::monotonic_seconds();
  view_.drain(now);
  for (const auto& job : mailbox_.take()) job(links_, now);
  links_.pump(now);
  if (now - published_ >= snapshot_period) publish(now);
}

}  // namespace trunnion::gateway
