// SPDX-License-Identifier: Apache-2.0
// Stands in for the program service: answers a new process's requests with the replies of a recording.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <tuple>

#include "contracts/types.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// Requests are told apart by what they ask for: who asks is another process every time.
class Answers {
 public:
  explicit Answers(const StoredRecording& recording);
  /// The recorded reply to a request for the same text, addressed to this one, or to a line of DPRNT at the
  /// same place of its file; none when `request` is neither or nobody asked that in the recording. Of several
  /// the next one, and the last one again.
  std::optional<bus::Bytes> answer(const StoredMessage& request);

 private:
  using Question = std::tuple<std::string, std::uint64_t, std::uint64_t>;  // name, revision, offset
  static std::optional<Question> question_of(const idl::program::ProgramRequest& request);
  std::map<Question, std::deque<idl::program::ProgramReply>> replies_;
};

}  // namespace trunnion::verification
