#include "round_link.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "storage/file.hpp"

namespace trunnion::plc {

/// `begun` and `written` count bytes since the ring was made: a record may be read when it is below `written`
/// and has still been there after reading, which `begun` tells.
struct RoundRing {
  static constexpr std::uint64_t capacity = std::uint64_t{1} << 22;
  static constexpr std::uint64_t own_layout = 0x504c4352494e4701;
  std::uint64_t layout;
  std::atomic<std::uint32_t> asked, breath;
  std::atomic<std::uint64_t> begun, written;
  std::uint8_t bytes[capacity];

  void put(std::uint64_t at, const void* data, std::size_t size) {
    const auto from = at % capacity, first = std::min<std::uint64_t>(size, capacity - from);
    std::memcpy(bytes + from, data, first);
    std::memcpy(bytes, static_cast<const std::uint8_t*>(data) + first, size - first);
  }
  void get(std::uint64_t at, void* data, std::size_t size) const {
    const auto from = at % capacity, first = std::min<std::uint64_t>(size, capacity - from);
    std::memcpy(data, bytes + from, first);
    std::memcpy(static_cast<std::uint8_t*>(data) + first, bytes, size - first);
  }
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

namespace {

constexpr double look_period = 0.1, breath_patience = 1;  // s
using Length = std::uint32_t;

// With every block on the disk: whoever writes into the mapping must not meet a full one.
void make_file(const std::string& path) {
  unlink(path.c_str());
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  const int reason = file < 0 ? errno : posix_fallocate(file, 0, sizeof(RoundRing));
  if (file >= 0) ::close(file);
  if (reason == 0) return;
  unlink(path.c_str());
  throw storage::StorageError(path + ": cannot be made: " + std::strerror(reason));
}

}  // namespace

// The file of one that died is used again: the other side has it mapped already.
RoundReader::RoundReader(const std::string& path) : path_(path) {
  std::error_code missing;
  if (std::filesystem::file_size(path, missing) != sizeof(RoundRing) || missing) make_file(path);
  file_.emplace(path, sizeof(RoundRing));
  ring_ = static_cast<RoundRing*>(file_->data());
  ask();
  std::atomic_thread_fence(std::memory_order_seq_cst);
  ring_->layout = RoundRing::own_layout;  // from now on it is looked at
}

RoundReader::~RoundReader() { unlink(path_.c_str()); }

void RoundReader::ask() {
  at_ = ring_->written;
  lost_ = false;
  ++ring_->asked;
}

std::uint32_t RoundReader::generation() const { return ring_->asked; }

void RoundReader::breathe() { ++ring_->breath; }

bool RoundReader::read(bus::Bytes& bytes) {
  const std::uint64_t written = ring_->written;
  if (lost_ || written == at_) return false;
  Length length = 0;
  lost_ = ring_->begun - at_ > RoundRing::capacity;
  if (lost_) return false;
  ring_->get(at_, &length, sizeof length);
  // The length is trusted only when it had not been overwritten before it was read.
  lost_ = ring_->begun - at_ > RoundRing::capacity || length > written - at_ - sizeof length;
  if (lost_) return false;
  bytes.resize(length);
  ring_->get(at_ + sizeof length, bytes.data(), length);
  std::atomic_thread_fence(std::memory_order_seq_cst);
  lost_ = ring_->begun - at_ > RoundRing::capacity;
  at_ += sizeof length + length;
  return !lost_;
}

void RoundWriter::open() {
  if (access(path_.c_str(), R_OK | W_OK) != 0) return;
  try {
    file_.emplace(path_, sizeof(RoundRing));
  } catch (const storage::StorageError&) {
    return;  // it was taken away in this moment
  }
  ring_ = static_cast<RoundRing*>(file_->data());
  if (ring_->layout != RoundRing::own_layout) file_.reset(), ring_ = nullptr;
}

// Whoever asked has died, or has taken its file away: then another one may be in that place.
void RoundWriter::close() {
  ring_->asked = 0;
  file_.reset();
  ring_ = nullptr;
  open();
  if (ring_ == nullptr) return;
  const bool left_behind = ring_->asked == 0;
  file_.reset();
  ring_ = nullptr;
  if (left_behind) unlink(path_.c_str());
}

std::uint32_t RoundWriter::wanted(double now) {
  if (ring_ == nullptr) {
    if (now - looked_ < look_period) return 0;
    looked_ = now;
    open();
    if (ring_ == nullptr) return 0;
    breath_ = ring_->breath;
    breathed_at_ = now;
  }
  if (const std::uint32_t breath = ring_->breath; breath != breath_) {
    breath_ = breath;
    breathed_at_ = now;
  } else if (now - breathed_at_ > breath_patience) {
    close();
    return 0;
  }
  return ring_->asked;
}

bool RoundWriter::write(const bus::Bytes& bytes) {
  const auto length = static_cast<Length>(bytes.size());
  if (ring_ == nullptr || sizeof length + bytes.size() > RoundRing::capacity) return false;
  const std::uint64_t at = ring_->written;
  ring_->begun = at + sizeof length + length;
  std::atomic_thread_fence(std::memory_order_seq_cst);
  ring_->put(at, &length, sizeof length);
  ring_->put(at + sizeof length, bytes.data(), length);
  ring_->written = at + sizeof length + length;
  return true;
}

}  // namespace trunnion::plc
