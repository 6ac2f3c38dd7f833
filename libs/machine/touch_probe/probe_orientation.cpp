// SPDX-License-Identifier: Apache-2.0
#include "touch_probe/probe_orientation.hpp"

#include "geometry/angle.hpp"

namespace trunnion::touch_probe {

ProbeOrientation::ProbeOrientation(const geometry::ChainParameters& design) {
  const auto made = geometry::Chain::make(design);
  if (const auto* chain = std::get_if<geometry::Chain>(&made))
    for (std::size_t i = 0; i < chain->rotary_count(); ++i) axes_.push_back(chain->orienting_axis(i));
}

geometry::Vec3 ProbeOrientation::across(const geometry::Angles& degrees) const {
  geometry::Vec3 out = geometry::Vec3::UnitX();
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const auto t = geometry::sine_cosine(degrees[axes_[i].angle]);
    const geometry::Vec3 &k = axes_[i].direction, v = out;
    out = t.cosine * v + t.sine * k.cross(v) + ((1 - t.cosine) * k.dot(v)) * k;
  }
  return out;
}

}  // namespace trunnion::touch_probe
