// SPDX-License-Identifier: Apache-2.0
#include "bus/endpoint_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace trunnion::bus {

void log_endpoint(const std::string& identity, bool writes, const std::string& topic) {
  const char* const file = std::getenv("TRUNNION_ENDPOINTS");
  if (file == nullptr || *file == '\0') return;
  const std::string line = identity + (writes ? " writes " : " reads ") + topic + "\n";
  // One write at the end of the file, so that the lines of several processes stay whole.
  const int log = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const auto written = log < 0 ? -1 : write(log, line.data(), line.size());
  const int error = errno;
  if (log >= 0) close(log);
  if (written != static_cast<ssize_t>(line.size()))
    throw std::runtime_error(std::string("TRUNNION_ENDPOINTS: ") + file + ": " + std::strerror(error));
}

}  // namespace trunnion::bus
