// SPDX-License-Identifier: Apache-2.0
#include "plc_session.hpp"

#include <stdexcept>

#include "cluster/cluster.hpp"

namespace trunnion::cli {
namespace {

constexpr double answer_time = 10;  // s

}  // namespace

PlcSession::PlcSession(const Common& common)
    : domain_(cluster::find_cluster(common.domain).run.domain),
      client_(cluster::find_cluster(domain_).network),
      requests_(client_.bus(), topics::online_request, topics::online_reply) {}

OnlineReply PlcSession::call(OnlineRequest request) {
  auto reply = requests_.call(std::move(request), answer_time);
  if (!reply) throw std::runtime_error(service::silence("the PLC", answer_time, requests_.connected()));
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  return *std::move(reply);
}

OnlineReply PlcSession::call(OnlineAction action) {
  OnlineRequest request;
  request.action = action;
  return call(std::move(request));
}

}  // namespace trunnion::cli
