// SPDX-License-Identifier: Apache-2.0
// A participant that writes every topic of a cluster, whoever it belongs to: the newest message with other
// values in some fields, extreme ones among them. What it does is determined by its seed and by what it has
// read.
#pragma once

#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "bus/bus.hpp"

namespace trunnion::integration {

class HostileWriter {
 public:
  /// Topics of `spared` are not written.
  HostileWriter(const bus::NetworkSettings& network, std::uint64_t seed,
                const std::set<std::string>& spared = {});
  ~HostileWriter();

  /// Takes what has arrived and writes one message of a topic that has one.
  void write();
  /// Messages that were written, of each topic that there is.
  struct Written {
    std::string topic;
    std::uint64_t messages = 0;
  };
  std::vector<Written> written() const;

  /// One topic, whatever its type is.
  class Forger;

 private:
  std::mt19937_64 random_;
  bus::Bus bus_;
  std::vector<std::unique_ptr<Forger>> forgers_;
};

}  // namespace trunnion::integration
