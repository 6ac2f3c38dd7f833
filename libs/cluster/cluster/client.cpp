// SPDX-License-Identifier: Apache-2.0
#include "cluster/client.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "bus/registry.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_locks.hpp"
#include "machine/roles.hpp"
#include "storage/crc32.hpp"

namespace trunnion::cluster {
namespace {
constexpr double timeout = 15;  // s for an answer
constexpr std::chrono::seconds longest_match(5);
constexpr std::uint16_t every_channel = 65535;
// Commands run as the user of the cluster.
constexpr std::uint8_t of_the_owner = machine::role::builder;
}  // namespace

Client::Client(std::uint32_t domain) : Client(network_in(domain)) {}

Client::Client(const bus::NetworkSettings& network)
    : bus_(bus::Vendor::cyclonedds, network),
      recorded_(is_recorded(network.domain)),
      channel_(bus_, topics::channel_request, topics::channel_reply),
      program_(bus_, topics::program_request, topics::program_reply),
      parameter_(bus_, topics::parameter_request, topics::parameter_reply),
      panel_(bus_, topics::panel_request, topics::panel_reply) {}

// Requests are not kept for late readers: a recorder that does not know of the writer yet would have the
// reply to a request that it does not have. What lasts longer is another machine's recorder, or one that
// ends.
template <class Request, class Reply>
void Client::await_recorder(service::RequestClient<Request, Reply>& requests, const char* topic) {
  if (!recorded_) return;
  const auto& readers = bus::find_topic(topic)->readers;
  auto clusters = bus_.reader(topics::cluster);
  idl::service::Cluster cluster;
  const auto until = std::chrono::steady_clock::now() + longest_match;
  for (int expected = 0; std::chrono::steady_clock::now() < until;
       std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
    while (clusters.take(cluster))
      expected = 1 + static_cast<int>(std::ranges::count_if(cluster.services, [&](const auto& service) {
                   return service.pid != 0 && std::ranges::count(readers, service.service) > 0;
                 }));
    if (expected > 0 && requests.readers() >= expected) return;
  }
}

void Client::channel(std::uint16_t channel, CommandKind command) {
  this->channel({.channel = channel, .command = command});
}

void Client::set_mode(std::uint16_t channel, idl::channel::Mode mode) {
  this->channel({.channel = channel, .command = CommandKind::SET_MODE, .mode = mode});
}

void Client::select_program(std::uint16_t channel, const std::string& name) {
  this->channel({.channel = channel, .command = CommandKind::SELECT_PROGRAM, .program = name});
}

void Client::mdi(std::uint16_t channel, const std::string& block) {
  this->channel({.channel = channel, .command = CommandKind::MDI_LINE, .block = block});
}

void Client::start_from_line(std::uint16_t channel, std::uint32_t line) {
  this->channel({.channel = channel, .command = CommandKind::START_FROM_LINE, .line = line});
}

void Client::channel(ChannelRequest request) {
  request.role = of_the_owner, request.who = "command line";
  await_recorder(channel_, "channel_request");
  const auto reply = channel_.call(request, timeout);
  if (!reply)
    throw std::runtime_error(
        service::silence("channel " + std::to_string(request.channel), timeout, channel_.connected()));
  if (!reply->accepted)
    throw std::runtime_error(reply->reason +
                             (reply->alarm != 0 ? " (alarm " + std::to_string(reply->alarm) + ")" : ""));
}

idl::program::ProgramReply Client::program(idl::program::ProgramRequest request) {
  await_recorder(program_, "program_request");
  const auto reply = program_.call(std::move(request), timeout);
  if (!reply)
    throw std::runtime_error(service::silence("the program service", timeout, program_.connected()));
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  return *reply;
}

idl::parameters::ParameterReply Client::parameter(idl::parameters::ParameterRequest request) {
  request.role = of_the_owner;
  await_recorder(parameter_, "parameter_request");
  const auto reply = parameter_.call(std::move(request), timeout);
  if (!reply)
    throw std::runtime_error(service::silence("the parameters service", timeout, parameter_.connected()));
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  return *reply;
}

idl::plc::PanelReply Client::panel(idl::plc::PanelRequestKind kind) {
  auto feedback = bus_.reader(topics::feedback);
  idl::stream::Feedback batch;
  // A press that the drive holds is accepted, also when the PLC hangs.
  const auto held = [&](const idl::plc::PanelRequest& request) {
    std::optional<idl::plc::PanelReply> reply;
    while (feedback.take(batch))
      if (batch.press_client == request.client && batch.press_number == request.number)
        reply = {request.client, request.number, true, ""};
    return reply;
  };
  await_recorder(panel_, "panel_request");
  const auto reply = panel_.call({.kind = kind}, timeout, held);
  if (!reply) throw std::runtime_error(service::silence("the PLC", timeout, panel_.connected()));
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  return *reply;
}

void Client::wait_for_all_services(const std::function<int()>& matched) {
  constexpr std::chrono::seconds longest(10);
  auto clusters = bus_.reader(topics::cluster);
  idl::service::Cluster cluster;
  bool known = false;
  const auto all_matched = [&] {
    while (clusters.take(cluster)) known = true;
    constexpr int launchers = 1;
    return known &&
           matched() >= launchers + std::count_if(cluster.services.begin(), cluster.services.end(),
                                                  [](const auto& service) { return service.pid != 0; });
  };
  const auto began = std::chrono::steady_clock::now();
  while (!all_matched() && std::chrono::steady_clock::now() - began < longest)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void Client::reset_alarms() {
  auto writer = bus_.writer(topics::alarm_reset);
  wait_for_all_services([&] { return writer.matched(); });
  writer.write({service::make_client_id(), 1, every_channel});
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
}

std::uint64_t Client::upload(const std::string& name, const std::string& text) {
  idl::program::ProgramRequest request;
  request.operation = idl::program::Operation::BEGIN_UPLOAD;
  request.name = name;
  program(request);
  constexpr std::size_t chunk = 32768;
  request.operation = idl::program::Operation::WRITE;
  for (std::size_t at = 0; at < text.size(); at += chunk) {
    request.offset = at;
    const auto part = std::string_view(text).substr(at, chunk);
    request.data.assign(part.begin(), part.end());
    program(request);
  }
  request.data.clear();
  request.operation = idl::program::Operation::COMMIT_UPLOAD;
  request.size = text.size();
  request.crc32 = storage::crc32(text);
  request.role = of_the_owner;
  return program(request).entry.revision;
}

std::string Client::download(const std::string& name) {
  idl::program::ProgramRequest request;
  request.operation = idl::program::Operation::READ;
  request.name = name;
  request.length = 32768;
  std::string text;
  for (;;) {
    request.offset = text.size();
    const auto reply = program(request);
    request.revision = reply.entry.revision;
    text.append(reply.data.begin(), reply.data.end());
    if (text.size() >= reply.entry.size || reply.data.empty()) return text;
  }
}

}  // namespace trunnion::cluster
