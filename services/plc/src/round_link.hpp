// How rounds get from the running PLC to the one that is to replace it: a ring in a file that both have
// mapped. The running one never waits, allocates only when a comparison starts, and does nothing while no one
// asks.
#pragma once

#include <optional>
#include <string>

#include "bus/cdr.hpp"
#include "storage/mapped_file.hpp"

namespace trunnion::plc {

struct RoundRing;

/// The side that is to take over: makes the file, and takes it away again.
class RoundReader {
 public:
  /// Throws storage::StorageError naming the file.
  explicit RoundReader(const std::string& path);
  ~RoundReader();
  RoundReader(const RoundReader&) = delete;
  RoundReader& operator=(const RoundReader&) = delete;

  /// Asks for rounds that begin anew; drops what has not been read.
  void ask();
  std::uint32_t generation() const;
  /// Tells the other side that somebody still listens. Call it at least every 0.5 s.
  void keep_alive();
  /// The next round's bytes; false when there is none yet.
  bool read(bus::Bytes& bytes);
  /// The writer has overtaken the reader: only ask() helps.
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

  /// Looks for somebody who asks, at most every 0.1 s, and gives one up that has not breathed for 1 s. `now`
  /// in seconds. Returns the generation wanted, 0 for none.
  std::uint32_t wanted(double now);
  /// False when it does not fit: whoever asked has to ask again.
  bool write(const bus::Bytes& bytes);

 private:
  void open();
  void close();

  std::string path_;
  std::optional<storage::MappedFile> file_;
  RoundRing* ring_ = nullptr;
  double polled_ = 0, alive_at_ = 0;
  std::uint32_t alive_count_ = 0;
};

}  // namespace trunnion::plc
