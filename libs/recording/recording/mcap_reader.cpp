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
    : source_(source),
      largest_record_(largest_record),
      decompressor_(std::make_unique<Decompressor>()),
      index_(read_index(source, largest_record)) {
  std::array<std::uint8_t, mcap_magic.size()> magic{};
  const auto count = source_.read(0, magic);
  begin_ = offset_ = magic.size();
  const bool begins =
      std::equal(magic.begin(), magic.begin() + static_cast<std::ptrdiff_t>(count), mcap_magic.begin());
  if (!begins && !has_index()) {
    end(Ending::damaged, "not an MCAP file: the magic bytes are missing");
    return;
  }
  if (count < magic.size()) {
    end(Ending::cut_off, "the file ends before its first record");
    return;
  }
  if (!begins) damages_.push_back({0, magic.size(), 0, 0, "the magic bytes are wrong"});
  if (index_.state == McapIndex::State::damaged)
    damages_.push_back({index_.summary, source_.size(), 0, 0, "the summary fails its checksum"});
  crc_ = storage::crc32(0, magic);
}

Reader::~Reader() = default;

bool Reader::end(Ending ending, std::string problem) {
  ending_ = damages_.empty() ? ending : Ending::damaged;
  problem_ = damages_.empty() ? std::move(problem) : text_of(damages_);
  return false;
}

// Up to where the records between two chunks can reach.
std::uint64_t Reader::limit() const {
  if (!has_index()) return source_.size();
  return next_chunk_ < index_.chunks.size() ? index_.chunks[next_chunk_].offset : index_.summary;
}

// Where the next record begins is not known, but for the index.
bool Reader::skip(Ending without_index, std::string problem) {
  if (!has_index()) {
    if (without_index == Ending::damaged) damages_.push_back({offset_, source_.size(), 0, 0, problem});
    return end(without_index, std::move(problem));
  }
  damages_.push_back({offset_, limit(), 0, 0, "no record can be read"});
  offset_ = limit();
  return false;
}

// Brings bytes into record_, in the order of the file.
bool Reader::load(std::uint64_t offset, std::uint64_t length) {
  record_.resize(static_cast<std::size_t>(length));
  if (source_.read(offset, record_) < record_.size()) return false;
  crc_ = storage::crc32(crc_, record_);
  return true;
}

// Brings the content of the record at offset_ into record_.
bool Reader::load_record() {
  const std::string at = "at byte " + std::to_string(offset_);
  const auto room = limit() - offset_;
  std::array<std::uint8_t, record_head> head{};
  if (room < head.size() || source_.read(offset_, head) < head.size())
    return skip(Ending::cut_off, "the file ends " + at + ", before its data end record");
  RecordReader reader(head);
  opcode_ = static_cast<Opcode>(reader.number<std::uint8_t>());
  const auto length = reader.number<std::uint64_t>();
  if (opcode_ == Opcode{0}) return skip(Ending::damaged, "a record without an opcode");
  if (length > room - record_head) return skip(Ending::cut_off, "the file ends inside the record " + at);
  if (length > largest_record_)
    return skip(Ending::damaged, "a record of " + std::to_string(length) + " bytes is beyond the limit of " +
                                     std::to_string(largest_record_));
  const auto crc = crc_;
  crc_ = storage::crc32(crc_, head);
  if (!load(offset_ + record_head, length))
    return skip(Ending::cut_off, "the file ends inside the record " + at);
  if (opcode_ == Opcode::data_end) crc_ = crc;
  begin_ = offset_;
  offset_ += record_head + length;
  return true;
}

// Opens the next chunk of the index, whatever the file says of its length.
void Reader::load_chunk() {
  const auto& place = index_.chunks[next_chunk_++];
  chunk_place_ = {place.offset, place.offset + place.length, place.first_time, place.last_time, {}};
  if (load(place.offset, place.length)) {
    RecordReader in(record_);
    const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
    const bool agrees = in.number<std::uint64_t>() == place.length - record_head;
    chunk_place_.what =
        opcode == Opcode::chunk && agrees ? open_chunk(in.rest()) : "the summary names a chunk here";
  } else {
    chunk_place_.what = "the chunk cannot be read";
  }
  if (!chunk_place_.what.empty()) damages_.push_back(chunk_place_);
  // The message indexes are not needed, but the checksum of the data covers them.
  load(place.offset + place.length, place.index_length);
  begin_ = place.offset;
  offset_ = place.end();
}

// What is wrong with it, else empty.
std::string Reader::open_chunk(std::span<const std::uint8_t> content) {
  RecordReader in(content);
  in.number<std::uint64_t>();
  in.number<std::uint64_t>();
  const auto size = in.number<std::uint64_t>();
  const auto crc = in.number<std::uint32_t>();
  const auto compression = in.text();
  const auto records = in.take(in.number<std::uint64_t>());
  if (!in.ok()) return "the chunk is shorter than its length field states";
  if (size > largest_record_) return "the chunk is beyond the limit";
  if (compression.empty()) {
    chunk_.assign(records.begin(), records.end());
  } else if (compression == "zstd") {
    // The frame's own word on its size keeps a forged one from making us allocate.
    if (ZSTD_getFrameContentSize(records.data(), records.size()) != size)
      return "the chunk contradicts its size";
    chunk_.resize(static_cast<std::size_t>(size));
    const auto count = ZSTD_decompressDCtx(decompressor_->context, chunk_.data(), chunk_.size(),
                                           records.data(), records.size());
    if (ZSTD_isError(count) || count != size) return "the chunk cannot be decompressed";
  } else {
    return "the chunk has an unknown compression";
  }
  if (chunk_.size() != size || (crc != 0 && storage::crc32(0, chunk_) != crc))
    return "the chunk fails its checksum";
  ++compressions_[compression.empty() ? "none" : compression];
  in_chunk_ = chunk_;
  return {};
}

// What is wrong with it, else nothing.
const char* Reader::parse(Opcode opcode, std::span<const std::uint8_t> content, MessageView& message) {
  RecordReader in(content);
  if (opcode == Opcode::schema) {
    auto schema = read_schema(in);
    if (in.ok()) index_.schemas.try_emplace(schema.id, std::move(schema));
  } else if (opcode == Opcode::channel) {
    auto channel = read_channel(in);
    if (in.ok()) index_.channels.try_emplace(channel.id, std::move(channel));
  } else if (opcode == Opcode::metadata) {
    Metadata metadata;
    metadata.name = in.text();
    metadata.values = in.map();
    if (in.ok()) metadata_.push_back(std::move(metadata));
  } else if (opcode == Opcode::message) {
    const auto channel = index_.channels.find(in.number<std::uint16_t>());
    message.sequence = in.number<std::uint32_t>();
    message.log_time = in.number<std::uint64_t>();
    message.publish_time = in.number<std::uint64_t>();
    message.data = in.rest();
    if (in.ok() && channel == index_.channels.end()) return "a message of an unknown channel";
    if (in.ok()) message.channel = &channel->second;
  }
  // Indexes, and records of later versions, are not needed.
  return in.ok() ? nullptr : "a record is shorter than its length field states";
}

void Reader::end_data() {
  if (has_index() && (opcode_ != Opcode::data_end || offset_ != index_.summary)) {
    damages_.push_back({begin_, offset_, 0, 0, "the data end before the summary"});
    return;
  }
  RecordReader in(record_);
  const auto crc = opcode_ == Opcode::data_end ? in.number<std::uint32_t>() : 0;
  if (crc != 0 && crc != crc_ && damages_.empty())
    damages_.push_back({0, begin_, 0, 0, "the records outside of the chunks fail their checksum"});
  if (index_.state == McapIndex::State::missing)
    end(Ending::cut_off,
        "the file ends at byte " + std::to_string(source_.size()) + ", without the end of its summary");
  else
    end(Ending::complete, "");
}

bool Reader::next_of_file(MessageView& message) {
  if (has_index() && offset_ == limit()) {
    if (next_chunk_ < index_.chunks.size()) {
      load_chunk();
    } else {
      damages_.push_back({begin_, offset_, 0, 0, "the data end record is missing"});
      end(Ending::damaged, "");
    }
    return false;
  }
  if (!load_record()) return false;
  if (opcode_ == Opcode::data_end || opcode_ == Opcode::footer) {
    end_data();
    return false;
  }
  std::string wrong;
  bool is_message = false;
  if (opcode_ == Opcode::chunk) {
    RecordReader in(record_);
    const auto first = in.number<std::uint64_t>(), last = in.number<std::uint64_t>();
    chunk_place_ = {begin_, offset_, first, last, {}};
    wrong = has_index() ? "a chunk that the summary does not name" : open_chunk(record_);
  } else if (opcode_ == Opcode::message && !index_.chunks.empty()) {
    wrong = "a message outside of the chunks";
  } else if (const auto* problem = parse(opcode_, record_, message); problem != nullptr) {
    wrong = problem;
  } else {
    is_message = opcode_ == Opcode::message;
  }
  if (wrong.empty()) return is_message;
  const bool has_times = opcode_ == Opcode::chunk && !has_index();
  note({begin_, offset_, has_times ? chunk_place_.first_time : 0, has_times ? chunk_place_.last_time : 0,
        wrong});
  return false;
}

// Behind each other they are one, so that a file of wrong records takes no memory.
void Reader::note(Damage damage) {
  constexpr std::size_t most = 10000;
  const bool follows = !damages_.empty() && damages_.back().end == damage.begin &&
                       damages_.back().what == damage.what && damage.first_time == 0;
  if (follows || damages_.size() >= most)
    damages_.back().end = damage.end;
  else
    damages_.push_back(std::move(damage));
}

bool Reader::next_of_chunk(MessageView& message) {
  RecordReader in(in_chunk_);
  const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
  const auto content = in.take(in.number<std::uint64_t>());
  const auto* wrong = in.ok() ? parse(opcode, content, message) : "a record exceeds its chunk";
  in_chunk_ = in.rest();
  if (wrong == nullptr) return opcode == Opcode::message;
  if (damages_.empty() || damages_.back().begin != chunk_place_.begin) {
    damages_.push_back(chunk_place_);
    damages_.back().what = wrong;
  }
  return false;
}

bool Reader::next(MessageView& message) {
  while (ending_ == Ending::none)
    if (in_chunk_.empty() ? next_of_file(message) : next_of_chunk(message)) return true;
  return false;
}

}  // namespace trunnion::recording
