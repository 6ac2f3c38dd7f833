// SPDX-License-Identifier: Apache-2.0
#include "line_printer.hpp"

#include <algorithm>
#include <utility>

#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

void LinePrinter::start(bool continues) {
  continues_ = continues;
  if (continues) return;
  cancel();
  program_.sequence = 0;
}

// The list of the programs may be older than the newest line of this process, and the place of the newest
// line that is known older than the last one of the process before: what that has sent is found there. A
// line without an answer, and one that was refused, may be in the file and in the list: it stays at its
// place.
bool LinePrinter::begin(Source source, const std::string& file, std::uint64_t stored, std::uint32_t sequence,
                        std::string_view text) {
  const bool again = unanswered_ && source_ == source && sequence_ == sequence && request_.name == file;
  source_ = source;
  auto& known = place();
  const bool same = known.file == file;
  const bool continues = source == Source::program && continues_ && same;
  if (continues && sequence <= known.sequence) return false;
  if (!again) {
    request_ = {};
    request_.operation = idl::program::Operation::WRITE;
    request_.name = file;
    request_.offset = continues ? known.end : std::max(stored, same ? known.end : 0);
    request_.data.assign(text.begin(), text.end());
    request_.data.push_back('\n');
    // Before it is sent, so that a process behind this one finds the line.
    if (!same) known = {file, 0, 0};
    known.end = request_.offset;
  }
  sequence_ = sequence;
  open_ = unanswered_ = true, moved_ = false;
  outgoing_ = request_;
  return true;
}

// A reply that comes before the request was taken is that to a line that was given up.
LinePrinter::Outcome LinePrinter::finish(const idl::program::ProgramReply& reply) {
  if (!open_ || outgoing_) return Outcome::not_open;
  if (reply.accepted) {
    place() = {request_.name, sequence_, reply.offset};
    open_ = unanswered_ = false;
    return Outcome::done;
  }
  // Somebody has deleted the file, or written to it.
  if (reply.alarm == alarm::request_invalid.number && !moved_ && reply.offset != request_.offset) {
    moved_ = true;
    request_.offset = place().end = reply.offset;
    outgoing_ = request_;
    return Outcome::waits;
  }
  reason_ = reply.reason;
  open_ = false;
  return Outcome::refused;
}

std::optional<idl::program::ProgramRequest> LinePrinter::take_request() {
  return std::exchange(outgoing_, std::nullopt);
}

}  // namespace trunnion::channel
