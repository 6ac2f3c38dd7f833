// SPDX-License-Identifier: Apache-2.0
#include "recording/mcap_writer.hpp"

#include <zstd.h>

#include <algorithm>

#include "storage/crc32.hpp"

namespace trunnion::recording {

struct Writer::Compressor {
  Compressor() : context(ZSTD_createCCtx()) {}
  ~Compressor() { ZSTD_freeCCtx(context); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  ZSTD_CCtx* context;
};

Writer::Writer(Sink& sink, WriterOptions options)
    : sink_(sink), options_(std::move(options)), compressor_(std::make_unique<Compressor>()) {
  RecordWriter out(out_);
  out.put(std::span<const std::uint8_t>(mcap_magic));
  out.begin(Opcode::header);
  out.put(std::string_view());  // no profile
  out.put(std::string_view(options_.library));
  out.end();
  emit();
}

Writer::~Writer() = default;

// Writes what is in out_ and counts it.
bool Writer::emit() {
  if (!failed_) {
    data_crc_ = storage::crc32(data_crc_, out_);
    failed_ = !sink_.write(out_);
    if (!failed_) offset_ += out_.size();
  }
  out_.clear();
  return !failed_;
}

std::uint16_t Writer::add_channel(const std::string& topic, const std::string& type,
                                  const std::string& schema, const StringMap& metadata) {
  auto found = std::find_if(schemas_.begin(), schemas_.end(), [&](const SchemaEntry& entry) {
    return entry.schema.name == type && entry.schema.data == schema;
  });
  if (found == schemas_.end()) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    found = schemas_.insert(found, SchemaEntry{{id, type, "omgidl", schema}});
  }
  ChannelEntry entry;
  entry.channel = {static_cast<std::uint16_t>(channels_.size()), found->schema.id, topic, "cdr", metadata};
  channels_.push_back(std::move(entry));
  return channels_.back().channel.id;
}

void Writer::put_schema(RecordWriter& out, const Schema& schema) {
  out.begin(Opcode::schema);
  out.put(schema.id);
  out.put(std::string_view(schema.name));
  out.put(std::string_view(schema.encoding));
  out.put(std::string_view(schema.data));
  out.end();
}

void Writer::put_channel(RecordWriter& out, const Channel& channel) {
  out.begin(Opcode::channel);
  out.put(channel.id);
  out.put(channel.schema);
  out.put(std::string_view(channel.topic));
  out.put(std::string_view(channel.encoding));
  out.put(channel.metadata);
  out.end();
}

bool Writer::metadata(const std::string& name, const StringMap& values) {
  RecordWriter out(out_);
  out.begin(Opcode::metadata);
  out.put(std::string_view(name));
  out.put(values);
  out.end();
  metadata_.push_back({offset_, out_.size(), name});
  return emit();
}

bool Writer::write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time,
                   std::span<const std::uint8_t> cdr) {
  if (failed_) return false;
  auto& entry = channels_.at(channel);
  RecordWriter out(chunk_);
  if (!entry.written) {
    auto& schema = schemas_.at(entry.channel.schema - 1u);
    if (!schema.written) put_schema(out, schema.schema);
    schema.written = true;
    put_channel(out, entry.channel);
    entry.written = true;
  }
  entry.index.entries.push_back(time);
  entry.index.entries.push_back(chunk_.size());
  out.begin(Opcode::message);
  out.put(channel);
  out.put(sequence);
  out.put(time);
  out.put(time);
  out.put(cdr);
  out.end();
  chunk_first_ = chunk_messages_ == 0 ? time : std::min(chunk_first_, time);
  chunk_last_ = chunk_messages_ == 0 ? time : std::max(chunk_last_, time);
  first_time_ = messages_ == 0 ? time : std::min(first_time_, time);
  last_time_ = messages_ == 0 ? time : std::max(last_time_, time);
  ++chunk_messages_;
  ++messages_;
  ++entry.count;
  return chunk_.size() < options_.chunk_bytes || flush();
}

// The chunk as it is to be stored: compressed, when that makes it smaller.
std::span<const std::uint8_t> Writer::stored_chunk() {
  if (options_.compression == Compression::none) return chunk_;
  compressed_.resize(ZSTD_compressBound(chunk_.size()));
  const auto size = ZSTD_compressCCtx(compressor_->context, compressed_.data(), compressed_.size(),
                                      chunk_.data(), chunk_.size(), options_.compression_level);
  if (ZSTD_isError(size) != 0 || size >= chunk_.size()) return chunk_;
  return std::span(compressed_).first(size);
}

bool Writer::flush() {
  if (failed_ || chunk_messages_ == 0) return !failed_;
  const auto payload = stored_chunk();

  ChunkEntry entry{chunk_first_, chunk_last_, offset_, 0, 0, payload.size(), chunk_.size(), {}};
  RecordWriter out(out_);
  out.begin(Opcode::chunk);
  out.put(chunk_first_);
  out.put(chunk_last_);
  out.put(static_cast<std::uint64_t>(chunk_.size()));
  out.put(storage::crc32(0, chunk_));
  out.put(std::string_view(payload.size() == chunk_.size() ? "" : "zstd"));
  out.put(static_cast<std::uint64_t>(payload.size()));
  out.put(payload);
  out.end();
  entry.length = out_.size();
  for (auto& channel : channels_) {
    auto& times = channel.index.entries;
    if (times.empty()) continue;
    entry.indexes.emplace_back(channel.channel.id, offset_ + out_.size());
    out.begin(Opcode::message_index);
    out.put(channel.channel.id);
    out.put(static_cast<std::uint32_t>(times.size() * sizeof(std::uint64_t)));
    out.put(
        std::span(reinterpret_cast<const std::uint8_t*>(times.data()), times.size() * sizeof(std::uint64_t)));
    out.end();
    times.clear();
  }
  entry.index_length = out_.size() - entry.length;
  chunks_.push_back(std::move(entry));
  chunk_.clear();
  chunk_messages_ = 0;
  return emit();
}

void Writer::put_summary() {
  RecordWriter out(out_);
  struct Group {
    Opcode opcode;
    std::uint64_t start, length;
  };
  std::vector<Group> groups;
  const auto group = [&](Opcode opcode, auto put_all) {
    const auto start = offset_ + out_.size();
    put_all();
    if (offset_ + out_.size() > start) groups.push_back({opcode, start, offset_ + out_.size() - start});
  };
  group(Opcode::schema, [&] {
    for (const auto& entry : schemas_)
      if (entry.written) put_schema(out, entry.schema);
  });
  group(Opcode::channel, [&] {
    for (const auto& entry : channels_)
      if (entry.written) put_channel(out, entry.channel);
  });
  group(Opcode::statistics, [&] {
    std::uint16_t schemas = 0;
    std::uint32_t channels = 0;
    for (const auto& entry : schemas_) schemas = static_cast<std::uint16_t>(schemas + entry.written);
    for (const auto& entry : channels_) channels += entry.written;
    out.begin(Opcode::statistics);
    out.put(messages_);
    out.put(schemas);
    out.put(channels);
    out.put(std::uint32_t{0});  // attachments
    out.put(static_cast<std::uint32_t>(metadata_.size()));
    out.put(static_cast<std::uint32_t>(chunks_.size()));
    out.put(first_time_);
    out.put(last_time_);
    out.put(channels * 10);  // bytes of the map
    for (const auto& entry : channels_) {
      if (!entry.written) continue;
      out.put(entry.channel.id);
      out.put(entry.count);
    }
    out.end();
  });
  group(Opcode::chunk_index, [&] {
    for (const auto& chunk : chunks_) {
      out.begin(Opcode::chunk_index);
      out.put(chunk.first_time);
      out.put(chunk.last_time);
      out.put(chunk.offset);
      out.put(chunk.length);
      out.put(static_cast<std::uint32_t>(chunk.indexes.size() * 10));
      for (const auto& [channel, offset] : chunk.indexes) {
        out.put(channel);
        out.put(offset);
      }
      out.put(chunk.index_length);
      out.put(std::string_view(chunk.compressed == chunk.uncompressed ? "" : "zstd"));
      out.put(chunk.compressed);
      out.put(chunk.uncompressed);
      out.end();
    }
  });
  group(Opcode::metadata_index, [&] {
    for (const auto& entry : metadata_) {
      out.begin(Opcode::metadata_index);
      out.put(entry.offset);
      out.put(entry.length);
      out.put(std::string_view(entry.name));
      out.end();
    }
  });
  const auto summary_offsets = offset_ + out_.size();
  for (const auto& [opcode, start, length] : groups) {
    out.begin(Opcode::summary_offset);
    out.put(static_cast<std::uint8_t>(opcode));
    out.put(start);
    out.put(length);
    out.end();
  }
  // The footer's checksum covers the summary and the footer up to the checksum itself.
  const auto summary = offset_;
  out.put(static_cast<std::uint8_t>(Opcode::footer));
  out.put(std::uint64_t{20});
  out.put(summary);
  out.put(summary_offsets);
  out.put(storage::crc32(0, out_));
  out.put(std::span<const std::uint8_t>(mcap_magic));
}

bool Writer::finish() {
  if (finished_) return !failed_;
  finished_ = true;
  if (!flush()) return false;
  RecordWriter out(out_);
  out.begin(Opcode::data_end);
  out.put(data_crc_);
  out.end();
  if (!emit()) return false;
  put_summary();
  return emit();
}

}  // namespace trunnion::recording
