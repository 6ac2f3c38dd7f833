// SPDX-License-Identifier: Apache-2.0
// A drive that reports the angle of its first spindle wrong in one bit, once: what verification must find.
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "../../services/drive/service.hpp"
#include "../../services/drive/simulation/simulated_hardware.hpp"

namespace trunnion::variants {

class WrongEncoder : public drive::EncoderRowSink {
 public:
  explicit WrongEncoder(drive::EncoderRowSink& rows) : rows_(rows) {}
  void skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) override {
    rows_.skip_edge(number, edge);
  }
  void encoder_row(const drive::EncoderRow& row) override {
    std::vector<double> angles(row.spindles.begin(), row.spindles.end());
    angles.at(0) = std::bit_cast<double>(std::bit_cast<std::uint64_t>(angles.at(0)) ^ 1);
    rows_.encoder_row({row.number, row.axes, angles});
  }

 private:
  drive::EncoderRowSink& rows_;
};

class WrongHardware : public drive::SimulatedHardware {
 public:
  void exchange(const drive::SetpointRow& row, drive::DriveStatus& status,
                drive::EncoderRowSink& rows) override {
    constexpr std::uint64_t wrong_period = 300;  // of those in which the axes move
    WrongEncoder wrong(rows);
    const bool now = row.moving && ++moving_ == wrong_period;
    SimulatedHardware::exchange(row, status, now ? static_cast<drive::EncoderRowSink&>(wrong) : rows);
  }

 private:
  std::uint64_t moving_ = 0;
};

class Drive : public drive::DriveService {
 public:
  explicit Drive(service::Node& node) : DriveService(node, std::make_unique<WrongHardware>()) {}
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Drive>(argc, argv, "drive");
}
