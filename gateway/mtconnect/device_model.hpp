// SPDX-License-Identifier: Apache-2.0
// The machine as an MTConnect device: components and their data items (MTConnect Standard 2.4, part 2).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "machine/axes.hpp"

namespace trunnion::gateway::mtconnect {

enum class Category { sample, event, condition };

/// What an item is made of; docs/mtconnect.md has the table.
enum class Quantity {
  availability,
  asset_changed,
  asset_removed,
  emergency_stop,
  system,
  logic_program,
  hardware,
  communications,
  execution,
  controller_mode,
  program,
  line,
  parts,
  motion_program,
  path_feed,
  path_feed_programmed,
  feed_override,
  rapid_override,
  path_position,
  tool_number,
  tool_asset,
  work_offset,
  position,
  position_commanded,
  axis_feed,
  angle,
  angle_commanded,
  angular_velocity,
  load,
  rotary_mode,
  spindle_speed,
  spindle_speed_commanded,
  spindle_override
};

struct DataItem {
  std::string id;  ///< an XML name, unique in the device
  Quantity quantity = Quantity::availability;
  std::uint32_t part = 0;  ///< channel, logical axis or index of the spindle
};

/// The same for every item of a quantity.
struct ItemType {
  Category category;
  const char* type;      ///< as in DataItem/@type
  const char* sub_type;  ///< empty = none
  const char* units;     ///< empty = none
  const char* suffix;    ///< of the item's id
  const char* source;    ///< where the value comes from, for the documents
};
const ItemType& type_of(Quantity quantity);
/// Every quantity, in the order of the enumeration.
const std::vector<Quantity>& all_quantities();
/// Name of an observation's element: PATH_FEEDRATE -> PathFeedrate.
std::string element_name(const std::string& type);

struct Component {
  std::string kind;  ///< Axes, Linear, Rotary, Controller, Path; the device itself is Device
  std::string id, name;
  int parent = -1;  ///< index in Device::components, -1 for the device
  std::vector<DataItem> items;
};

struct Device {
  std::string name, uuid, description;
  std::vector<Component> components;  ///< the device first, parents before their parts
  bool operator==(const Device& other) const;
};

/// What the device is made of. Axes keep the order of their logical numbers.
struct MachineShape {
  std::string name, title, uuid;
  std::vector<machine::AxisInfo> axes, spindles;
  struct Channel {
    std::uint32_t number = 0;
    std::string name;
  };
  std::vector<Channel> channels;
};

Device device_of(const MachineShape& shape);

}  // namespace trunnion::gateway::mtconnect
