// SPDX-License-Identifier: Apache-2.0
// Passes rounds from the running PLC to the one that is to replace it: a ring in a file that both map. The
// running one never waits, allocates only when a comparison starts, and does nothing without a request.
#pragma once

#include <optional>
#include <string>

#include "bus/cdr.hpp"
#include "storage/mapped_file.hpp"

namespace trunnion::plc {

struct RoundRing;

/// The replacing side: creates the file, and removes it again.
class RoundReader {
 public:
  /// Throws storage::StorageError naming the file.
  explicit RoundReader(const std::string& path);
  ~RoundReader();
  RoundReader(const RoundReader&) = delete;
  RoundReader& operator=(const RoundReader&) = delete;

  /// Requests rounds from a new start; drops those that have not been read.
  void request_start();
  std::uint32_t generation() const;
  /// Shows the other side that this reader is active. Call it at least every 0.5 s.
  void send_heartbeat();
  /// The next round's bytes; false when there is none yet.
  bool read(bus::Bytes& bytes);
  /// The writer has overtaken the reader: call request_start().
  bool lost() const { return lost_; }

 private:
  std::string path_;
  std::optional<storage::MappedFile> file_;
  RoundRing* ring_ = nullptr;
  std::uint64_t at_ = 0;
  bool lost_ = false;
};

/// The running side.
class RoundWriter {
 public:
  explicit RoundWriter(std::string path) : path_(std::move(path)) {}

  /// Checks for a reader, at most every 0.1 s, and drops one without a heartbeat for 1 s. `now` in seconds.
  /// Returns the requested generation, 0 for none.
  std::uint32_t wanted(double now);
  /// False when it does not fit: the reader has to request a new start.
  bool write(const bus::Bytes& bytes);

 private:
  void open();
  void close();

  std::string path_;
  std::optional<storage::MappedFile> file_;
  RoundRing* ring_ = nullptr;
  double polled_at_ = 0, heartbeat_at_ = 0;
  std::uint32_t heartbeat_ = 0;
};

}  // namespace trunnion::plc
