// SPDX-License-Identifier: Apache-2.0
// What is known of each program without reading it: size, checksum, lines, program number, revision.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "contracts/types.hpp"
#include "files.hpp"
#include "head_scan.hpp"
#include "machine/program_number.hpp"

namespace trunnion::program {

/// Runs over a text a piece at a time.
class TextScan {
 public:
  void add(std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }
  std::uint32_t crc32() const { return crc_; }
  /// Lines, which end with CR LF, LF or CR; a last one without an end included.
  std::uint32_t lines() const { return ends_ + (last_ != '\n' && last_ != '\r' ? 1 : 0); }
  /// Of the head.
  std::optional<machine::ProgramNumber> number() const { return head_.number(); }

 private:
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0, ends_ = 0;
  std::uint8_t last_ = '\n';
  HeadScan head_;
};

struct IndexedProgram {
  idl::program::ProgramEntry entry;
  std::optional<machine::ProgramNumber> number;
};

/// Letters, digits, dot, underscore and minus, 1 to 64, not beginning with a dot: no path leads out of the
/// store.
bool valid_name(const std::string& name);

/// Reads the whole file in pieces of 64 KiB. Throws StorageError.
TextScan scan(Files& files, const std::string& name);

using Index = std::map<std::string, IndexedProgram>;

/// The program meant by `call`, or null. In this order: the name itself; the name with .nc, .NC, .ngc, .txt
/// behind it; when it is a program number, the first program in the order of names whose name is that number
/// with the same index of the NUM dialect (O1234, %1234, 1234, with an extension or leading zeros; O1234.9 is
/// another); then the first whose text begins with that number.
const IndexedProgram* resolve(const Index& index, const std::string& call);

}  // namespace trunnion::program
