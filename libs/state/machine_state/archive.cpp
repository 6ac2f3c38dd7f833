// SPDX-License-Identifier: Apache-2.0
#include "machine_state/archive.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <memory>
#include <stdexcept>

namespace trunnion::machine_state {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::size_t most_members = 10000;

la_ssize_t append(archive*, void* text, const void* bytes, std::size_t size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), size);
  return static_cast<la_ssize_t>(size);
}

// libarchive converts names by the locale of the thread, and "C" has no UTF-8.
class Utf8Names {
 public:
  Utf8Names() : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (utf8_ != nullptr) before_ = uselocale(utf8_);
  }
  ~Utf8Names() {
    if (utf8_ == nullptr) return;
    uselocale(before_);
    freelocale(utf8_);
  }
  Utf8Names(const Utf8Names&) = delete;
  Utf8Names& operator=(const Utf8Names&) = delete;

 private:
  locale_t utf8_, before_ = nullptr;
};

void check_size(std::size_t bytes, std::size_t members) {
  if (bytes > most_bytes) throw std::runtime_error("no backup: it has more than 1 GiB");
  if (members > most_members)
    throw std::runtime_error("no backup: it has more than " + std::to_string(most_members) + " files");
}

[[noreturn]] void fail(archive* a) {
  const char* reason = archive_error_string(a);
  throw std::runtime_error(std::string("no backup: ") + (reason != nullptr ? reason : "no tar archive"));
}

}  // namespace

std::string write_tar(const std::vector<Member>& members) {
  std::size_t total = 0;
  for (const auto& member : members) total += member.bytes.size();
  check_size(total, members.size());
  const Utf8Names names;
  const std::unique_ptr<archive, decltype(&archive_write_free)> a(archive_write_new(), archive_write_free);
  std::string text;
  if (archive_write_set_format_pax_restricted(a.get()) != ARCHIVE_OK ||
      archive_write_open(a.get(), &text, nullptr, append, nullptr) != ARCHIVE_OK)
    fail(a.get());
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(),
                                                                            archive_entry_free);
  for (const auto& member : members) {
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), member.name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(member.bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_mtime(entry.get(), 0, 0);
    const auto size = static_cast<la_ssize_t>(member.bytes.size());
    if (archive_write_header(a.get(), entry.get()) != ARCHIVE_OK ||
        archive_write_data(a.get(), member.bytes.data(), member.bytes.size()) != size)
      fail(a.get());
  }
  if (archive_write_close(a.get()) != ARCHIVE_OK) fail(a.get());
  return text;
}

std::vector<Member> read_tar(const std::string& bytes) {
  const Utf8Names names;
  const std::unique_ptr<archive, decltype(&archive_read_free)> a(archive_read_new(), archive_read_free);
  if (archive_read_support_format_tar(a.get()) != ARCHIVE_OK ||
      archive_read_open_memory(a.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    fail(a.get());
  std::vector<Member> members;
  std::size_t total = 0;
  archive_entry* entry = nullptr;
  for (int result; (result = archive_read_next_header(a.get(), &entry)) != ARCHIVE_EOF;) {
    if (result != ARCHIVE_OK) fail(a.get());
    const char* name = archive_entry_pathname(entry);
    if (name == nullptr || archive_entry_filetype(entry) != AE_IFREG ||
        archive_entry_hardlink(entry) != nullptr)
      throw std::runtime_error("no backup: it has more than regular files");
    Member member{name, ""};
    char piece[65536];
    for (la_ssize_t size; (size = archive_read_data(a.get(), piece, sizeof piece)) != 0;) {
      if (size < 0) fail(a.get());
      total += static_cast<std::size_t>(size);
      check_size(total, members.size());
      member.bytes.append(piece, static_cast<std::size_t>(size));
    }
    members.push_back(std::move(member));
    check_size(total, members.size());
  }
  return members;
}

}  // namespace trunnion::machine_state
