// Every stage must keep this: a process that continues from the state of another computes the same bits.
#include <cstdio>
#include <random>

#include "@NAME@_core.hpp"

namespace {

using Frame = trunnion::idl::stream::AxisFrame;

// Batches of 1 to 8 cycles of three axes.
std::vector<Frame> motion(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Frame> frames(40);
  for (auto& frame : frames) {
    frame.count = 1 + random() % 8;
    frame.axes = {0, 1, 2};
    for (std::size_t i = 0; i < 3 * frame.count; ++i)
      frame.setpoints.push_back(static_cast<double>(random() % 100000) / 1000);
  }
  return frames;
}

std::vector<double> output_of(@IDENTIFIER@::Core& core, const Frame& in) {
  trunnion::stream::FeedbackWindow feedback;
  Frame out;
  core.process(in, feedback, out);
  return out.setpoints;
}

}  // namespace

int main() {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto frames = motion(seed);
    for (std::size_t cut = 0; cut < frames.size(); ++cut) {
      @IDENTIFIER@::Core whole, continued;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto expected = output_of(whole, frames[i]);
        if (expected.size() != frames[i].setpoints.size()) {
          std::printf("seed %u, batch %zu: %zu setpoints of %zu\n", seed, i, expected.size(),
                      frames[i].setpoints.size());
          return 1;
        }
        if (i > cut && output_of(continued, frames[i]) != expected) {
          std::printf("seed %u: continued after batch %zu, other setpoints in batch %zu\n", seed, cut, i);
          return 1;
        }
        if (i == cut) {
          trunnion::stream::StateValues state;
          whole.save(state);
          continued.load(state);
        }
      }
    }
  }
  std::printf("20 motions, continued after every batch: the same setpoints\n");
  return 0;
}
