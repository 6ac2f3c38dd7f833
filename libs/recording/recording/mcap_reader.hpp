// SPDX-License-Identifier: Apache-2.0
// Reads a recording from its beginning: whole, cut off, or around what is damaged.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "recording/damage.hpp"
#include "recording/mcap_index.hpp"

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
  complete,  ///< the file is whole and agrees with its checksums
  cut_off,   ///< the file ends before its end: everything before was delivered
  damaged,   ///< not a recording, or damages() names what contradicts itself or its checksum
};

/// Trusts no length: memory stays below a few times `largest_record` bytes for any content of the file.
/// Behind a damaged chunk it goes on with the next one, which the index at the end of a whole file names.
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
  /// What could not be read so far, in the order in which it was found.
  const std::vector<Damage>& damages() const { return damages_; }
  /// Of a whole file all of them, else what has been read of them so far; topics and metadata of our own
  /// recorder precede every message.
  const std::map<std::uint16_t, Schema>& schemas() const { return index_.schemas; }
  const std::map<std::uint16_t, Channel>& channels() const { return index_.channels; }
  const std::vector<Metadata>& metadata() const { return metadata_; }
  /// Chunks that have been read so far, by compression: "zstd", "none".
  const std::map<std::string, std::uint64_t>& compressions() const { return compressions_; }

 private:
  struct Decompressor;
  bool has_index() const { return index_.state == McapIndex::State::known; }
  std::uint64_t limit() const;
  bool end(Ending ending, std::string problem);
  bool skip(Ending without_index, std::string problem);
  bool load(std::uint64_t offset, std::uint64_t length);
  bool load_record();
  void load_chunk();
  void end_data();
  std::string open_chunk(std::span<const std::uint8_t> content);
  const char* parse(Opcode opcode, std::span<const std::uint8_t> content, MessageView& message);
  void note(Damage damage);
  bool next_of_file(MessageView& message);
  bool next_of_chunk(MessageView& message);

  Source& source_;
  std::uint64_t largest_record_;
  std::unique_ptr<Decompressor> decompressor_;
  McapIndex index_;
  std::size_t next_chunk_ = 0;            // of the index
  std::uint64_t begin_ = 0, offset_ = 0;  // of the record that was read, and of the next one
  std::uint32_t crc_ = 0;                 // of everything before the data end record
  Bytes record_, chunk_;
  Opcode opcode_ = Opcode::header;
  std::span<const std::uint8_t> in_chunk_;  // what is left of it
  Damage chunk_place_;                      // what is missing when the chunk cannot be read
  Ending ending_ = Ending::none;
  std::string problem_;
  std::vector<Damage> damages_;
  std::vector<Metadata> metadata_;
  std::map<std::string, std::uint64_t> compressions_;
};

}  // namespace trunnion::recording
