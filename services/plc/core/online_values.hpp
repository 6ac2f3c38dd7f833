// SPDX-License-Identifier: Apache-2.0
// Answers clients that read values of the programs: lists, watch lists, a trace.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "plc_core.hpp"

namespace trunnion::plc {

inline constexpr std::size_t watch_slots = 8, most_watched = 256, most_watched_cells = 4096;
inline constexpr double watch_lifetime = 5;  ///< s without a repetition of the request

class OnlineValues {
 public:
  explicit OnlineValues(st::Variables variables) : variables_(std::move(variables)) {}

  const st::Variables& variables() const { return variables_; }
  /// Other programs run: watch lists go on with the variables of the same path, those that lack one end, and
  /// so does the trace.
  void replace(st::Variables variables, PlcCore& core);
  /// LIST_VARIABLES, WATCH, END_WATCH, START_TRACE, READ_TRACE, END_TRACE. `now` in s.
  idl::plc::OnlineReply answer(const idl::plc::OnlineRequest& request, PlcCore& core, double now);

  /// Ends watch lists that nobody has asked for lately. `now` in s.
  void expire(double now);
  /// Copies the values of the list in the slot; nothing when it has not changed since. No allocation.
  const idl::plc::Watched* watched(std::size_t slot, const Memory& memory);

 private:
  struct Watch {
    std::vector<std::string> paths;
    std::vector<st::Location> elements;
    std::vector<ValuePlace> places;
    double until = 0;
    idl::plc::Watched sample, last;
    bool written = false;
  };
  struct Trace {
    std::uint64_t client = 0;
    std::uint64_t number = 0;
    ScanTrace scans;
  };
  void list(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply) const;
  void watch(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply, double now);
  void start_trace(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply, PlcCore& core);
  void read_trace(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply) const;
  std::vector<st::Location> elements_of(const std::vector<std::string>& paths) const;
  void fill(Watch& watch);
  void end_trace(PlcCore& core);

  st::Variables variables_;
  std::array<std::optional<Watch>, watch_slots> watches_;
  idl::plc::Watched empty_;
  std::array<bool, watch_slots> freed_{};
  std::optional<Trace> trace_;
};

}  // namespace trunnion::plc
