// Replaces one running service by another executable or vendor, step by step, inside the launcher's loop.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "service_process.hpp"
#include "stream/shadow_comparison.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::deploy {

/// A stage computes beside the old one, writing to a topic of its own, until enough cycles were equal; then
/// both take part as twins for a moment, and the old one is retired. Every other service begins as a process
/// that waits, and takes over when the old one has ended, because its files and its port have one owner at a
/// time. Meanwhile the PLC repeats what the old one does, over enough cycles, the keepers of parameters
/// and programs compare what they would publish, and the gateway what it would show; they say in their
/// heartbeat what differs. Whatever goes wrong, the old one serves.
class Swap {
 public:
  using Announcements = std::map<std::uint32_t, idl::service::Announcement>;

  /// `old` and `announced` are the launcher's and outlive the swap.
  Swap(bus::Bus& bus, const LaunchOptions& options, ServiceProcess& old,
       const idl::service::SwapRequest& request, std::uint32_t instance, const Announcements& announced);
  /// Ends the new one when it has not taken over.
  ~Swap();
  Swap(const Swap&) = delete;
  Swap& operator=(const Swap&) = delete;

  /// The new process says something of itself.
  void hear(const idl::service::ServiceState& state, double now) { fresh_.hear(state, now); }
  /// A child has ended: true when it is the new process.
  bool ended(int pid);
  bool is_fresh(std::uint32_t instance) const { return instance == fresh_.entry.instance; }
  /// Call it whenever messages have arrived and at least every 20 ms. The answer once it is over.
  std::optional<idl::service::SwapReply> step(double now);

 private:
  enum class Phase { starting, comparing, promoting, retiring, taking_over };

  void enter(Phase phase, double now);
  void read();
  std::optional<std::string> at_rest() const;
  std::optional<idl::service::SwapReply> after_start(double now);
  bool compares() const { return stage_.has_value() || counts_ticks_; }
  std::uint64_t compared() const;
  std::optional<std::string> difference() const;
  std::optional<idl::service::SwapReply> after_comparison(double now);
  std::optional<idl::service::SwapReply> after_retirement(double now);
  void retire(double now);
  bool start_again(const char* why, double now);
  idl::service::SwapReply keep(const std::string& reason);
  idl::service::SwapReply done(double now);
  void clear_alarms(std::uint32_t instance);

  bus::Bus& bus_;
  const LaunchOptions& options_;
  ServiceProcess& old_;
  ServiceProcess fresh_;
  const Announcements& announced_;
  idl::service::SwapRequest request_;
  std::optional<stream::Stage> stage_;  ///< nothing when it is no stage
  bool counts_ticks_;  ///< it is no stage and yet compared over a number of cycles, as the heartbeat of the
                       ///< new one tells
  std::string shadow_topic_;
  std::optional<bus::Reader<idl::stream::AxisFrame>> originals_, shadows_;
  bus::Reader<idl::stream::FeedbackFrame> feedback_;
  bus::Reader<idl::channel::ChannelState> channels_;
  bus::Reader<idl::service::Alarm> alarms_;
  bus::Writer<idl::service::Alarm> alarm_writer_;
  std::map<std::uint16_t, idl::channel::RunState> run_states_;
  std::map<std::array<std::uint32_t, 3>, idl::service::Alarm> active_alarms_;
  stream::ShadowComparison comparison_;
  std::uint64_t executed_ = 0, tick_ = 0, promoted_cycle_ = 0, compared_before_ = 0;
  Phase phase_ = Phase::starting;
  double began_ = 0, entered_ = 0, moved_ = 0, compared_at_ = 0, active_at_ = 0, retired_at_ = 0, gap_ = 0;
  bool fresh_ended_ = false, started_again_ = false, taken_over_ = false;
};

}  // namespace trunnion::deploy
