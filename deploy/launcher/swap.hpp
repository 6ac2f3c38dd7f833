// SPDX-License-Identifier: Apache-2.0
// Replaces one running service by another executable or vendor, step by step, inside the launcher's loop.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alarms_of_services.hpp"
#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "service_process.hpp"
#include "stream/batch_comparison.hpp"
#include "stream/batch_reader.hpp"
#include "swap_sequence.hpp"

namespace trunnion::launcher {

/// Does what SwapSequence decides: starts, promotes and ends processes, and collects what it decides by. A
/// stage is compared here, batch by batch; every other service compares itself and reports in its heartbeat.
/// Whatever goes wrong, the old one serves.
class Swap {
 public:
  using Announcements = std::map<std::uint32_t, idl::service::Announcement>;

  /// `old` and `announced` are the launcher's and outlive the swap. `now` in seconds, also below, is its
  /// RunningTime.
  Swap(bus::Bus& bus, const LaunchOptions& options, ServiceProcess& old,
       const idl::service::SwapRequest& request, std::uint32_t instance, const Announcements& announced,
       double now);
  /// Ends the new process when it has not taken over.
  ~Swap();
  Swap(const Swap&) = delete;
  Swap& operator=(const Swap&) = delete;

  /// The new process publishes its state.
  void hear(const idl::service::ServiceState& state, double now) { fresh_.hear(state, now); }
  bool is_fresh(std::uint32_t instance) const { return instance == fresh_.entry.instance; }
  /// Call it whenever messages have arrived and at least every 20 ms. The answer once it is over.
  std::optional<idl::service::SwapReply> step(double now);

 private:
  void read(double now);
  SwapView view(double now);
  void start_new(double now);
  void promote_new();
  void end_old();
  std::string why_not_at_rest() const;
  std::string difference() const;
  std::string reason(SwapFailure failure) const;
  idl::service::SwapReply reply(double now) const;
  idl::service::SwapReply kept(SwapFailure failure, double now) const;
  idl::service::SwapReply succeeded(double now);

  const LaunchOptions& options_;
  ServiceProcess& old_;
  ServiceProcess fresh_;
  const Announcements& announced_;
  idl::service::SwapRequest request_;
  Comparison comparison_;
  std::string standby_topic_;
  std::optional<stream::BatchReader<idl::stream::AxisBatch>> originals_, standby_;
  stream::BatchReader<idl::stream::Feedback> feedback_;
  bus::Reader<idl::channel::ChannelState> channels_;
  AlarmsOfServices alarms_;
  bus::Writer<idl::service::Promotion> promotions_;
  std::map<std::uint16_t, idl::channel::RunState> run_states_;
  std::vector<int> masters_;  ///< of each spindle; -1 = it follows none
  stream::BatchComparison batches_;
  std::uint64_t executed_ = 0, tick_ = 0, promoted_cycle_ = 0;
  double began_ = 0, moved_ = 0;
  bool succeeded_ = false;
  SwapSequence sequence_;
};

}  // namespace trunnion::launcher
