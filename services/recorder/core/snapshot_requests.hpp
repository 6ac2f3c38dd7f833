// SPDX-License-Identifier: Apache-2.0
// Which services still owe a recording their state, and when they are asked, again when they are silent.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::recorder {

/// `now` and `when` are seconds of one monotonic clock, `time` is a source time stamp in ns.
class SnapshotRequests {
 public:
  static constexpr double start_seconds = 1;  ///< until a process that was just started reads requests
  static constexpr double first_pause =
      0.5;  ///< before the first repetition; each further one is twice as long
  static constexpr double longest_pause = 8;  ///< between repetitions
  static constexpr double late_seconds = 15;  ///< after which a silent service is named

  enum class Due { nothing, request, repetition };
  struct News {
    std::string service;
    bool given = false;  ///< its state has come after all; else it is late
    bool operator==(const News&) const = default;
  };

  /// The launcher's list: whoever runs owes its state from the next request on, and from now on when that was
  /// before.
  void expect(const idl::service::Cluster& cluster, double now);
  /// All are asked at `when`, unless that is planned for earlier.
  void ask_at(double when);
  /// A process said at `time` that it is there. The recording lacks its state when all were asked before.
  void see_process(std::uint64_t time, double now);
  /// What is to be written now. A new request asks for the states from `time` on; a repetition is for those
  /// that did not read requests yet.
  Due due(double now, std::uint64_t time);
  void take(const idl::service::ServiceSnapshot& part);

  /// Of the newest request, from 1.
  std::uint64_t number() const { return number_; }
  /// Nobody owes an answer. An answer is also the reason why a state comes later.
  bool answered() const;
  /// Who owes one, in the order of the list.
  std::vector<std::string> owing() const;
  /// Of the services that are late: each once, and once again when it has answered.
  std::vector<News> take_news(double now);
  /// Who answered the newest request and reads `topic` has taken the message of source time `newest`. Until
  /// then its state lacks a message that is not in the recording either.
  bool has_taken(const std::string& topic, std::int64_t newest) const;

 private:
  struct Service {
    std::string name;
    std::optional<double> owes_since;
    bool is_named = false;
  };
  std::map<std::uint32_t, Service> services_;  // by instance
  std::uint64_t number_ = 0;
  std::uint64_t asked_ = 0;  // source time of the newest request
  std::optional<double> next_;
  double repetition_ = 0, pause_ = first_pause;
  std::vector<News> news_;
  std::map<std::string, std::uint64_t> taken_;  // by topic, the least of the newest answers
};

}  // namespace trunnion::recorder
