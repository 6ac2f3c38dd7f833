// SPDX-License-Identifier: Apache-2.0
// Writes a recording: chunks of messages, compressed and indexed, then a summary.
#pragma once

#include <memory>
#include <vector>

#include "recording/mcap_format.hpp"

namespace trunnion::recording {

enum class Compression : std::uint8_t { none, zstd };

struct WriterOptions {
  std::string library = "trunnion";
  std::size_t chunk_bytes = 1 << 20;            ///< of messages in a chunk before compression, about
  int compression_level = 1;                    ///< of zstd, 1..19
  Compression compression = Compression::zstd;  ///< of the chunks; one that does not get smaller has none
};

/// A file that is cut off anywhere can be read up to its last whole chunk. After a sink's failure nothing
/// more is written and every call returns false.
class Writer {
 public:
  explicit Writer(Sink& sink, WriterOptions options = {});
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Declares a topic of CDR messages whose type `type` is defined by the IDL text `schema`. It appears in
  /// the file with its first message. Topics of one type share the schema.
  std::uint16_t add_channel(const std::string& topic, const std::string& type, const std::string& schema,
                            const StringMap& metadata = {});
  bool metadata(const std::string& name, const StringMap& values);
  /// `time` in ns since the epoch; `sequence` counts the messages of the channel, so that one left out shows.
  bool write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time,
             std::span<const std::uint8_t> cdr);
  /// Ends the chunk: what has been written so far survives a crash.
  bool flush();
  /// Ends the file. Nothing may follow.
  bool finish();

  bool failed() const { return failed_; }
  std::uint64_t messages() const { return messages_; }
  std::uint64_t bytes() const { return offset_; }

 private:
  struct Index {
    std::vector<std::uint64_t> entries;  // time and offset in turn
  };
  struct ChunkEntry {
    std::uint64_t first_time, last_time, offset, length, index_length, compressed, uncompressed;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes;
  };
  struct ChannelEntry {
    Channel channel;
    bool written = false;
    std::uint64_t count = 0;
    Index index;  // of the current chunk
  };
  struct SchemaEntry {
    Schema schema;
    bool written = false;
  };
  struct MetadataEntry {
    std::uint64_t offset, length;
    std::string name;
  };
  struct Compressor;

  bool emit();
  std::span<const std::uint8_t> stored_chunk();
  void put_schema(RecordWriter& out, const Schema& schema);
  void put_channel(RecordWriter& out, const Channel& channel);
  void put_summary();

  Sink& sink_;
  WriterOptions options_;
  std::unique_ptr<Compressor> compressor_;
  bool failed_ = false, finished_ = false;
  std::uint64_t offset_ = 0;
  std::uint32_t data_crc_ = 0;
  Bytes out_, chunk_, compressed_;
  std::uint64_t chunk_first_ = 0, chunk_last_ = 0, chunk_messages_ = 0;
  std::uint64_t messages_ = 0, first_time_ = 0, last_time_ = 0;
  std::vector<SchemaEntry> schemas_;    // id - 1
  std::vector<ChannelEntry> channels_;  // id
  std::vector<ChunkEntry> chunks_;
  std::vector<MetadataEntry> metadata_;
};

}  // namespace trunnion::recording
