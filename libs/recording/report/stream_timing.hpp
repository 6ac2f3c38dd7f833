// SPDX-License-Identifier: Apache-2.0
// How punctual a stream in real time was, from its recordings: the delay of every process, and the lead that
// the computer needs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/capture.hpp"

namespace trunnion::report {

/// Delays in seconds, in the order they came.
class Delays {
 public:
  explicit Delays(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }
  void add(double seconds) { seconds_.push_back(seconds); }
  std::size_t count() const { return seconds_.size(); }
  /// The smallest delay that at least `share` (0..1) of them do not exceed, s; 0 without any.
  double quantile(double share) const;
  double largest() const { return quantile(1); }
  /// How many are in each bucket: below `edges[0]`, below `edges[1]` .. and the rest. `edges` ascend, s.
  std::vector<std::uint64_t> histogram(const std::vector<double>& edges) const;

 private:
  std::string name_;
  std::vector<double> seconds_;
};

/// Adds up recordings of one machine with one lead. Batches within a lead of the start of a motion do not
/// count: there the channel waits for the program and not for the drive.
class StreamTiming {
 public:
  /// `lead` in cycles (parameter 000900), `period` of a cycle in s.
  StreamTiming(std::uint64_t lead, double period);
  void add(const Capture& capture);

  /// The channel from the drive's feedback to its batch; each stage from its input to its output; the drive's
  /// period beyond its length; last the whole stream, from the feedback to the setpoints at the drive.
  const std::vector<Delays>& processes() const { return processes_; }
  const Delays& whole() const { return processes_.back(); }
  std::uint64_t starved() const { return starved_; }  ///< periods
  std::uint64_t cycles() const { return cycles_; }    ///< executed
  std::uint64_t lost() const { return lost_; }        ///< cycles that the recordings miss
  /// Cycles: twice the longest delay of the whole stream, as the drive keeps up to half of the lead for its
  /// stop (docs/hosts.md); 0 when nothing was measured.
  std::uint64_t usable_lead() const;

 private:
  void add_drive(const Capture& capture);
  void add_stream(const Capture& capture);

  std::uint64_t lead_;
  double period_;
  std::vector<Delays> processes_;
  std::uint64_t starved_ = 0, cycles_ = 0, lost_ = 0;
};

/// A table of delays in us with a histogram, one line for each process, then the lead.
std::string terminal_text(const StreamTiming& timing);
std::string json_text(const StreamTiming& timing);

}  // namespace trunnion::report
