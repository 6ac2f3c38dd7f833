// The recorder: every topic of the cluster into one file, from beside the stream.
#pragma once

#include <string>
#include <vector>

#include "bus/endpoint.hpp"

namespace trunnion::recorder {

struct Options {
  std::string output;
  std::string machine;              ///< name, for the file's metadata
  std::vector<std::string> topics;  ///< handles or names; empty = all
  bus::Vendor vendor = bus::Vendor::cyclonedds;
  bus::NetworkSettings network;
  double duration = 0;  ///< s; 0 = until a signal
  std::size_t queue_mebibytes = 256;
  bool json = false;
  bool parent_bound = false;
};

/// Records until SIGTERM, SIGINT or the end of the duration; returns the exit status: 0, or 1 when something
/// is missing from the file. Throws std::runtime_error when it cannot begin.
int record(const Options& options);

}  // namespace trunnion::recorder
