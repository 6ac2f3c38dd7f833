// SPDX-License-Identifier: Apache-2.0
#include "swap_journal.hpp"

#include <fcntl.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "bus/json.hpp"
#include "cluster/cluster_files.hpp"
#include "storage/crc32.hpp"
#include "storage/file.hpp"

namespace trunnion::launcher {
namespace {

std::string checksum(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  char text[9];
  std::snprintf(text, sizeof text, "%08x", storage::crc32(bytes.str()));
  return text;
}

bus::Json json_of(const SwapSide& side) {
  return {{"executable", side.executable},
          {"build", side.version},
          {"crc32", checksum(side.executable)},
          {"contract", side.contract},
          {"vendor", side.vendor}};
}

}  // namespace

std::string swap_line(const idl::service::SwapRequest& request, const idl::service::SwapReply& reply,
                      const SwapSide& before, const SwapSide& after) {
  const bus::Json line{{"cycle", reply.cycle},
                       {"service", request.service},
                       {"replica", request.replica},
                       {"channel", request.channel},
                       {"compared_cycles", reply.compared},
                       {"seconds", reply.seconds},
                       {"gap_seconds", reply.gap},
                       {"old", json_of(before)},
                       {"new", json_of(after)}};
  return bus::text_of(line) + "\n";
}

std::string refusal_line(const idl::service::SwapRequest& request, const std::string& why,
                         const std::string& time, std::uint64_t count) {
  const bus::Json line{{"refused", why},
                       {"time", time},
                       {"service", request.service},
                       {"executable", request.executable},
                       {"requests", count}};
  return bus::text_of(line) + "\n";
}

void append_swap(const std::string& state_directory, const std::string& line) {
  storage::File file(state_directory + "/" + cluster::swap_journal_file, O_RDWR | O_CREAT);
  file.append(file.size(), {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
  file.sync();
}

}  // namespace trunnion::launcher
