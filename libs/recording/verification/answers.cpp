// SPDX-License-Identifier: Apache-2.0
#include "verification/answers.hpp"

#include "bus/codec.hpp"
#include "machine/print_file.hpp"

namespace trunnion::verification {

using idl::program::Operation;
using idl::program::ProgramReply;
using idl::program::ProgramRequest;

// Files of DPRNT are not read by a channel, so that a name has questions of one kind.
std::optional<Answers::Question> Answers::question_of(const ProgramRequest& request) {
  const bool prints = request.operation == Operation::WRITE && machine::is_print_file(request.name);
  if (request.operation != Operation::READ && !prints) return std::nullopt;
  return Question{request.name, request.revision, request.offset};
}

Answers::Answers(const StoredRecording& recording) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, Question> asked;
  ProgramRequest request;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "program_request" && bus::decode(message.cdr, request)) {
      if (const auto question = question_of(request)) asked[{request.client, request.number}] = *question;
    }
  ProgramReply reply;
  for (const auto& message : recording.messages) {
    if (message.topic->handle != "program_reply" || !bus::decode(message.cdr, reply)) continue;
    if (const auto question = asked.find({reply.client, reply.number}); question != asked.end())
      replies_[question->second].push_back(reply);
  }
}

std::optional<bus::Bytes> Answers::answer(const StoredMessage& request) {
  ProgramRequest question;
  if (request.topic->handle != "program_request" || !bus::decode(request.cdr, question)) return std::nullopt;
  const auto asked = question_of(question);
  const auto found = asked ? replies_.find(*asked) : replies_.end();
  if (found == replies_.end()) return std::nullopt;
  auto& replies = found->second;
  auto reply = replies.front();
  if (replies.size() > 1) replies.pop_front();
  reply.client = question.client;
  reply.number = question.number;
  bus::Bytes bytes;
  bus::encode(reply, bytes);
  return bytes;
}

}  // namespace trunnion::verification
