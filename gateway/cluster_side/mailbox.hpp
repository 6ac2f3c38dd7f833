// SPDX-License-Identifier: Apache-2.0
// What the two threads exchange: requests from the HTTP side to the bus, the newest state the other way.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "bus/bus.hpp"
#include "cluster_side/request_lanes.hpp"
#include "contracts/topics.hpp"
#include "core/cluster_state.hpp"
#include "core/operator_journal.hpp"

namespace trunnion::gateway {

/// Numbers the lines and writes them.
class OperatorJournal {
 public:
  explicit OperatorJournal(bus::Bus& bus) : writer_(bus.writer(topics::operator_request)) {}
  void write(JournalLine line) {
    line.line = ++lines_;
    writer_.write(line);
  }

 private:
  bus::Writer<JournalLine> writer_;
  std::uint64_t lines_ = 0;
};

/// They have no replies.
class AlarmResets {
 public:
  explicit AlarmResets(bus::Bus& bus)
      : writer_(bus.writer(topics::alarm_reset)), client_(service::make_client_id()) {}
  Asked write(idl::service::AlarmReset reset) {
    reset.client = client_;
    reset.number = ++number_;
    writer_.write(reset);
    return {client_, number_, 1};
  }

 private:
  bus::Writer<idl::service::AlarmReset> writer_;
  std::uint64_t client_, number_ = 0;
};

/// The writing side of the bus. Only the bus thread touches it.
struct Links {
  explicit Links(bus::Bus& bus);
  /// True when replies have come that pump() is to pass on.
  bool receive();
  void pump(double now);
  /// Seconds after which pump() is to be called at the latest; nothing when no request is under way.
  std::optional<double> period() const;

  /// Before `start` is sent: stops of its channel are not repeated any more.
  void withdraw_stops(const idl::channel::ChannelRequest& start);
  /// Before `stop` is sent: a start of its channel that was lost until now must not arrive behind it.
  void withdraw_starts(const idl::channel::ChannelRequest& stop);
  /// Before `stop` is sent: the same one of before need not be repeated beside it.
  void repeat_only(const idl::channel::ChannelRequest& stop);

  RequestLanes<idl::channel::ChannelRequest, idl::channel::ChannelReply> channel;
  RequestLanes<idl::plc::PanelRequest, idl::plc::PanelReply> panel;
  RequestLanes<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> parameters;
  RequestLanes<idl::program::ProgramRequest, idl::program::ProgramReply> program;
  RequestLanes<idl::plc::OnlineRequest, idl::plc::OnlineReply> online;
  RequestLanes<idl::measurement::MeasurementRequest, idl::measurement::MeasurementReply> measurement;
  AlarmResets alarm_resets;
  OperatorJournal journal;
};

using Job = std::function<void(Links&, double now)>;

class Mailbox {
 public:
  explicit Mailbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// HTTP side: runs `job` on the bus thread soon.
  void post(Job job);
  /// HTTP side: the newest state; null until there is one.
  std::shared_ptr<const ClusterState> newest() const;

  /// Bus side.
  std::vector<Job> take();
  void publish(std::shared_ptr<const ClusterState> cluster);

 private:
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::vector<Job> jobs_;
  std::shared_ptr<const ClusterState> newest_;
};

}  // namespace trunnion::gateway
