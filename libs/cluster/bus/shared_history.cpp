// SPDX-License-Identifier: Apache-2.0
#include "bus/shared_history.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <sstream>

#include "storage/record_ring.hpp"

namespace trunnion::bus {
namespace {

constexpr const char* name = "trunnion-history/1";
using Ring = storage::RecordRing<SharedHistory::capacity>;

// One host: one start of one computer, one space of process numbers in it, and one network, so that hosts
// that are network namespaces are as far apart as real ones.
const std::string& host() {
  static const std::string id = [] {
    std::string boot;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
    struct stat processes {
    }, network{};
    stat("/proc/self/ns/pid", &processes);
    stat("/proc/self/ns/net", &network);
    return boot + ":" + std::to_string(processes.st_ino) + ":" + std::to_string(network.st_ino);
  }();
  return id;
}

struct Address {
  std::string what, host;
  pid_t process = 0;
  int file = -1;
  std::uint64_t made = 0;
};

}  // namespace

struct SharedMemory {
  std::uint64_t made;  // tells apart two that had the same numbers
  Ring ring;
};

std::unique_ptr<SharedHistory> SharedHistory::make() {
  std::unique_ptr<SharedHistory> history(new SharedHistory);
  history->file_ = memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  // With every page there, and never to become shorter: nobody meets a missing one.
  if (history->file_ < 0 || posix_fallocate(history->file_, 0, sizeof(SharedMemory)) != 0 ||
      fcntl(history->file_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return nullptr;
  void* memory = mmap(nullptr, sizeof(SharedMemory), PROT_READ | PROT_WRITE, MAP_SHARED, history->file_, 0);
  if (memory == MAP_FAILED) return nullptr;
  history->memory_ = static_cast<SharedMemory*>(memory);
  history->memory_->made =
      static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  std::ostringstream address;
  address << name << ' ' << host() << ' ' << getpid() << ' ' << history->file_ << ' '
          << history->memory_->made;
  history->address_ = address.str();
  return history;
}

SharedHistory::~SharedHistory() {
  if (memory_ != nullptr) munmap(memory_, sizeof(SharedMemory));
  if (file_ >= 0) close(file_);
}

void SharedHistory::write(std::int64_t source_time, std::span<const std::uint8_t> cdr) {
  memory_->ring.write(source_time, cdr);
}

SharedHistoryReader::Found SharedHistoryReader::find(const std::string& address) {
  Address found;
  std::istringstream in(address);
  in >> found.what >> found.host >> found.process >> found.file >> found.made;
  if (!in || found.what != name || found.host != host()) return {};
  const std::string path = "/proc/" + std::to_string(found.process) + "/fd/" + std::to_string(found.file);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {errno == ENOENT || errno == ESRCH ? Place::gone : Place::elsewhere, nullptr};
  struct stat status {};
  const int seals = fcntl(file, F_GET_SEALS);
  void* memory = MAP_FAILED;
  if (seals > 0 && (seals & F_SEAL_SHRINK) != 0 && fstat(file, &status) == 0 &&
      status.st_size == static_cast<off_t>(sizeof(SharedMemory)))
    memory = mmap(nullptr, sizeof(SharedMemory), PROT_READ, MAP_SHARED, file, 0);
  close(file);
  // Another file in that place: the process has ended, or has made a new one since.
  if (memory == MAP_FAILED) return {Place::gone, nullptr};
  std::unique_ptr<SharedHistoryReader> reader(
      new SharedHistoryReader(static_cast<const SharedMemory*>(memory)));
  if (reader->memory_->made != found.made) return {Place::gone, nullptr};
  return {Place::here, std::move(reader)};
}

SharedHistoryReader::SharedHistoryReader(const SharedMemory* memory)
    : memory_(memory), at_(memory->ring.oldest()), counting_(at_ == 0) {}

SharedHistoryReader::~SharedHistoryReader() {
  munmap(const_cast<SharedMemory*>(memory_), sizeof(SharedMemory));
}

bool SharedHistoryReader::take(Bytes& cdr, SampleInfo& info) {
  for (;;) {
    Ring::Header header;
    const auto outcome = memory_->ring.read(at_, header, cdr);
    if (outcome == Ring::Read::nothing) return false;
    if (outcome == Ring::Read::overwritten) {
      // Memory that is no ring at all could keep us here for ever.
      const auto oldest = memory_->ring.oldest();
      if (oldest <= at_) return false;
      at_ = oldest;
      continue;
    }
    if (counting_) lost_ += header.number - next_;
    counting_ = true;
    next_ = header.number + 1;
    info.source_timestamp = header.stamp;
    return true;
  }
}

}  // namespace trunnion::bus
