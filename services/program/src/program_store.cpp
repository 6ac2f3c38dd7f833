// SPDX-License-Identifier: Apache-2.0
#include "program_store.hpp"

#include <algorithm>
#include <utility>

#include "machine/alarm_constants.hpp"
#include "machine/yaml.hpp"

namespace trunnion::program {
namespace {

using idl::program::Operation;

constexpr const char* index_temporary = "programs.yaml.new";
constexpr const char* copy_temporary = ".copy";
constexpr const char* upload_prefix = ".upload-";

std::string unknown(const std::string& name) { return "program '" + name + "' is not in the store"; }

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

ProgramStore::ProgramStore(Files& programs, Files& state) : programs_(programs), state_(state) {
  load_index();
  const auto before = revision_;
  Index known;
  std::swap(known, index_);
  for (const auto& name : programs_.list()) {
    if (name.rfind(upload_prefix, 0) == 0 || name == copy_temporary) {
      programs_.remove(name);  // left behind by a process that was killed
      continue;
    }
    if (!valid_name(name) || index_.size() >= most_programs) continue;
    const auto text = scan(programs_, name);
    const auto found = known.find(name);
    if (found != known.end() && found->second.entry.size == text.size() &&
        found->second.entry.crc32 == text.crc32()) {
      index_[name] = {found->second.entry, text.number()};
    } else {
      put(name, text);
    }
  }
  for (const auto& [name, program] : known)
    if (index_.count(name) == 0 && removed_.count(name) == 0) ++revision_;
  if (revision_ != before || revision_ == 0) {
    revision_ = std::max<std::uint64_t>(revision_, 1);
    save_index();
  }
}

void ProgramStore::put(const std::string& name, const TextScan& text) {
  index_[name] = {{name, ++revisions_[name], text.size(), text.crc32(), text.lines()}, text.number()};
  removed_.erase(name);
  ++revision_;
  changed_ = true;
}

std::vector<std::string> ProgramStore::install(Files& delivered) {
  std::vector<std::string> refused;
  bool any = false;
  for (const auto& name : delivered.list()) {
    if (!valid_name(name)) {
      refused.push_back(name);
      continue;
    }
    if (index_.count(name) != 0 || removed_.count(name) != 0) continue;
    TextScan text;
    std::vector<std::uint8_t> buffer(65536);
    programs_.create(copy_temporary);
    for (std::size_t n = buffer.size(); n == buffer.size();) {
      n = delivered.read(name, text.size(), buffer);
      programs_.append(copy_temporary, text.size(), std::span(buffer).first(n));
      text.add(std::span(buffer).first(n));
    }
    programs_.publish(copy_temporary, name);
    put(name, text);
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
    cycles_[name] = {{name, (std::uint64_t{1} << 32) | text.crc32(), text.size(), text.crc32(), text.lines()},
                     text.number()};
  }
}

void ProgramStore::load_index() {
  const auto names = state_.list();
  if (std::find(names.begin(), names.end(), index_file) == names.end()) return;
  std::string text;
  std::vector<std::uint8_t> buffer(65536);
  for (std::size_t n = buffer.size(); n == buffer.size();) {
    n = state_.read(index_file, text.size(), buffer);
    text.append(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n));
  }
  const auto document = machine::parse_yaml(text, index_file);
  try {
    revision_ = document["revision"].as<std::uint64_t>();
    for (const auto& node : document["programs"]) {
      idl::program::ProgramEntry entry;
      entry.name = node["name"].as<std::string>();
      entry.revision = node["revision"].as<std::uint64_t>();
      revisions_[entry.name] = entry.revision;
      if (node["removed"]) removed_.insert(entry.name);
      if (!node["size"]) continue;
      entry.size = node["size"].as<std::uint64_t>();
      entry.crc32 = node["crc32"].as<std::uint32_t>();
      entry.lines = node["lines"].as<std::uint32_t>();
      index_[entry.name] = {entry, std::nullopt};
    }
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(std::string(index_file) + ":" + std::to_string(e.mark.line + 1) + ":" +
                             std::to_string(e.mark.column + 1) + ": error: " + e.msg);
  }
}

void ProgramStore::save_index() {
  std::string text =
      "# Kept by the program service.\nrevision: " + std::to_string(revision_) + "\nprograms:\n";
  for (const auto& [name, revision] : revisions_) {
    text += "  - {name: \"" + name + "\", revision: " + std::to_string(revision);
    if (const auto found = index_.find(name); found != index_.end()) {
      const auto& entry = found->second.entry;
      text += ", size: " + std::to_string(entry.size) + ", crc32: " + std::to_string(entry.crc32) +
              ", lines: " + std::to_string(entry.lines);
    } else if (removed_.count(name) != 0) {
      text += ", removed: true";
    }
    text += "}\n";
  }
  state_.create(index_temporary);
  state_.append(index_temporary, 0, bytes_of(text));
  state_.publish(index_temporary, index_file);
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
  reply.reason = error.substr(0, 256);
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
  if (found == uploads_.end()) return "no upload of '" + request.name + "' exists";
  auto& upload = found->second;
  reply.offset = upload.text.size();
  if (request.offset != upload.text.size())
    return "offset " + std::to_string(request.offset) + " is not the end of the upload at " +
           std::to_string(upload.text.size());
  if (request.data.size() > longest_chunk) return "more than " + std::to_string(longest_chunk) + " bytes";
  programs_.append(upload.file, request.offset, request.data);
  upload.text.add(request.data);
  upload.touched = now;
  reply.offset = upload.text.size();
  return "";
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
  const bool same =
      old != index_.end() && old->second.entry.size == text.size() && old->second.entry.crc32 == text.crc32();
  if (same) {
    drop(found);  // the same text again is no change
  } else {
    programs_.publish(found->second.file, request.name);
    uploads_.erase(found);
    put(request.name, text);
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

std::string ProgramStore::remove(const Request& request) {
  if (index_.count(request.name) == 0) return unknown(request.name);
  programs_.remove(request.name);
  index_.erase(request.name);
  removed_.insert(request.name);
  ++revision_;
  changed_ = true;
  save_index();
  return "";
}

std::string ProgramStore::rename(const Request& request, Reply& reply) {
  const auto found = index_.find(request.name);
  if (found == index_.end()) return unknown(request.name);
  if (!valid_name(request.new_name)) return "'" + request.new_name.substr(0, 64) + "' is not a program name";
  if (index_.count(request.new_name) != 0) return "program '" + request.new_name + "' exists already";
  programs_.publish(request.name, request.new_name);
  auto program = found->second;
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
