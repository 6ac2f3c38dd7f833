// SPDX-License-Identifier: Apache-2.0
#include "recording/mcap_index.hpp"

#include <algorithm>

#include "storage/crc32.hpp"

namespace trunnion::recording {
namespace {

constexpr std::uint64_t footer_content = 20;  // where the summary and its offsets begin, and a checksum
constexpr std::uint64_t footer_length = record_head + footer_content;

ChunkPlace chunk_place(RecordReader& in) {
  ChunkPlace chunk;
  chunk.first_time = in.number<std::uint64_t>();
  chunk.last_time = in.number<std::uint64_t>();
  chunk.offset = in.number<std::uint64_t>();
  chunk.length = in.number<std::uint64_t>();
  in.take(in.number<std::uint32_t>());  // where the message indexes of each channel are
  chunk.index_length = in.number<std::uint64_t>();
  return chunk;
}

bool read_summary(std::span<const std::uint8_t> bytes, McapIndex& out) {
  RecordReader records(bytes);
  while (records.left() > 0) {
    const auto opcode = static_cast<Opcode>(records.number<std::uint8_t>());
    RecordReader in(records.take(records.number<std::uint64_t>()));
    if (!records.ok()) return false;
    if (opcode == Opcode::schema) {
      auto schema = read_schema(in);
      out.schemas.try_emplace(schema.id, std::move(schema));
    } else if (opcode == Opcode::channel) {
      auto channel = read_channel(in);
      out.channels.try_emplace(channel.id, std::move(channel));
    } else if (opcode == Opcode::chunk_index) {
      out.chunks.push_back(chunk_place(in));
    }
    if (!in.ok()) return false;
  }
  return true;
}

// Every chunk is within the data, behind the one before, and not larger than a reader takes.
bool are_in_order(const McapIndex& index, std::uint64_t largest_record) {
  std::uint64_t end = mcap_magic.size();
  for (const auto& chunk : index.chunks) {
    if (chunk.offset < end || chunk.offset > index.summary) return false;
    const auto room = index.summary - chunk.offset;
    if (chunk.length < record_head || chunk.length - record_head > largest_record || chunk.length > room)
      return false;
    if (chunk.index_length > largest_record || chunk.index_length > room - chunk.length) return false;
    end = chunk.end();
  }
  return true;
}

}  // namespace

McapIndex read_index(Source& source, std::uint64_t largest_record) {
  using State = McapIndex::State;
  McapIndex index;
  std::array<std::uint8_t, footer_length + mcap_magic.size()> tail{};
  const auto least = mcap_magic.size() + tail.size();
  if (source.size() < least || source.read(source.size() - tail.size(), tail) < tail.size()) return index;
  if (!std::equal(mcap_magic.begin(), mcap_magic.end(), tail.begin() + footer_length)) return index;

  const auto footer = source.size() - tail.size();
  index.state = State::damaged;
  index.summary = footer;
  RecordReader in(tail);
  if (static_cast<Opcode>(in.number<std::uint8_t>()) != Opcode::footer) return index;
  if (in.number<std::uint64_t>() != footer_content) return index;
  const auto summary = in.number<std::uint64_t>();
  in.number<std::uint64_t>();
  const auto crc = in.number<std::uint32_t>();
  const bool has_summary = summary != 0;
  if (has_summary && (summary < mcap_magic.size() || summary > footer)) return index;

  const auto length = has_summary ? footer - summary : 0;
  if (length > largest_record) {
    index.state = State::none;
    return index;
  }
  Bytes bytes(static_cast<std::size_t>(length));
  if (source.read(summary, bytes) < bytes.size()) return index;
  // The checksum covers the footer too, up to itself.
  const auto of_footer = std::span(tail).first(footer_length - sizeof crc);
  if (crc != 0 && storage::crc32(storage::crc32(0, bytes), of_footer) != crc) return index;
  if (!has_summary) {
    index.state = State::none;
    return index;
  }
  McapIndex read;
  read.summary = summary;
  if (!read_summary(bytes, read)) return index;
  std::ranges::sort(read.chunks, {}, &ChunkPlace::offset);
  if (!are_in_order(read, largest_record)) return index;
  read.state = State::known;
  return read;
}

}  // namespace trunnion::recording
