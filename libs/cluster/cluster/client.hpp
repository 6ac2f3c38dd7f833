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

/// A state that each channel publishes.
template <class T>
concept of_channel = requires(const T& state) {
  state.channel;
};

class Client {
 public:
  /// To the cluster in `domain` whose launcher runs on this computer.
  explicit Client(std::uint32_t domain);
  explicit Client(const bus::NetworkSettings& network);

  bus::Bus& bus() { return bus_; }
  /// Throws std::runtime_error with the reason when it is refused or nobody answers.
  /// Client and number of the request are given by this client.
  void channel(ChannelRequest request);
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
  /// Stores `text` under `name` in chunks; gives its revision.
  std::uint64_t upload(const std::string& name, const std::string& text);
  std::string download(const std::string& name);
  /// The state of a topic that is true now: never older than the replies that came before this call. Waits up
  /// to `timeout` seconds for it.
  template <class T>
  requires(!of_channel<T>) T newest(const bus::Topic<T>& topic, double timeout = longest_wait);
  /// Of a topic with a state for each channel, that of `channel`.
  template <class T>
  requires of_channel<T> T newest(const bus::Topic<T>& topic, std::uint16_t channel);
  /// For a loop that follows a topic: the first sample is what newest() would give.
  template <class T>
  bus::Reader<T> reader_from_now(const bus::Topic<T>& topic);

 private:
  static constexpr double longest_wait = 30;  // s
  template <class T, class Condition>
  T first(const bus::Topic<T>& topic, double timeout, Condition condition);

  template <class Request, class Reply>
  void await_recorder(service::RequestClient<Request, Reply>& requests, const char* topic);

  bus::Bus bus_;
  const bool recorded_;
  service::RequestClient<ChannelRequest, ChannelReply> channel_;
  service::RequestClient<idl::program::ProgramRequest, idl::program::ProgramReply> program_;
  service::RequestClient<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> parameter_;
  service::RequestClient<idl::plc::PanelRequest, idl::plc::PanelReply> panel_;
};

// A writer keeps one sample of a state, and that follows from every request it has answered. Of any other
// topic the history would come first, and piece by piece: only what is written from now on counts.
template <class T>
bus::Reader<T> Client::reader_from_now(const bus::Topic<T>& topic) {
  auto qos = bus::reader_qos(topic.qos);
  qos.transient_local = topic.qos == bus::QosKind::state;
  return bus::Reader<T>(bus_.backend().reader(bus::describe(topic), qos, &bus_.signal()));
}

template <class T, class Condition>
T Client::first(const bus::Topic<T>& topic, double timeout, Condition condition) {
  auto reader = reader_from_now(topic);
  T value;
  const double until = service::monotonic_seconds() + timeout;
  while (service::monotonic_seconds() < until) {
    while (reader.take(value))
      if (condition(value)) return value;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  throw std::runtime_error(std::string("no process publishes ") + topic.name);
}

template <class T>
requires(!of_channel<T>) T Client::newest(const bus::Topic<T>& topic, double timeout) {
  return first(topic, timeout, [](const T&) { return true; });
}

template <class T>
requires of_channel<T> T Client::newest(const bus::Topic<T>& topic, std::uint16_t channel) {
  try {
    return first(topic, longest_wait, [&](const T& value) { return value.channel == channel; });
  } catch (const std::runtime_error&) {
    throw std::runtime_error("channel " + std::to_string(channel) + " publishes nothing on " + topic.name);
  }
}

}  // namespace trunnion::cluster
