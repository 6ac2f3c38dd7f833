// SPDX-License-Identifier: Apache-2.0
// Reads a recording from its beginning, whole or cut off.
#pragma once

#include <map>
#include <memory>

#include "recording/mcap_format.hpp"

namespace trunnion::recording {

/// One message; valid until the next call of Reader::next().
struct MessageView {
  const Channel* channel = nullptr;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;  ///< ns since the epoch
  std::span<const std::uint8_t> data;
};

enum class Ending : std::uint8_t {
  none,      ///< there may be more
  complete,  ///< the data end record was found
  cut_off,   ///< the file ends in the middle of a record: everything before was delivered
  damaged,   ///< not a recording, or a record that contradicts itself or its checksum
};

/// Trusts no length: memory stays below `largest_record` bytes per record and chunk for any content of the
/// file.
class Reader {
 public:
  /// `source` must outlive the reader.
  explicit Reader(Source& source, std::uint64_t largest_record = 64u << 20);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next message in the order of writing, or false: see ending().
  bool next(MessageView& message);

  Ending ending() const { return ending_; }
  /// Why it ended other than complete, one line; else empty.
  const std::string& problem() const { return problem_; }
  /// What has been read of them so far; topics and metadata of our own recorder precede every message.
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  const std::vector<Metadata>& metadata() const { return metadata_; }

 private:
  struct Decompressor;
  bool end(Ending ending, std::string problem);
  bool read_record();
  bool open_chunk(std::span<const std::uint8_t> content);
  bool parse(Opcode opcode, std::span<const std::uint8_t> content, MessageView& message, bool& is_message);

  Source& source_;
  std::uint64_t largest_record_;
  std::unique_ptr<Decompressor> decompressor_;
  std::uint64_t offset_ = 0;
  Bytes record_, chunk_;
  Opcode opcode_ = Opcode::header;
  std::span<const std::uint8_t> in_chunk_;  // what is left of it
  Ending ending_ = Ending::none;
  std::string problem_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Metadata> metadata_;
};

}  // namespace trunnion::recording
