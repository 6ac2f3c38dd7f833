// SPDX-License-Identifier: Apache-2.0
// The programs that were loaded while the PLC ran, in the state directory: whole after a kill at any instant.
#pragma once

#include <optional>
#include <string>

#include "programs.hpp"
#include "storage/kept_file.hpp"

namespace trunnion::plc {

struct StoredPrograms {
  std::string boot;             ///< the start of the cluster in which they took over
  std::uint32_t delivered = 0;  ///< CRC-32 of the sources of the machine's directory then
  std::uint32_t changes = 0;    ///< counts online changes
  SourceFiles active, previous;
};

class LoadedPrograms {
 public:
  /// `path` without directory: plc.programs
  explicit LoadedPrograms(std::string path) : path_(std::move(path)) {}

  /// Nothing when no programs were loaded or none can be read; `found` says so. Throws storage::StorageError.
  std::optional<StoredPrograms> load(storage::Kept& found) const;
  /// On the disk, but not in force. Not cyclic.
  void prepare(const StoredPrograms& programs) const;
  /// prepare()d ones are in force: two renames.
  void publish() const;
  /// After publish(), not cyclic: a power failure does not take it back either.
  void synchronize() const;
  void discard() const;

 private:
  std::string path_;
};

}  // namespace trunnion::plc
