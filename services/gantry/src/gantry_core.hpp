// Slave axes of a gantry follow their master; the synchronization error is corrected slowly and supervised.
// Source: HNC-8 parameters 010050.., 10a100..10a131.
#pragma once

#include <vector>

#include "machine/axes.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::gantry {

/// A slave and its master, as parameters say.
struct Pair {
  std::uint16_t master = 0, slave = 0;
  double sign = 1;                            ///< -1 when mirrored
  double zero_deviation = 0;                  ///< mm, slave position when the master is at zero
  double rate = 0;                            ///< share of the error corrected in each cycle
  double maximum = 0;                         ///< mm, largest correction
  double warning = 0, limit = 0;              ///< mm, 0 = off
  int master_column = -1, slave_column = -1;  ///< in the drive's feedback
};

/// Every pair of the machine. Throws std::runtime_error when a slave or its master does not exist.
std::vector<Pair> read_pairs(const machine::Parameters& parameters);

/// Slave minus where its master wants it, mm, from encoder positions.
double synchronization_error(const Pair& pair, const double* actual);

/// State: the correction of each slave of the channel, mm.
class GantryCore : public stream::StageCore<idl::stream::AxisFrame> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisFrame& out) override;
  void load(std::span<const double> state) override;
  void save(stream::StateValues& state) const override { state = corrections_; }

 private:
  std::uint64_t lead_ = 32;
  std::vector<Pair> pairs_;
  std::vector<std::size_t> master_index_;  // column of each master in the channel's frames
  std::vector<double> corrections_;
};

}  // namespace trunnion::gantry
