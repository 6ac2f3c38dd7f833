// SPDX-License-Identifier: Apache-2.0
// What a service is fed from a recording, in which order and when, and what it must answer. No DDS, no clock.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "verification/progress.hpp"
#include "verification/seed.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct Step {
  const StoredMessage* message = nullptr;  ///< of the recording; to write once `needs` are reached
  std::vector<Mark> needs;                 ///< that the needs of earlier steps do not imply
  bool apart = false;  ///< must be taken before what follows on other topics, and after what came before
};

struct VerifyPlan {
  std::vector<Step> steps;
  std::deque<StoredMessage> stand_ins;  ///< for inputs that were overwritten before they were recorded
  std::vector<Mark> end;                ///< reached when every recorded output has come
  std::vector<StoredMessage> expected;  ///< outputs to compare with
  std::set<std::string> topics;         ///< handles of the outputs that are compared
  /// Outputs that say when a service noticed something, which is not decided by its inputs alone.
  std::set<std::string> ignored;
  /// Why the recording does not determine the spindles, in one line; empty: it does.
  std::string spindles_unknown;
  std::uint64_t cycles = 0;  ///< of the stream, in `expected`
  double cycle_seconds = 0.001;
  bool virtual_time = true;
  std::uint32_t instance = 0;  ///< of the service in the recording
  std::optional<Seed> seed;    ///< the state the service continues from; none: it starts as on a new machine

  /// What a service writes beyond the end of the recording, or in an epoch that was given up, has no
  /// counterpart: it is taken away. Returns how many messages that were.
  std::size_t drop_unrecorded(std::vector<StoredMessage>& produced) const;
};

/// The recording gives nothing to verify a service with, however right or wrong it is: it had nothing to do,
/// or its periods followed the clock.
class NothingToVerify : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stages are fed by cycle: a batch when the drive had executed what the channel's credit for it needs and
/// the stage is at most some batches behind; one that starts when everything before it is done; parameters
/// before the first batch made with them. Other services are fed in the order of the recording, each message
/// once the service has written what it had written before it. `channel` matters to a channel only.
/// Throws std::runtime_error when the recording does not have what it takes, NothingToVerify when that is not
/// its fault.
VerifyPlan plan_verification(const StoredRecording& recording, const std::string& service,
                             std::uint16_t channel);
VerifyPlan plan_verification(StoredRecording&&, const std::string&,
                             std::uint16_t) = delete;  // steps point into it

/// A plan that has only what a recording says of the cluster: cycle time, kind of time, instance. A service
/// that is not in it gets a number that no other has.
VerifyPlan surroundings(const StoredRecording& recording, const std::string& service,
                        std::uint16_t channel = 0);

/// Throws std::runtime_error, one line with the version of the recording, when a topic that the service or
/// its verification reads, or by which it is verified, is recorded in the form of another contract: what
/// follows from it differs.
void require_contract(const StoredRecording& recording, const std::string& service);

/// The first cycles of the drive's feedback that the recorder has lost between those of `plan`, in one line;
/// empty when it has them all.
std::string missing_feedback(const VerifyPlan& plan);

/// The first request to a channel that the recording has the reply to, but not the request itself, in one
/// line; empty when it has them all. Requests that were answered before the recording began do not count.
std::string missing_request(const StoredRecording& recording);

/// Why a recording of a machine on several hosts cannot be verified where its network was interrupted, in one
/// line with the host that was silent; empty when none was. Messages have the time at which they were
/// written: when they arrived behind an interruption, and in what order, is not recorded.
std::string interrupted_network(const StoredRecording& recording);

/// Alarms that `service` raises in `messages`: number, part and text of the first.
std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> raised_alarms(
    const std::vector<StoredMessage>& messages, const std::string& service);

/// The first alarm of `service` in `produced` that `recorded` does not have, in one line; empty when none.
std::string unexpected_alarm(const std::vector<StoredMessage>& recorded,
                             const std::vector<StoredMessage>& produced, const std::string& service);

}  // namespace trunnion::verification
