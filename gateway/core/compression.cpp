// SPDX-License-Identifier: Apache-2.0
#include "core/compression.hpp"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

namespace trunnion::gateway {
namespace {

constexpr int with_gzip_header = 15 + 16;  // window bits of zlib

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool equals(std::string_view text, std::string_view lower) {
  return std::ranges::equal(text, lower, [](unsigned char a, char b) { return std::tolower(a) == b; });
}

/// Of the parameters behind a coding: a weight of 0 refuses it.
bool is_refused(std::string_view parameters) {
  while (!parameters.empty()) {
    const auto end = parameters.find(';');
    const auto one = trimmed(parameters.substr(0, end));
    if (one.starts_with("q=") || one.starts_with("Q="))
      return one.substr(2).find_first_not_of("0.") == std::string_view::npos;
    if (end == std::string_view::npos) return false;
    parameters.remove_prefix(end + 1);
  }
  return false;
}

Bytef* bytes_of(std::string_view text) {
  return const_cast<Bytef*>(reinterpret_cast<const Bytef*>(text.data()));
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  std::optional<bool> named, any;
  while (!accept_encoding.empty()) {
    const auto end = accept_encoding.find(',');
    const auto one = accept_encoding.substr(0, end);
    const auto mark = one.find(';');
    const auto coding = trimmed(one.substr(0, mark));
    const bool good = mark == std::string_view::npos || !is_refused(one.substr(mark + 1));
    if (equals(coding, "gzip") || equals(coding, "x-gzip")) named = good;
    if (coding == "*") any = good;
    if (end == std::string_view::npos) break;
    accept_encoding.remove_prefix(end + 1);
  }
  return named.value_or(any.value_or(false));
}

bool is_compressible(std::string_view type) {
  return type.starts_with("text/") || type.starts_with("application/json") || type == "image/svg+xml";
}

std::string gzip(std::string_view text, int level) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, with_gzip_header, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("gzip: no memory");
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = bytes_of(text);
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = bytes_of(packed);
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("gzip: not finished");
  return packed;
}

}  // namespace trunnion::gateway
