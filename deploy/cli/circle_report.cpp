// SPDX-License-Identifier: Apache-2.0
#include "circle_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iostream>

#include "figures.hpp"

namespace trunnion::cli {
namespace {

bus::Json scaled(const std::array<double, 4>& values) {
  return bus::Json::array({values[0] * um, values[1] * um, values[2] * um, values[3] * um});
}

}  // namespace

void print_figure(const std::string& name, double value, const std::string& unit) {
  std::cout << fmt::format("{:<34} {:>10.3f} {}\n", name, value, unit);
}

void print_report(const CircleReport& r) {
  const auto& f = r.figures;
  const auto& c = r.causes;
  const std::string first(1, r.plane[0]), second(1, r.plane[1]);
  print_figure("circular deviation G, ccw", f.deviation_ccw * um, "um");
  print_figure("circular deviation G, cw", f.deviation_cw * um, "um");
  print_figure("bidirectional G(b)", f.bidirectional * um, "um");
  print_figure("G(b) about the least-squares circle", f.squares_both * um, "um");
  print_figure("circular hysteresis H", f.hysteresis * um,
               fmt::format("um at {:.1f} deg", f.hysteresis_angle));
  print_figure("radial deviation F max, ccw", f.radial_largest_ccw * um, "um");
  print_figure("radial deviation F min, ccw", f.radial_least_ccw * um, "um");
  print_figure("radial deviation F max, cw", f.radial_largest_cw * um, "um");
  print_figure("radial deviation F min, cw", f.radial_least_cw * um, "um");
  print_figure("mean bidirectional radial dev. D", f.mean_radial * um, "um");
  print_figure("centre " + first, c.centre_first * um, "um");
  print_figure("centre " + second, c.centre_second * um, "um");
  print_figure("squareness", c.squareness * urad, "urad (above zero: more than 90 degrees)");
  print_figure("scale " + first + " less " + second, c.scale_mismatch * urad, "um/m");
  print_figure("servo mismatch", c.lag_mismatch * um, "um (above zero: " + first + " lags more)");
  print_figure("lost motion " + first, c.reversal_first * um, "um");
  print_figure("lost motion " + second, c.reversal_second * um, "um");
  for (std::size_t q = 0; q < 4; ++q) {
    const auto name = fmt::format("reversal spike {} at {} deg, ", r.plane[q % 2], 90 * q);
    print_figure(name + "ccw", c.spike_ccw[q] * um, "um");
    print_figure(name + "cw", c.spike_cw[q] * um, "um");
  }
  for (const auto& share : r.shares)
    if (share.span > 0)
      print_figure("alone: " + share.name, share.span * um,
                   fmt::format("um, {:.0f} % of the sum", share.share * 100));
}

bus::Json readings_json(circular_tests::Readings readings) {
  bus::Json all = bus::Json::array();
  for (const auto& reading : readings) all.push_back({reading.angle, reading.deviation * um});
  return all;
}

bus::Json report_json(const CircleReport& r) {
  const auto& f = r.figures;
  const auto& c = r.causes;
  // X Y Z of the machine; the axis across the plane has no centre.
  bus::Json centre = bus::Json::array({0.0, 0.0, 0.0});
  centre[static_cast<std::size_t>(r.plane[0] - 'X')] = c.centre_first * um;
  centre[static_cast<std::size_t>(r.plane[1] - 'X')] = c.centre_second * um;
  bus::Json shares = bus::Json::array();
  for (const auto& share : r.shares)
    shares.push_back({{"cause", share.name}, {"span_um", share.span * um}, {"share", share.share}});
  return {{"plane", r.plane},
          {"radius_mm", r.radius},
          {"circular_ccw_um", f.deviation_ccw * um},
          {"circular_cw_um", f.deviation_cw * um},
          {"bidirectional_um", f.bidirectional * um},
          {"least_squares_um", {f.squares_ccw * um, f.squares_cw * um, f.squares_both * um}},
          {"hysteresis_um", f.hysteresis * um},
          {"hysteresis_at_deg", f.hysteresis_angle},
          {"radial_um",
           {std::min(f.radial_least_ccw, f.radial_least_cw) * um,
            std::max(f.radial_largest_ccw, f.radial_largest_cw) * um}},
          {"radial_ccw_um", {f.radial_least_ccw * um, f.radial_largest_ccw * um}},
          {"radial_cw_um", {f.radial_least_cw * um, f.radial_largest_cw * um}},
          {"mean_radial_um", f.mean_radial * um},
          {"centre_um", centre},
          {"radius_um", c.radius * um},
          {"squareness_urad", c.squareness * urad},
          {"scale_mismatch_um_per_m", c.scale_mismatch * urad},
          {"reversal_um", {c.reversal_first * um, c.reversal_second * um}},
          {"lag_mismatch_um", c.lag_mismatch * um},
          {"spike_ccw_um", scaled(c.spike_ccw)},
          {"spike_cw_um", scaled(c.spike_cw)},
          {"causes", shares}};
}

}  // namespace trunnion::cli
