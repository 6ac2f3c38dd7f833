// SPDX-License-Identifier: Apache-2.0
// The texts that one interpreter run reads: a program and the subprograms it calls.
#pragma once

#include <memory>
#include <string_view>

#include "contracts/types.hpp"
#include "program_text.hpp"

namespace trunnion::channel {

class ProgramCache {
 public:
  /// Drops every text.
  void clear() {
    main_.reset();
    subprograms_.clear();
  }
  language::TextSource& open(const idl::program::ProgramEntry& program);
  /// A stored program by the name a call gives it, with or without its extension; nullptr when there is none.
  language::TextSource* call(const idl::program::ProgramList& stored, std::string_view name);

  /// The least role of those who have stored the texts opened since the start; nothing when there are none. A
  /// text may have subprograms in it that are called as others are, so the text of a command is not known.
  std::optional<std::uint8_t> role() const;

  /// What has to be fetched next.
  std::optional<ChunkWanted> wanted() const;
  void deliver(const std::string& name, std::uint64_t offset, const std::vector<std::uint8_t>& data);
  void fail(const std::string& name);

 private:
  std::unique_ptr<ProgramText> main_;
  std::vector<std::unique_ptr<ProgramText>> subprograms_;
};

}  // namespace trunnion::channel
