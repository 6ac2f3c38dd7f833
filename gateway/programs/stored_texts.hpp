// SPDX-License-Identifier: Apache-2.0
// Texts of stored programs for a thread that may wait.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "cluster_side/mailbox.hpp"
#include "language/text_source.hpp"

namespace trunnion::gateway {

/// From the program service, each once. Waits for its answers.
class StoredTexts {
 public:
  static constexpr std::size_t largest = 8u << 20;  ///< bytes of one text
  static constexpr std::uint32_t part = 60000;      ///< bytes in one request

  struct Text final : language::TextSource {
    idl::program::ProgramEntry entry;
    std::string bytes;
    language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
      return language::StringSource(bytes).read(offset, buffer, capacity);
    }
    std::string_view name() const override { return entry.name; }
  };

  explicit StoredTexts(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// By the name of a program or of a subprogram as it is called; null when there is none, when it is larger
  /// than `largest`, and when nobody answers.
  Text* find(std::string_view call);
  /// For the journal.
  Asked asked() const { return {client_, number_ > 0 ? 1u : 0u, static_cast<std::uint32_t>(number_)}; }

 private:
  using Reply = idl::program::ProgramReply;
  std::unique_ptr<Text> read(const std::string& call);
  std::optional<Reply> ask(idl::program::ProgramRequest request);

  Mailbox& mailbox_;
  std::uint64_t client_ = service::make_client_id(), number_ = 0;
  std::map<std::string, std::unique_ptr<Text>> texts_;
};

}  // namespace trunnion::gateway
