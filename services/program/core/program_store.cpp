// SPDX-License-Identifier: Apache-2.0
#include "program_store.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "machine/alarm_constants.hpp"
#include "machine/print_file.hpp"
#include "machine/roles.hpp"
#include "text/utf8.hpp"

namespace trunnion::program {
namespace {

using idl::program::Operation;

constexpr const char* copy_temporary = ".copy";
constexpr const char* upload_prefix = ".upload-";

std::string damaged_text(const std::string& name, const idl::program::ProgramEntry& entry,
                         const TextScan& text) {
  char sums[32];
  std::snprintf(sums, sizeof sums, "%08x, not %08x", text.crc32(), entry.crc32);
  return "Program '" + name + "' was changed outside the control or is damaged (" +
         std::to_string(text.size()) + " bytes with checksum " + sums +
         "): upload it again, or 'trunnion state accept programs/" + name + "'";
}

std::string unknown(const std::string& name) { return "program '" + name + "' is not in the store"; }

}  // namespace

ProgramStore::ProgramStore(Files& programs, Files& state, std::uint64_t most_bytes)
    : programs_(programs), state_(state), most_bytes_(most_bytes) {
  index_found_ = state_.read_kept(index_file);
  const bool found =
      index_found_.state == storage::KeptState::good || index_found_.state == storage::KeptState::previous;
  const auto index = found ? machine_state::read_index(index_found_.content) : IndexFile{};
  revision_ = index.revision;
  for (const auto& [name, row] : index.rows) {
    revisions_[name] = row.revision;
    if (row.removed) removed_.insert(name);
  }
  adopt_files(index);
  if (revision_ != index.revision || revision_ == 0 || index_found_.state == storage::KeptState::previous) {
    revision_ = std::max<std::uint64_t>(revision_, 1);
    save_index();
  }
}

void ProgramStore::adopt_files(const IndexFile& index) {
  std::set<std::string> accepted;
  std::set<std::pair<std::uint64_t, std::uint32_t>> adopted;  // that the index does not know
  for (const auto& name : programs_.list()) {
    if (name.starts_with(accepted_prefix)) {
      accepted.insert(name.substr(std::string(accepted_prefix).size()));
      continue;
    }
    if (name.starts_with(upload_prefix) || name == copy_temporary) {
      programs_.remove(name);  // left behind by a process that was killed
      continue;
    }
    if (!valid_name(name) || index_.size() >= most_programs) continue;
    const auto text = scan(programs_, name);
    const TextIdentity identity{text.size(), text.crc32()};
    const auto known = index.rows.find(name);
    const auto* row = known == index.rows.end() ? nullptr : &known->second;
    if (row != nullptr && row->removing) {
      programs_.remove(name);  // the process ended before it could
      removed_.insert(name);
      ++revision_;
    } else if (row == nullptr || !row->stored || row->next == identity || accepted.contains(name) ||
               (machine::is_print_file(name) && identity_of(*row->stored) != identity)) {
      // Who has stored it is not known; what programs print is nobody's.
      put(name, text, machine::is_print_file(name) ? machine::role::machine_operator : machine::role::setter);
      adopted.insert({identity.size, identity.crc32});
    } else {
      index_[name] = {*row->stored, machine::is_print_file(name) ? std::nullopt : text.number()};
      if (identity_of(*row->stored) != identity) damaged_[name] = damaged_text(name, *row->stored, text);
    }
  }
  for (const auto& name : accepted) programs_.remove(accepted_prefix + name);
  for (const auto& [name, row] : index.rows) {
    if (!row.stored || index_.contains(name) || removed_.contains(name)) continue;
    ++revision_;
    if (row.removing || machine::is_print_file(name))
      removed_.insert(name);
    else if (!adopted.contains({row.stored->size, row.stored->crc32}))  // otherwise it was renamed
      damaged_[name] = "Program '" + name + "' is missing: upload it again, or 'trunnion restore' a backup";
  }
}

void ProgramStore::put(const std::string& name, const TextScan& text, std::uint8_t role) {
  // What programs print may begin like one.
  const auto number = machine::is_print_file(name) ? std::nullopt : text.number();
  index_[name] = {{name, ++revisions_[name], text.size(), text.crc32(), text.lines(), role}, number};
  removed_.erase(name);
  damaged_.erase(name);
  ++revision_;
  changed_ = true;
}

// The index first names both texts: after a crash the file is one of them.
void ProgramStore::replace(const std::string& file, const std::string& name, const TextScan& text,
                           std::uint8_t role) {
  next_[name] = {text.size(), text.crc32()};
  try {
    save_index();
    programs_.publish(file, name);
  } catch (const StorageError&) {
    next_.erase(name);
    throw;
  }
  next_.erase(name);
  put(name, text, role);
}

std::vector<std::string> ProgramStore::install(Files& delivered) {
  std::vector<std::string> refused;
  bool any = false;
  for (const auto& name : delivered.list()) {
    if (!valid_name(name)) {
      refused.push_back(name);
      continue;
    }
    const auto damaged = damaged_.find(name);
    if (damaged == damaged_.end() && (index_.count(name) != 0 || removed_.count(name) != 0)) continue;
    // A damaged program is replaced by what was delivered only when it was that.
    if (index_.count(name) != 0) {
      const auto text = scan(delivered, name);
      if (identity_of(index_[name].entry) != TextIdentity{text.size(), text.crc32()}) continue;
    }
    TextScan text;
    std::vector<std::uint8_t> buffer(65536);
    programs_.create(copy_temporary);
    for (std::size_t n = buffer.size(); n == buffer.size();) {
      n = delivered.read(name, text.size(), buffer);
      programs_.append(copy_temporary, text.size(), std::span(buffer).first(n));
      text.add(std::span(buffer).first(n));
    }
    programs_.publish(copy_temporary, name);
    put(name, text, machine::role::builder);
    any = true;
  }
  if (any) save_index();
  return refused;
}

void ProgramStore::set_cycles(Files& cycles) {
  cycles_files_ = &cycles;
  cycles_.clear();
  for (const auto& name : cycles.list()) {
    if (!valid_name(name)) continue;
    const auto text = scan(cycles, name);
    // The checksum is the revision: a cycle changes only with the machine's files.
    cycles_[name] = {{name, (std::uint64_t{1} << 32) | text.crc32(), text.size(), text.crc32(), text.lines(),
                      machine::role::builder},
                     text.number()};
  }
}

void ProgramStore::save_index() {
  IndexFile index{revision_, {}};
  for (const auto& [name, revision] : revisions_) {
    auto& row = index.rows[name];
    row.revision = revision;
    if (const auto found = index_.find(name); found != index_.end()) row.stored = found->second.entry;
    row.removed = !row.stored && removed_.count(name) != 0;
    row.removing = removing_.count(name) != 0;
  }
  for (const auto& [name, text] : next_) index.rows[name].next = text;
  state_.write_kept(index_file, machine_state::write_index(index));
}

idl::program::ProgramReply ProgramStore::apply(const Request& request, double now) {
  Reply reply;
  std::string error;
  try {
    const bool lookup = request.operation == Operation::RESOLVE;
    if (!lookup && !valid_name(request.name))
      error = "'" + request.name.substr(0, 64) + "' is not a program name: 1 to 64 letters, digits, . _ -";
    else
      switch (request.operation) {
        case Operation::READ:
          error = read(request, reply);
          break;
        case Operation::BEGIN_UPLOAD:
          error = begin(request, now);
          break;
        case Operation::WRITE:
          error = write(request, reply, now);
          break;
        case Operation::COMMIT_UPLOAD:
          error = commit(request, reply);
          break;
        case Operation::ABORT_UPLOAD:
          error = abort(request);
          break;
        case Operation::REMOVE:
          error = remove(request);
          break;
        case Operation::RENAME:
          error = rename(request, reply);
          break;
        case Operation::RESOLVE:
          error = find(request, reply);
          break;
        default:
          error = "unknown operation";
      }
    if (!error.empty())
      reply.alarm = (error == unknown(request.name) ? alarm::program_missing : alarm::request_invalid).number;
  } catch (const StorageError& e) {
    error = e.what();
    reply.data.clear();
    reply.alarm = alarm::storage_failed.number;
  }
  reply.accepted = error.empty();
  reply.reason = text::shortened(error, 256);
  return reply;
}

std::string ProgramStore::read(const Request& request, Reply& reply) {
  auto* files = &programs_;
  auto found = index_.find(request.name);
  if (found == index_.end()) {
    found = cycles_.find(request.name);
    if (found == cycles_.end()) return unknown(request.name);
    files = cycles_files_;
  }
  const auto& entry = found->second.entry;
  reply.entry = entry;
  reply.offset = request.offset;
  if (const auto damaged = damaged_.find(request.name); damaged != damaged_.end() && files == &programs_)
    return damaged->second;
  if (request.revision != 0 && request.revision != entry.revision)
    return "program '" + request.name + "' has changed: revision " + std::to_string(entry.revision) +
           ", expected " + std::to_string(request.revision);
  if (request.length > longest_chunk)
    return "length " + std::to_string(request.length) + " is above " + std::to_string(longest_chunk);
  if (request.offset > entry.size)
    return "offset " + std::to_string(request.offset) + " is behind the end of '" + request.name + "' at " +
           std::to_string(entry.size);
  const auto length = std::min<std::uint64_t>(request.length, entry.size - request.offset);
  reply.data.resize(static_cast<std::size_t>(length));
  if (files->read(request.name, request.offset, reply.data) != length)
    throw StorageError("program '" + request.name + "' was shortened from outside");
  return "";
}

std::string ProgramStore::begin(const Request& request, double now) {
  const UploadKey key{request.client, request.name};
  if (const auto old = uploads_.find(key); old != uploads_.end()) drop(old);
  if (uploads_.size() >= most_uploads) return "too many uploads at the same time";
  if (index_.count(request.name) == 0 && index_.size() >= most_programs)
    return "the store holds at most " + std::to_string(most_programs) + " programs";
  Upload upload;
  upload.file = upload_prefix + std::to_string(++upload_count_);
  upload.touched = now;
  programs_.create(upload.file);
  uploads_[key] = upload;
  return "";
}

std::string ProgramStore::write(const Request& request, Reply& reply, double now) {
  const auto found = uploads_.find({request.client, request.name});
  if (found == uploads_.end() && machine::is_print_file(request.name)) return print(request, reply);
  if (found == uploads_.end()) return "no upload of '" + request.name + "' exists";
  auto& upload = found->second;
  reply.offset = upload.text.size();
  if (request.offset != upload.text.size())
    return "offset " + std::to_string(request.offset) + " is not the end of the upload at " +
           std::to_string(upload.text.size());
  if (request.data.size() > longest_chunk) return "more than " + std::to_string(longest_chunk) + " bytes";
  check_room(request.name, request.data.size());
  programs_.append(upload.file, request.offset, request.data);
  upload.text.add(request.data);
  upload.touched = now;
  reply.offset = upload.text.size();
  return "";
}

// A line at the end of the file. Who has not heard that it was written sends it again for the same place.
// What a crash leaves of one is adopted at the next start.
std::string ProgramStore::print(const Request& request, Reply& reply) {
  const auto& name = request.name;
  const auto old = index_.find(name);
  const bool exists = old != index_.end();
  const std::uint64_t size = exists ? old->second.entry.size : 0, end = request.offset + request.data.size();
  reply.offset = size;
  if (request.data.size() > longest_chunk) return "more than " + std::to_string(longest_chunk) + " bytes";
  if (request.offset < size && end <= size) {
    std::vector<std::uint8_t> there(request.data.size());
    if (programs_.read(name, request.offset, there) == there.size() && there == request.data) {
      reply.entry = old->second.entry;
      reply.offset = end;
      return "";
    }
  }
  if (request.offset != size)
    return "offset " + std::to_string(request.offset) + " is not the end of '" + name + "' at " +
           std::to_string(size);
  if (auto reason = in_use(name); !reason.empty()) return reason;
  check_print_room(name, exists, end);
  auto& text = printed_[name];
  if (!exists) text = {}, programs_.create(name);
  if (exists && identity_of(old->second.entry) != TextIdentity{text.size(), text.crc32()})
    text = scan(programs_, name);
  programs_.append(name, size, request.data);
  text.add(request.data);
  put(name, text, machine::role::machine_operator);
  save_index();
  reply.entry = index_[name].entry;
  reply.offset = end;
  return "";
}

void ProgramStore::check_print_room(const std::string& name, bool exists, std::uint64_t bytes) const {
  if (bytes > machine::most_print_bytes)
    throw StorageError("'" + name + "' has " + std::to_string(machine::most_print_bytes / 1'000'000) +
                       " MB, more is not added: save it with 'trunnion program get', then delete it");
  if (!exists && index_.size() >= most_programs)
    throw StorageError("'" + name + "' is not stored: the store holds at most " +
                       std::to_string(most_programs) + " programs");
  check_room(name, bytes);
}

void ProgramStore::check_room(const std::string& name, std::uint64_t bytes) const {
  auto used = std::uint64_t{0};
  for (const auto& [stored, program] : index_)
    if (stored != name) used += program.entry.size;
  for (const auto& [key, upload] : uploads_) used += upload.text.size();
  if (used + bytes <= most_bytes_) return;
  constexpr std::uint64_t megabyte = 1'000'000;
  throw StorageError("Program '" + name + "' is not stored: programs have at most " +
                     std::to_string(most_bytes_ / megabyte) + " MB in all, and the others have " +
                     std::to_string(used / megabyte) + " MB: delete some that are not needed");
}

std::string ProgramStore::commit(const Request& request, Reply& reply) {
  const auto found = uploads_.find({request.client, request.name});
  if (found == uploads_.end()) return "no upload of '" + request.name + "' exists";
  const auto text = found->second.text;
  reply.offset = text.size();
  if (request.size != text.size())
    return "size " + std::to_string(text.size()) + " arrived, " + std::to_string(request.size) + " was sent";
  if (request.crc32 != text.crc32()) return "the checksum of '" + request.name + "' is wrong";
  const auto old = index_.find(request.name);
  // The same text again is no change, unless it is released by somebody who may do more.
  const bool same = old != index_.end() && request.role <= old->second.entry.role &&
                    identity_of(old->second.entry) == TextIdentity{text.size(), text.crc32()} &&
                    !damaged_.contains(request.name);
  if (same) {
    drop(found);
  } else if (auto reason = in_use(request.name); !reason.empty()) {
    drop(found);
    return reason;
  } else {
    replace(found->second.file, request.name, text, request.role);
    uploads_.erase(found);
    save_index();
  }
  reply.entry = index_[request.name].entry;
  return "";
}

std::string ProgramStore::abort(const Request& request) {
  const auto found = uploads_.find({request.client, request.name});
  if (found == uploads_.end()) return "no upload of '" + request.name + "' exists";
  drop(found);
  return "";
}

// A channel reads the text as it executes it.
std::string ProgramStore::in_use(const std::string& name) const {
  for (const auto& [channel, program] : executed_)
    if (program == name)
      return name + " is being executed by channel " + std::to_string(channel) + ": reset the channel first";
  return "";
}

void ProgramStore::set_executed(std::uint16_t channel, const std::string& name) {
  if (name.empty())
    executed_.erase(channel);
  else
    executed_[channel] = name;
}

std::string ProgramStore::remove(const Request& request) {
  if (index_.count(request.name) == 0) return unknown(request.name);
  if (auto reason = in_use(request.name); !reason.empty()) return reason;
  removing_.insert(request.name);
  try {
    save_index();
    programs_.remove(request.name);
  } catch (const StorageError&) {
    removing_.erase(request.name);
    throw;
  }
  removing_.erase(request.name);
  index_.erase(request.name);
  damaged_.erase(request.name);
  removed_.insert(request.name);
  ++revision_;
  changed_ = true;
  save_index();
  return "";
}

std::string ProgramStore::rename(const Request& request, Reply& reply) {
  const auto found = index_.find(request.name);
  if (found == index_.end()) return unknown(request.name);
  if (auto reason = in_use(request.name); !reason.empty()) return reason;
  if (!valid_name(request.new_name)) return "'" + request.new_name.substr(0, 64) + "' is not a program name";
  if (index_.count(request.new_name) != 0) return "program '" + request.new_name + "' exists already";
  if (const auto damaged = damaged_.find(request.name); damaged != damaged_.end()) return damaged->second;
  auto program = found->second;
  if (machine::is_print_file(request.new_name))
    program.number.reset();
  else if (machine::is_print_file(request.name))
    program.number = scan(programs_, request.name).number();
  programs_.publish(request.name, request.new_name);
  index_.erase(found);
  program.entry.name = request.new_name;
  program.entry.revision = ++revisions_[request.new_name];
  index_[request.new_name] = program;
  removed_.insert(request.name);
  removed_.erase(request.new_name);
  ++revision_;
  changed_ = true;
  reply.entry = program.entry;
  save_index();
  return "";
}

std::string ProgramStore::find(const Request& request, Reply& reply) {
  const auto* program = resolve(index_, request.name);
  if (program == nullptr) program = resolve(cycles_, request.name);
  if (program == nullptr) return unknown(request.name);
  reply.entry = program->entry;
  return "";
}

void ProgramStore::drop(std::map<UploadKey, Upload>::iterator upload) {
  const auto file = upload->second.file;
  uploads_.erase(upload);
  programs_.remove(file);
}

void ProgramStore::drop_stale_uploads(double now) {
  for (auto it = uploads_.begin(); it != uploads_.end();) {
    const auto upload = it++;
    if (now - upload->second.touched > upload_patience) drop(upload);
  }
}

idl::program::ProgramList ProgramStore::list() const {
  idl::program::ProgramList list;
  list.revision = revision_;
  for (const auto& [name, program] : index_) list.programs.push_back(program.entry);
  return list;
}

}  // namespace trunnion::program
