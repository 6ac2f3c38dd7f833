// SPDX-License-Identifier: Apache-2.0
// The store of programs: chunks out, uploads in, names, revisions. Never a whole program in memory.
#pragma once

#include <set>
#include <utility>

#include "machine_state/index_file.hpp"
#include "program_index.hpp"

namespace trunnion::program {

using machine_state::accepted_prefix;
using machine_state::identity_of;
using machine_state::index_file;
using machine_state::IndexFile;
using machine_state::TextIdentity;

inline constexpr std::size_t longest_chunk = 60000;                 ///< bytes of one READ or WRITE
inline constexpr std::size_t most_programs = 4096;                  ///< in the store
inline constexpr std::uint64_t most_program_bytes = 8'000'000'000;  ///< 8 GB, of all programs together
inline constexpr std::size_t most_uploads = 64;                     ///< at the same time
inline constexpr double upload_patience = 60;  ///< s without a WRITE after which an upload is dropped

class ProgramStore {
 public:
  /// `programs` holds the programs, `state` the file programs.yaml with revisions and checksums. Scans every
  /// program. One that is not in the index is adopted; one that does not match its checksum is damaged,
  /// unless the operator has accepted it. Throws StorageError, std::runtime_error with file:line:column.
  /// Uploads are refused when programs and uploads would have more than `most_bytes`.
  ProgramStore(Files& programs, Files& state, std::uint64_t most_bytes = most_program_bytes);

  /// Programs that come with the machine: copied unless they are there or were once removed on purpose, and
  /// in the place of a damaged one whose checksum they have. Returns the names that cannot be stored.
  std::vector<std::string> install(Files& delivered);
  /// Programs that can be resolved and read but are not part of the store: canned cycles, searched last.
  void set_cycles(Files& cycles);

  /// `now` in s, of any monotonic clock.
  idl::program::ProgramReply apply(const idl::program::ProgramRequest& request, double now);
  void drop_stale_uploads(double now);

  idl::program::ProgramList list() const;
  /// True once after each change of the list.
  bool take_change() { return std::exchange(changed_, false); }
  std::size_t uploads() const { return uploads_.size(); }
  /// Programs that cannot be used, by name: what is wrong and what to do. They are listed and not read.
  const std::map<std::string, std::string>& damaged() const { return damaged_; }
  /// How the index was found.
  const storage::Kept& index_found() const { return index_found_; }
  /// `channel` executes the program `name`, or has it suspended; empty: none. Such a program is neither
  /// removed nor renamed.
  void set_executed(std::uint16_t channel, const std::string& name);

 private:
  struct Upload {
    std::string file;
    TextScan text;
    double touched = 0;
  };
  using UploadKey = std::pair<std::uint64_t, std::string>;
  using Request = idl::program::ProgramRequest;
  using Reply = idl::program::ProgramReply;

  std::string read(const Request& request, Reply& reply);
  std::string begin(const Request& request, double now);
  std::string write(const Request& request, Reply& reply, double now);
  std::string print(const Request& request, Reply& reply);
  std::string commit(const Request& request, Reply& reply);
  std::string abort(const Request& request);
  std::string remove(const Request& request);
  std::string rename(const Request& request, Reply& reply);
  /// Throws StorageError when there is no room for `bytes` more of an upload that becomes the program `name`.
  void check_room(const std::string& name, std::uint64_t bytes) const;
  /// The same when the file `name` of DPRNT would have `bytes`.
  void check_print_room(const std::string& name, bool exists, std::uint64_t bytes) const;
  std::string in_use(const std::string& name) const;
  std::string find(const Request& request, Reply& reply);
  void put(const std::string& name, const TextScan& text, std::uint8_t role);
  void adopt_files(const IndexFile& index);
  void save_index();
  void replace(const std::string& file, const std::string& name, const TextScan& text, std::uint8_t role);
  void drop(std::map<UploadKey, Upload>::iterator upload);

  Files& programs_;
  Files& state_;
  const std::uint64_t most_bytes_;
  Files* cycles_files_ = nullptr;
  Index index_, cycles_;
  std::map<std::string, std::uint64_t> revisions_;  ///< of every name ever used, removed ones included
  std::set<std::string> removed_;                   ///< removed on request, so not installed again
  std::map<std::string, TextIdentity> next_;        ///< texts that are being put in place
  std::set<std::string> removing_;
  std::map<std::uint16_t, std::string> executed_;  ///< program by channel
  std::map<std::string, std::string> damaged_;
  storage::Kept index_found_;
  std::uint64_t revision_ = 0;  ///< of the list
  std::map<UploadKey, Upload> uploads_;
  std::map<std::string, TextScan> printed_;  ///< of files of DPRNT: their texts so far
  std::uint64_t upload_count_ = 0;
  bool changed_ = true;
};

}  // namespace trunnion::program
