// SPDX-License-Identifier: Apache-2.0
// A recording made up for tests: a cluster with a gateway, one channel and an operator.
#pragma once

#include "sample_recording.hpp"
#include "storage/crc32.hpp"
#include "verification/difference.hpp"
#include "verification/gateway_plan.hpp"

namespace trunnion::verification {

constexpr std::uint32_t channel_instance = 3, gateway_instance = 9;

inline idl::channel::ChannelState channel_state(double x) {
  idl::channel::ChannelState state{};
  state.channel = 0;
  state.letters = "X";
  state.axes = {0};
  state.machine = {x};
  return state;
}

inline idl::service::ServiceState beat(std::uint32_t instance, std::int32_t pid) {
  idl::service::ServiceState state{};
  state.instance = instance;
  state.service = instance == gateway_instance ? "gateway" : "channel";
  state.pid = pid;
  state.uptime = 2.75;
  state.lifecycle = idl::service::Lifecycle::ACTIVE;
  return state;
}

inline OperatorLine operator_line(const std::string& target, const std::string& body, std::uint64_t client,
                                  std::uint64_t number, std::uint32_t requests, std::uint16_t status = 200) {
  OperatorLine line{};
  line.address = "192.168.0.7";
  line.method = "POST";
  line.target = target;
  line.body = body;
  line.body_size = body.size();
  line.body_crc32 = storage::crc32(body);
  line.status = status;
  line.answer = "{}";
  line.answer_size = 2;
  line.answer_crc32 = storage::crc32(line.answer);
  line.client = client;
  line.number = number;
  line.requests = requests;
  return line;
}

inline idl::channel::ChannelRequest channel_request(std::uint64_t client, std::uint64_t number,
                                                    idl::channel::CommandKind command) {
  idl::channel::ChannelRequest request{};
  request.client = client;
  request.number = number;
  request.command = command;
  return request;
}

inline idl::channel::ChannelReply channel_reply(std::uint64_t client, std::uint64_t number) {
  idl::channel::ChannelReply reply{};
  reply.client = client;
  reply.number = number;
  reply.accepted = true;
  reply.cycle = 55;
  return reply;
}

/// Cluster, heartbeats, parameters and a state of the channel at the times 1 to 10.
inline StoredRecording shown_recording() {
  StoredRecording recording;
  recording.complete = true;
  idl::service::Cluster cluster{};
  cluster.machine = "bench";
  cluster.virtual_time = true;
  cluster.services = {{channel_instance, "channel", 0, "cyclonedds", 100, 0, true},
                      {gateway_instance, "gateway", 0, "cyclonedds", 200, 0, true}};
  recording.messages = {stored(topics::cluster, cluster, 1), parameters(1, 2),
                        stored(topics::service_state, beat(channel_instance, 100), 3),
                        stored(topics::service_state, beat(gateway_instance, 200), 4),
                        stored(topics::channel_state, channel_state(1.5), 10)};
  return recording;
}

}  // namespace trunnion::verification
