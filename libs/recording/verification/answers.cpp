// SPDX-License-Identifier: Apache-2.0
#include "verification/answers.hpp"

#include "bus/codec.hpp"

namespace trunnion::verification {

using idl::program::Operation;
using idl::program::ProgramReply;
using idl::program::ProgramRequest;

Answers::Answers(const StoredRecording& recording) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, Question> asked;
  ProgramRequest request;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "program_request" && bus::decode(message.cdr, request) &&
        request.operation == Operation::READ)
      asked[{request.client, request.number}] = {request.name, request.revision, request.offset};
  ProgramReply reply;
  for (const auto& message : recording.messages) {
    if (message.topic->handle != "program_reply" || !bus::decode(message.cdr, reply)) continue;
    if (const auto question = asked.find({reply.client, reply.number}); question != asked.end())
      replies_[question->second] = reply;
  }
}

std::optional<bus::Bytes> Answers::answer(const StoredMessage& request) {
  ProgramRequest question;
  if (request.topic->handle != "program_request" || !bus::decode(request.cdr, question) ||
      question.operation != Operation::READ)
    return std::nullopt;
  const auto found = replies_.find({question.name, question.revision, question.offset});
  if (found == replies_.end()) return std::nullopt;
  found->second.client = question.client;
  found->second.number = question.number;
  bus::Bytes bytes;
  bus::encode(found->second, bytes);
  return bytes;
}

}  // namespace trunnion::verification
