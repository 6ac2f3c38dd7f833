// SPDX-License-Identifier: Apache-2.0
// What the gateway's state document must say, worked out from the messages it was given by other code than
// its own.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// Whether the gateway shows what this topic says.
bool is_shown(const bus::TopicEntry& topic);

class ShownState {
 public:
  /// Takes one message into account, in the order of the writers' clocks. What `is_shown` does not name is
  /// left alone.
  void observe(const StoredMessage& message);
  /// The document, without what the gateway tells by its own clock (see `by_clock`).
  bus::Json document() const;
  /// Paths to read and what their answers must be at rest.
  std::map<std::string, bus::Json> answers() const;

 private:
  struct Raised {
    idl::service::Alarm alarm;
    bool before_beat = false;  ///< its source has beaten since
  };
  void beat(const idl::service::ServiceState& state);
  bus::Json services() const;
  bus::Json axes() const;

  std::map<std::uint32_t, idl::service::Announcement> announced_;
  std::map<std::uint32_t, idl::service::ServiceState> beats_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Raised> alarms_;
  std::map<std::uint16_t, bus::Json> channels_;
  std::map<std::string, std::uint64_t> revisions_;
  std::map<std::string, bus::Json> newest_;  ///< of the topics that are read as they are, by path
  bus::Json cluster_, drive_, plc_, measurement_, measurement_result_;
  idl::service::Cluster plan_;
  idl::stream::Feedback feedback_;
  std::vector<double> commanded_, actual_;  ///< the newest row; before there is one, where the axes stand
  bool executed_ = false;                   ///< there was a row
  std::vector<std::uint16_t> columns_;
};

/// Takes out of a gateway's document what its clock has a say in (a sign of life that is too old, a process
/// that the launcher does not name, when an alarm was first heard of, how long a program has run, what
/// happened between two looks), the title, which machine.yaml has, and what it says of itself, `instance`.
void take_out_clock(bus::Json& document, std::uint32_t instance);

/// Where the two are not the same: path, what was expected, what is shown, in one line; empty when nowhere.
/// Values of axes and drive may be rounded to the nanometre.
std::string shown_difference(const bus::Json& expected, const bus::Json& shown, const std::string& path = "");

}  // namespace trunnion::verification
