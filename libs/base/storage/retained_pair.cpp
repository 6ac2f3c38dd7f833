// SPDX-License-Identifier: Apache-2.0
#include "storage/retained_pair.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "storage/file.hpp"

namespace trunnion::storage {
namespace {

struct Header {
  char mark[16];           // "trunnion-state 1"
  char kind[16];           // zeros behind the name
  std::uint64_t size;      // of the content
  std::uint64_t writing;   // the sequence number that is being written
  std::uint64_t sequence;  // counts the saves of both files
  std::uint64_t checksum;  // of kind, size, sequence and content
};
constexpr char file_mark[] = "trunnion-state 1";
static_assert(sizeof file_mark == sizeof(Header::mark) + 1);

// FNV-1a over words of 64 bits, the last one filled up with zeros.
std::uint64_t hash(std::uint64_t state, std::span<const std::uint8_t> bytes) {
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    state = (state ^ word) * 1099511628211u;
  }
  return state;
}

template <class T>
std::span<const std::uint8_t> bytes_of(const T& value) {
  return {reinterpret_cast<const std::uint8_t*>(&value), sizeof value};
}

std::uint64_t checksum_of(const Header& header, std::span<const std::uint8_t> content) {
  auto state = hash(14695981039346656037u, bytes_of(header.kind));
  state = hash(state, bytes_of(header.size));
  return hash(hash(state, bytes_of(header.sequence)), content);
}

struct Half {
  bool there = false, whole = false;
  std::uint64_t sequence = 0;  // of one that is whole; of one whose write was interrupted, that of the write
  bool interrupted = false;
  std::string problem;
  std::vector<std::uint8_t> content;
};

Half inspect(const std::string& path, const std::string& kind, std::size_t size) {
  Half half;
  if (access(path.c_str(), F_OK) != 0) {
    half.problem = "is missing";
    return half;
  }
  half.there = true;
  const File file(path, O_RDONLY);
  std::vector<std::uint8_t> bytes(file.size());
  bytes.resize(file.read(0, bytes));
  Header header{};
  if (bytes.size() < sizeof header) {
    half.problem =
        "has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(sizeof header + size);
    return half;
  }
  std::memcpy(&header, bytes.data(), sizeof header);
  char name[sizeof header.kind] = {};
  std::memcpy(name, kind.data(), kind.size());
  if (std::memcmp(header.mark, file_mark, sizeof header.mark) != 0 ||
      std::memcmp(header.kind, name, sizeof name) != 0) {
    half.problem = "is no file of this kind";
    return half;
  }
  if (header.size != size || bytes.size() != sizeof header + size) {
    half.problem =
        "has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(sizeof header + size);
    return half;
  }
  half.content.assign(bytes.begin() + sizeof header, bytes.end());
  half.sequence = header.writing;
  half.whole = header.writing == header.sequence && header.checksum == checksum_of(header, half.content);
  half.interrupted = !half.whole && header.writing == header.sequence + 2;
  if (!half.whole) half.problem = "has a wrong checksum";
  return half;
}

}  // namespace

RetainedPair::RetainedPair(std::string path, std::string_view kind, std::size_t size)
    : path_(std::move(path)), kind_(kind), size_(size) {}

RetainedPair RetainedPair::of_files(const std::string& path, std::string_view kind) {
  std::size_t size = sizeof(Header);
  for (const auto& name : {path, path + previous_suffix})
    if (access(name.c_str(), F_OK) == 0) size = std::max(size, File(name, O_RDONLY).size());
  return {path, kind, size - sizeof(Header)};
}

Retained RetainedPair::load() const {
  const auto name = path_.substr(path_.rfind('/') + 1);
  const std::string names[2] = {name, name + previous_suffix};
  Half halves[2] = {inspect(path_, kind_, size_), inspect(path_ + previous_suffix, kind_, size_)};
  if (!halves[0].there && !halves[1].there) return {};
  Retained kept;
  for (int i = 0; i < 2; ++i)
    if (!halves[i].whole && !halves[i].interrupted)
      kept.problem += (kept.problem.empty() ? "" : ", ") + names[i] + " " + halves[i].problem;
  const auto& [a, b] = halves;
  if (!a.whole && !b.whole) {
    kept.state = KeptState::unusable;
    if (kept.problem.empty()) kept.problem = names[0] + " and " + names[1] + " have a wrong checksum";
    return kept;
  }
  const auto& used = a.whole && (!b.whole || a.sequence > b.sequence) ? a : b;
  const auto& other = &used == &a ? b : a;
  kept.content = used.content;
  // Saves alternate, so whole files are one save apart; one that was interrupted is one save ahead.
  const bool matches = other.interrupted ? other.sequence == used.sequence + 1
                                         : other.whole && other.sequence + 1 == used.sequence;
  kept.state = matches ? KeptState::good : KeptState::previous;
  if (!matches && kept.problem.empty()) kept.problem = names[&other == &a ? 0 : 1] + " is an old copy";
  return kept;
}

void RetainedPair::open(std::span<const std::uint8_t> content) {
  const std::string paths[2] = {path_, path_ + previous_suffix};
  Half halves[2] = {inspect(paths[0], kind_, size_), inspect(paths[1], kind_, size_)};
  std::uint64_t last = 0, newest = 0;  // of all, of those that are whole
  for (const auto& half : halves) {
    if (half.whole || half.interrupted) last = std::max(last, half.sequence);
    if (half.whole) newest = std::max(newest, half.sequence);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (!halves[i].whole && !halves[i].interrupted) {
      if (halves[i].there) rename_over(paths[i], paths[i] + damaged_suffix);
      // A new file is whole from its first moment.
      const auto fresh = paths[i] + ".new";
      {
        unlink(fresh.c_str());
        const MappedFile file(fresh, sizeof(Header) + size_);
        auto& header = *static_cast<Header*>(file.data());
        std::memcpy(header.mark, file_mark, sizeof header.mark);
        std::memcpy(header.kind, kind_.data(), kind_.size());
        header.size = size_;
        const auto sequence = last + (last % 2 == i ? 2 : 1);
        write(file.data(), sequence, content);
        newest = std::max(newest, sequence);
      }
      rename_over(fresh, paths[i]);
    }
    files_[i] = std::make_unique<MappedFile>(paths[i], sizeof(Header) + size_);
  }
  // The next write goes to the other file: never to the only one that is whole.
  sequence_ = newest;
  save(content);
  save(content);
}

void RetainedPair::save(std::span<const std::uint8_t> content) {
  ++sequence_;
  write(files_[sequence_ % 2]->data(), sequence_, content);
}

void RetainedPair::write(void* file, std::uint64_t sequence, std::span<const std::uint8_t> content) const {
  auto& header = *static_cast<Header*>(file);
  // The order matters for a process that is killed here: `writing` shows that the rest is not whole.
  header.writing = sequence;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::memcpy(static_cast<std::uint8_t*>(file) + sizeof header, content.data(), size_);
  Header summed = header;
  summed.sequence = sequence;
  header.checksum = checksum_of(summed, content);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  header.sequence = sequence;
}

}  // namespace trunnion::storage
