// SPDX-License-Identifier: Apache-2.0
// Which station operates the machine: one holds the right, the others watch. Without clock: it is given.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::access {

/// A browser, a program with a token, or the command line.
struct Station {
  std::string key;             ///< secret of the station, or what identifies it
  std::string name;            ///< for people
  bool may_take_over = false;  ///< also when the holder has not agreed
};

/// What the others may know of a station.
struct ShownStation {
  std::uint32_t number = 0;  ///< the same for the same key
  std::string name;
  bool operator==(const ShownStation&) const = default;
};
/// `number` is 28 bits of the SHA-256 of the key, so that it does not tell the key.
ShownStation shown(const Station& station);

class OperatingRight {
 public:
  /// Seconds without a sign of a station after which it has lost the right.
  static constexpr double lease = 15;

  /// An order of `station`: reserves the right until it is answered, when nobody holds it. Empty, or the name
  /// of who holds or has reserved it. `now` in seconds of a monotonic clock.
  std::string order(const Station& station, double now);
  /// Number of the reservation that the last order is of, from 1; 0 when it has reserved nothing, because its
  /// station holds the right.
  std::uint64_t reservation() const { return reserved_ ? reservation_ : 0; }
  /// An order of that reservation is answered: one that is accepted takes the right, and then this is true;
  /// when none is, the right is free again.
  bool answered(std::uint64_t reservation, bool accepted, double now);
  /// A sign of the station, which may hold the right or ask for it.
  void present(std::string_view key, double now);

  enum class Taken {
    yes,
    asked  ///< the holder is asked
  };
  Taken take(const Station& station, double now);
  /// The holder `key` gives the right to who asks for it. False when it does not hold it, or nobody asks.
  bool hand_over(std::string_view key, double now);
  /// The holder `key` keeps it. False as above.
  bool refuse(std::string_view key, double now);
  /// `key` neither holds it nor asks for it any more.
  void release(std::string_view key);

  std::optional<ShownStation> holder(double now) const { return current(holder_, now); }
  std::optional<ShownStation> asking(double now) const { return current(asking_, now); }
  bool is_held_by(std::string_view key, double now) const {
    return holder(now) && holder_->station.key == key;
  }

 private:
  struct Present {
    Station station;
    double seen = 0;
  };
  static std::optional<ShownStation> current(const std::optional<Present>& one, double now);
  void expire(double now);
  void give_to(const Station& station, double now);
  std::optional<Present> holder_, asking_;
  std::optional<Station> reserved_;  ///< without holder: whose orders are being answered
  int orders_ = 0;                   ///< how many they are
  std::uint64_t reservation_ = 0;
};

}  // namespace trunnion::access
