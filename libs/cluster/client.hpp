// SPDX-License-Identifier: Apache-2.0
// What the command line says to a running cluster.
#pragma once

#include <functional>
#include <string>

#include "contracts/topics.hpp"
#include "service/request.hpp"

namespace trunnion::cluster {

using idl::channel::ChannelReply;
using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

class Client {
 public:
  /// To the cluster in `domain` whose launcher runs on this computer.
  explicit Client(std::uint32_t domain);
  explicit Client(const bus::NetworkSettings& network);

  bus::Bus& bus() { return bus_; }
  /// Throws std::runtime_error with the reason when it is refused or nobody answers.
  /// Client and number of the request are given by this client.
  void channel(const ChannelRequest& request);
  /// A command without fields.
  void channel(std::uint16_t channel, CommandKind command);
  void set_mode(std::uint16_t channel, idl::channel::Mode mode);
  void select_program(std::uint16_t channel, const std::string& name);
  void mdi(std::uint16_t channel, const std::string& block);
  /// `line` counts from 1.
  void start_from_line(std::uint16_t channel, std::uint32_t line);
  idl::program::ProgramReply program(idl::program::ProgramRequest request);
  idl::parameters::ParameterReply parameter(idl::parameters::ParameterRequest request);
  idl::plc::PanelReply panel(idl::plc::PanelRequestKind kind);
  /// Resets the alarms of the whole machine; returns when the services have had time to answer.
  void reset_alarms();
  /// For an endpoint of a topic that every service and the launcher have: waits until `matched` counts all
  /// that run; 10 s at most.
  void wait_for_all_services(const std::function<int()>& matched);
  /// Stores `text` under `name` in chunks.
  void upload(const std::string& name, const std::string& text);
  std::string download(const std::string& name);
  /// The newest state of a topic, waiting up to `timeout` seconds for the first.
  template <class T>
  T newest(const bus::Topic<T>& topic, double timeout = 30);
  /// Of a topic with history that is written all the time: one that was written after this call began. That
  /// of a host whose clock is not ours counts after 5 s.
  template <class T>
  T present(const bus::Topic<T>& topic);

 private:
  bus::Bus bus_;
  service::RequestClient<ChannelRequest, ChannelReply> channel_;
  service::RequestClient<idl::program::ProgramRequest, idl::program::ProgramReply> program_;
  service::RequestClient<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> parameter_;
  service::RequestClient<idl::plc::PanelRequest, idl::plc::PanelReply> panel_;
};

template <class T>
T Client::newest(const bus::Topic<T>& topic, double timeout) {
  auto reader = bus_.reader(topic);
  T value;
  const double until = service::monotonic_seconds() + timeout;
  while (service::monotonic_seconds() < until) {
    if (reader.take_newest(value)) return value;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  throw std::runtime_error(std::string("no process publishes ") + topic.name);
}

template <class T>
T Client::present(const bus::Topic<T>& topic) {
  constexpr double clocks = 5, longest = 30;  // s
  const auto began = bus::source_time();
  auto reader = bus_.reader(topic);
  T value;
  bool any = false;
  const double start = service::monotonic_seconds();
  while (service::monotonic_seconds() - start < (any ? clocks : longest)) {
    while (reader.take(value)) any = true;
    if (any && reader.info().source_timestamp >= began) return value;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (!any) throw std::runtime_error(std::string("no process publishes ") + topic.name);
  return value;
}

}  // namespace trunnion::cluster
