// SPDX-License-Identifier: Apache-2.0
// What the page is sent: one JSON document made of the newest samples of the bus.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "core/run_time.hpp"
#include "core/trace.hpp"

namespace trunnion::gateway {

/// Seconds without a heartbeat after which a service counts as silent; it sends four a second.
inline constexpr double heartbeat_timeout = 1.2;

/// `now` is in monotonic seconds, `time` an ISO 8601 instant; both only for display.
class StateDocument {
 public:
  void apply(const idl::service::Announcement& announcement);
  void apply(const idl::service::ServiceState& state, double now);
  void apply(const idl::service::Alarm& alarm, double now, const std::string& time);
  void apply(const idl::service::Cluster& cluster);
  void apply(const idl::channel::ChannelState& state);
  void apply(const idl::plc::Outputs& outputs);
  void apply(const idl::measurement::MeasurementState& state);
  void apply(const idl::stream::Feedback& feedback);
  /// Of the machine, as machine.yaml has it.
  void set_title(std::string title);
  /// Logical axis number of each column of the drive's feedback.
  void set_drive_axes(std::vector<std::uint16_t> axes);
  void set_revision(const char* what, std::uint64_t revision);

  /// Whether the alarm of this instance, number and part is active.
  bool is_active(const idl::service::Alarm& alarm) const;
  /// Whether it has heard of an executed cycle: until then the axes are shown where they stand, as commanded
  /// and actual.
  bool executed() const { return executed_; }
  /// The whole document; peaks and the trace start afresh with it.
  bus::Json document(double now);

  /// Null when the channel has not been heard of.
  const idl::channel::ChannelState* channel(std::uint16_t number) const;

 private:
  struct Known {
    idl::service::Announcement announcement;
    idl::service::ServiceState state;
    double heard = 0;
    bool announced = false, beating = false;
    bool contract_matches = true;
  };
  struct Raised {
    idl::service::Alarm alarm;
    std::string since;
    double heard = 0;
  };
  bus::Json services(double now) const;
  bus::Json alarms() const;
  bus::Json axes();
  bus::Json run_times();
  bus::Json spindles() const;

  std::map<std::uint32_t, Known> services_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Raised> alarms_;
  std::map<std::uint16_t, idl::channel::ChannelState> channels_;
  std::map<std::uint16_t, RunTime> run_times_;
  idl::service::Cluster cluster_;
  std::string title_;
  bool has_cluster_ = false;
  bus::Json plc_, measurement_, revisions_ = bus::Json::object();
  idl::stream::Feedback feedback_;
  bool has_feedback_ = false, executed_ = false;
  std::vector<double> commanded_, actual_, peak_;
  std::vector<std::uint16_t> drive_axes_;
  Trace trace_;
  bus::Json trace_document_;
};

}  // namespace trunnion::gateway
