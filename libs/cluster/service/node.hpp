// SPDX-License-Identifier: Apache-2.0
// The shell every service runs in: one thread that waits, takes, computes and writes; lifecycle, heartbeat,
// alarms.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "bus/bus.hpp"
#include "bus/json_type.hpp"
#include "contracts/topics.hpp"
#include "service/alarm_board.hpp"
#include "service/notify.hpp"
#include "service/options.hpp"
#include "service/snapshot_desk.hpp"

namespace trunnion::service {

/// Channel of an AlarmReset that is for the whole machine.
inline constexpr std::uint16_t all_channels = 65535;

/// What a service shows of itself four times a second.
struct Health {
  idl::service::Lifecycle lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  std::string detail;
  std::uint64_t messages_in = 0, messages_out = 0, cycles_lost = 0;
  std::uint64_t revision = 0;
  bool in_step = true;
  /// Of a process on standby: ticks in which it has done the same as the one it is to replace, and what
  /// differs with both values, the running one's first; empty = nothing.
  std::uint64_t compared = 0;
  std::string difference;
};

class Node;

/// One service. Its constructor makes its readers and writers from the node's bus.
class Service {
 public:
  /// It can work on standby: beside the service it is to replace, compared with it. One that cannot, because
  /// it owns files or a port, is made only when the other has ended. Until then a member type `Standby`, if
  /// it has one, is what works on standby: a Service that writes nothing and reports in its health how it
  /// compares.
  static constexpr bool works_on_standby = false;

  virtual ~Service() = default;
  /// Data has arrived or `period()` has passed: take everything, compute, write.
  virtual void pump() = 0;
  /// Longest time in seconds between two calls of pump().
  virtual double period() const { return 0.05; }
  virtual Health health() const = 0;
  /// Alarms without a cause are being cleared: those that concern `channel`, or of the whole machine with
  /// all_channels.
  virtual void alarms_reset(std::uint16_t) {}
  /// Whether an alarm about `axis` (its logical number) concerns `channel`.
  virtual bool axis_concerns(std::uint16_t /*axis*/, std::uint16_t /*channel*/) const { return false; }
  /// Its explicit state now, between two calls of pump(), on request of a recorder. A process that is started
  /// with it (Node::snapshot()) continues like this one.
  virtual SnapshotAnswer snapshot() { return {}; }
  /// The process is told to end: the last chance to leave something for the next.
  virtual void end() {}
};

class Node {
 public:
  explicit Node(Options options);

  const Options& options() const { return options_; }
  bus::Bus& bus() { return bus_; }
  AlarmBoard& alarms() { return alarms_; }
  /// The recorded state that the service continues from; null when it starts as usual.
  const bus::Json* snapshot() const { return snapshot_.get(); }

  /// Started beside the service that it is to replace, and not promoted yet.
  bool on_standby() const { return options_.standby; }
  /// Waits, inactive, until this process is promoted. False when it is told to end instead.
  /// Meanwhile `standby`, if there is one, is pumped and reports the health.
  bool stand_by(Service* standby = nullptr);
  /// Runs until SIGTERM or SIGINT; returns the exit status.
  int run(Service& service);
  /// Clears the alarms of `service` whose cause is gone: all of them, or those that concern `channel`.
  void reset_alarms(Service& service, std::uint16_t channel);

 private:
  void announce();
  void beat(const Health& health);
  void take_promotion();
  void report_refusals();
  Options options_;
  bus::Bus bus_;
  AlarmBoard alarms_;
  SnapshotDesk snapshot_desk_;
  std::shared_ptr<const bus::Json> snapshot_;
  bus::Writer<idl::service::Announcement> announcement_;
  bus::Writer<idl::service::ServiceState> state_writer_;
  bus::Reader<idl::service::AlarmReset> alarm_reset_;
  std::optional<bus::Reader<idl::service::Promotion>> promotions_;  // while on standby
  idl::service::ServiceState state_;
  Notifier notifier_;
  double started_ = 0;
  double last_beat_ = 0;
  std::uint64_t last_messages_ = 0;
  std::uint64_t refusals_told_ = 0;               // of all topics
  std::map<std::string, std::uint64_t> told_of_;  // by topic
};

/// Asks the system to run this process before ordinary ones from when the service is active on, and without
/// page faults from now on. Call before the first thread is made. False when the system does not allow it;
/// the service then runs like any other.
bool use_real_time_scheduling();

/// Monotonic seconds, for time-outs and statistics only.
double monotonic_seconds();
/// ISO 8601 in UTC, to the second, for people to read.
std::string time_of_day();

/// How main() makes a service and, if it has one, what works beside the service that it is to replace.
struct ServiceType {
  using Make = std::unique_ptr<Service> (*)(Node& node);
  Make service = nullptr;
  Make standby = nullptr;  ///< null when there is none
  bool works_on_standby = false;
};

template <class S>
constexpr ServiceType service_type() {
  ServiceType type;
  type.service = [](Node& node) -> std::unique_ptr<Service> { return std::make_unique<S>(node); };
  if constexpr (requires { typename S::Standby; })
    type.standby = [](Node& node) -> std::unique_ptr<Service> {
      return std::make_unique<typename S::Standby>(node);
    };
  type.works_on_standby = S::works_on_standby;
  return type;
}

/// main() of a service: parse, make the node and the service, run. One line on stderr and status 1 on
/// failure.
int run_service(int argc, char** argv, const char* name, const ServiceType& type);

template <class S>
int service_main(int argc, char** argv, const char* name) {
  return run_service(argc, argv, name, service_type<S>());
}

}  // namespace trunnion::service
