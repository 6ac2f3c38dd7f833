// SPDX-License-Identifier: Apache-2.0
#include "round_link.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "storage/file.hpp"
#include "storage/record_ring.hpp"

namespace trunnion::plc {

struct RoundRing {
  static constexpr std::uint64_t own_layout = 0x504c4352494e4702;
  std::uint64_t layout;
  std::atomic<std::uint32_t> requested, heartbeat;
  storage::RecordRing<std::uint64_t{1} << 22> rounds;
};

namespace {

constexpr double poll_period = 0.1, heartbeat_timeout = 1;  // s

// Allocates every block: a write into the mapping must not meet a full disk.
void make_file(const std::string& path) {
  unlink(path.c_str());
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  const int reason = file < 0 ? errno : posix_fallocate(file, 0, sizeof(RoundRing));
  if (file >= 0) ::close(file);
  if (reason == 0) return;
  unlink(path.c_str());
  throw storage::StorageError(path + ": cannot be created: " + std::strerror(reason));
}

}  // namespace

// The file of a reader that ended without cleanup is used again: the other side may still map it.
RoundReader::RoundReader(const std::string& path) : path_(path) {
  std::error_code missing;
  if (std::filesystem::file_size(path, missing) != sizeof(RoundRing) || missing) make_file(path);
  file_.emplace(path, sizeof(RoundRing));
  ring_ = static_cast<RoundRing*>(file_->data());
  request_start();
  std::atomic_thread_fence(std::memory_order_seq_cst);
  ring_->layout = RoundRing::own_layout;  // from here on the writer accepts it
}

RoundReader::~RoundReader() { unlink(path_.c_str()); }

void RoundReader::request_start() {
  at_ = ring_->rounds.end();
  lost_ = false;
  ++ring_->requested;
}

std::uint32_t RoundReader::generation() const { return ring_->requested; }

void RoundReader::send_heartbeat() { ++ring_->heartbeat; }

bool RoundReader::read(bus::Bytes& bytes) {
  using Ring = decltype(RoundRing::rounds);
  Ring::Header header;
  if (lost_) return false;
  const auto outcome = ring_->rounds.read(at_, header, bytes);
  lost_ = outcome == Ring::Read::overwritten;
  return outcome == Ring::Read::record;
}

void RoundWriter::open() {
  if (access(path_.c_str(), R_OK | W_OK) != 0) return;
  try {
    file_.emplace(path_, sizeof(RoundRing));
  } catch (const storage::StorageError&) {
    return;  // removed in the meantime
  }
  ring_ = static_cast<RoundRing*>(file_->data());
  if (ring_->layout != RoundRing::own_layout) file_.reset(), ring_ = nullptr;
}

// The reader has ended or has removed its file; a new file may be in that place.
void RoundWriter::close() {
  ring_->requested = 0;
  file_.reset();
  ring_ = nullptr;
  open();
  if (ring_ == nullptr) return;
  const bool left_behind = ring_->requested == 0;
  file_.reset();
  ring_ = nullptr;
  if (left_behind) unlink(path_.c_str());
}

std::uint32_t RoundWriter::wanted(double now) {
  if (ring_ == nullptr) {
    if (now - polled_at_ < poll_period) return 0;
    polled_at_ = now;
    open();
    if (ring_ == nullptr) return 0;
    heartbeat_ = ring_->heartbeat;
    heartbeat_at_ = now;
  }
  if (const std::uint32_t heartbeat = ring_->heartbeat; heartbeat != heartbeat_) {
    heartbeat_ = heartbeat;
    heartbeat_at_ = now;
  } else if (now - heartbeat_at_ > heartbeat_timeout) {
    close();
    return 0;
  }
  return ring_->requested;
}

bool RoundWriter::write(const bus::Bytes& bytes) { return ring_ != nullptr && ring_->rounds.write(0, bytes); }

}  // namespace trunnion::plc
