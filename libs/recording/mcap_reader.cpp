// SPDX-License-Identifier: Apache-2.0
#include "recording/mcap_reader.hpp"

#include <zstd.h>

#include <algorithm>

#include "storage/crc32.hpp"

namespace trunnion::recording {

struct Reader::Decompressor {
  Decompressor() : context(ZSTD_createDCtx()) {}
  ~Decompressor() { ZSTD_freeDCtx(context); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
  ZSTD_DCtx* context;
};

Reader::Reader(Source& source, std::uint64_t largest_record)
    : source_(source), largest_record_(largest_record), decompressor_(std::make_unique<Decompressor>()) {
  std::array<std::uint8_t, 8> magic{};
  const auto count = source_.read(0, magic);
  if (!std::equal(magic.begin(), magic.begin() + static_cast<std::ptrdiff_t>(count), mcap_magic.begin()))
    end(Ending::damaged, "not an MCAP file: the magic bytes are missing");
  else if (count < magic.size())
    end(Ending::cut_off, "the file ends before its first record");
  offset_ = magic.size();
}

Reader::~Reader() = default;

bool Reader::end(Ending ending, std::string problem) {
  ending_ = ending;
  problem_ = std::move(problem);
  return false;
}

// Brings the record at offset_ into record_.
bool Reader::read_record() {
  const std::string at = "at byte " + std::to_string(offset_);
  std::array<std::uint8_t, record_head> head{};
  if (source_.read(offset_, head) < head.size())
    return end(Ending::cut_off, "the file ends " + at + ", before its data end record");
  RecordReader reader(head);
  opcode_ = static_cast<Opcode>(reader.number<std::uint8_t>());
  const auto length = reader.number<std::uint64_t>();
  if (opcode_ == Opcode{0}) return end(Ending::damaged, at + ": a record without an opcode");
  const auto left = source_.size() - std::min(source_.size(), offset_ + record_head);
  if (length > left) return end(Ending::cut_off, "the file ends inside the record " + at);
  if (length > largest_record_)
    return end(Ending::damaged, at + ": a record of " + std::to_string(length) +
                                    " bytes is beyond the limit of " + std::to_string(largest_record_));
  record_.resize(static_cast<std::size_t>(length));
  if (source_.read(offset_ + record_head, record_) < record_.size())
    return end(Ending::cut_off, "the file ends inside the record " + at);
  offset_ += record_head + length;
  return true;
}

bool Reader::open_chunk(std::span<const std::uint8_t> content) {
  RecordReader in(content);
  in.number<std::uint64_t>();
  in.number<std::uint64_t>();
  const auto size = in.number<std::uint64_t>();
  const auto crc = in.number<std::uint32_t>();
  const auto compression = in.text();
  const auto records = in.take(in.number<std::uint64_t>());
  const std::string where = "the chunk that ends at byte " + std::to_string(offset_);
  if (!in.ok()) return end(Ending::damaged, where + " is shorter than its length field states");
  if (size > largest_record_) return end(Ending::damaged, where + " is beyond the limit");
  if (compression.empty()) {
    chunk_.assign(records.begin(), records.end());
  } else if (compression == "zstd") {
    // The frame's own word on its size keeps a forged one from making us allocate.
    if (ZSTD_getFrameContentSize(records.data(), records.size()) != size)
      return end(Ending::damaged, where + " contradicts its size");
    chunk_.resize(static_cast<std::size_t>(size));
    const auto count = ZSTD_decompressDCtx(decompressor_->context, chunk_.data(), chunk_.size(),
                                           records.data(), records.size());
    if (ZSTD_isError(count) || count != size) return end(Ending::damaged, where + " cannot be decompressed");
  } else {
    return end(Ending::damaged, where + " has the unknown compression '" + compression + "'");
  }
  if (chunk_.size() != size || (crc != 0 && storage::crc32(0, chunk_) != crc))
    return end(Ending::damaged, where + " fails its checksum");
  in_chunk_ = chunk_;
  return true;
}

bool Reader::parse(Opcode opcode, std::span<const std::uint8_t> content, MessageView& message,
                   bool& is_message) {
  RecordReader in(content);
  switch (opcode) {
    case Opcode::schema: {
      Schema schema;
      schema.id = in.number<std::uint16_t>();
      schema.name = in.text();
      schema.encoding = in.text();
      schema.data = in.text();
      if (in.ok()) schemas_.try_emplace(schema.id, std::move(schema));
      break;
    }
    case Opcode::channel: {
      Channel channel;
      channel.id = in.number<std::uint16_t>();
      channel.schema = in.number<std::uint16_t>();
      channel.topic = in.text();
      channel.encoding = in.text();
      channel.metadata = in.map();
      if (in.ok()) channels_.try_emplace(channel.id, std::move(channel));
      break;
    }
    case Opcode::metadata: {
      Metadata metadata;
      metadata.name = in.text();
      metadata.values = in.map();
      if (in.ok()) metadata_.push_back(std::move(metadata));
      break;
    }
    case Opcode::message: {
      const auto channel = channels_.find(in.number<std::uint16_t>());
      message.sequence = in.number<std::uint32_t>();
      message.log_time = in.number<std::uint64_t>();
      message.publish_time = in.number<std::uint64_t>();
      message.data = in.rest();
      if (in.ok() && channel == channels_.end())
        return end(Ending::damaged, "a message of an unknown channel before byte " + std::to_string(offset_));
      if (in.ok()) message.channel = &channel->second;
      is_message = true;
      break;
    }
    default:
      break;  // indexes, and records of later versions, are not needed
  }
  return in.ok() || end(Ending::damaged, "a record before byte " + std::to_string(offset_) +
                                             " is shorter than its length field states");
}

bool Reader::next(MessageView& message) {
  while (ending_ == Ending::none) {
    bool is_message = false;
    if (!in_chunk_.empty()) {
      RecordReader in(in_chunk_);
      const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
      const auto content = in.take(in.number<std::uint64_t>());
      if (!in.ok())
        return end(Ending::damaged, "a record exceeds its chunk before byte " + std::to_string(offset_));
      in_chunk_ = in.rest();
      if (!parse(opcode, content, message, is_message)) return false;
    } else {
      if (!read_record()) return false;
      if (opcode_ == Opcode::data_end || opcode_ == Opcode::footer) return end(Ending::complete, "");
      if (opcode_ == Opcode::chunk) {
        if (!open_chunk(record_)) return false;
      } else if (!parse(opcode_, record_, message, is_message)) {
        return false;
      }
    }
    if (is_message) return true;
  }
  return false;
}

}  // namespace trunnion::recording
