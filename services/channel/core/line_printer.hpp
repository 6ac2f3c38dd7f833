// SPDX-License-Identifier: Apache-2.0
// Lines that programs and lines of MDI add to files of the program service (DPRNT) while the axes are at
// rest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "contracts/types.hpp"

namespace trunnion::channel {

/// The newest line of a program that is in its file, and where the next one goes.
struct PrintedLine {
  std::string file;
  std::uint32_t sequence = 0;  ///< of its command; 0: the program has no line in the file yet
  std::uint64_t end = 0;       ///< of the line in the file, bytes
  bool operator==(const PrintedLine&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("file", self.file), visit("sequence", self.sequence), visit("end", self.end);
  }
};

/// One line is open at a time. It is written at the place where the file is known to end, so that a line that
/// an earlier process has sent, or a program service that has ended has written, is not there twice.
class LinePrinter {
 public:
  enum class Outcome {
    not_open,
    waits,   ///< it is sent once more
    done,    ///< it is in the file
    refused  ///< reason(); begin() sends it again
  };
  enum class Source { program, line };

  /// What was printed before this process.
  void set_printed(const PrintedLine& printed) { program_ = printed; }
  const PrintedLine& printed() const { return program_; }

  /// A program starts, or `continues` behind an interruption: then the lines up to printed() are passed over.
  void start(bool continues);
  /// `file` has `stored` bytes in the list of the programs. False: the line was printed before the
  /// interruption.
  bool begin(Source source, const std::string& file, std::uint64_t stored, std::uint32_t sequence,
             std::string_view text);
  Outcome finish(const idl::program::ProgramReply& reply);
  const std::string& reason() const { return reason_; }
  /// Gives up what is open.
  void cancel() { open_ = unanswered_ = false, outgoing_.reset(); }

  bool open() const { return open_; }
  /// Nothing is open and everything has been taken.
  bool at_rest() const { return !open_ && !outgoing_; }
  std::optional<idl::program::ProgramRequest> take_request();

  bool has_printed() const { return !program_.file.empty() || !line_.file.empty(); }
  /// No fields, at rest nothing is open: source_, continues_, open_, moved_, unanswered_, sequence_,
  /// request_, outgoing_, reason_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("program", self.program_), visit("line", self.line_);
  }

 private:
  PrintedLine& place() { return source_ == Source::program ? program_ : line_; }

  PrintedLine program_, line_;  // of MDI a place of its own: it may print while a program is held
  Source source_ = Source::program;
  bool continues_ = false, open_ = false, moved_ = false;
  bool unanswered_ = false;  // whether the line of request_ is in its file is not known
  std::uint32_t sequence_ = 0;
  idl::program::ProgramRequest request_;
  std::optional<idl::program::ProgramRequest> outgoing_;
  std::string reason_;
};

}  // namespace trunnion::channel
