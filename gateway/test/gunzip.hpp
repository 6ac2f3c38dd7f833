// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <string>

namespace trunnion::gateway {

/// What gzip() was given; empty when `bytes` is damaged or cut off.
inline std::string gunzip(std::string bytes) {
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);  // window bits of zlib, with the header of gzip
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  int status = Z_OK;
  while (status == Z_OK) {
    char part[16384];
    stream.next_out = reinterpret_cast<Bytef*>(part);
    stream.avail_out = sizeof part;
    status = inflate(&stream, Z_NO_FLUSH);
    text.append(part, sizeof part - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END ? text : "";
}

}  // namespace trunnion::gateway
