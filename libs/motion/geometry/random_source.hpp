// SPDX-License-Identifier: Apache-2.0
// Random numbers with the same bits on every host and of every library.
#pragma once

#include <cstdint>

namespace trunnion::geometry {

/// SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014). Its state is one
/// number.
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed = 0) : state_(seed) {}

  /// A source of this seed continues.
  std::uint64_t state() const { return state_; }
  /// 0 <= value < 1.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Mean 0, standard deviation 1, never beyond 6: the sum of twelve uniform numbers less 6. Needs no
  /// logarithm, whose last bit differs between hosts.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("state", self.state_);
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace trunnion::geometry
