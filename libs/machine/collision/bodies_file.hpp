// SPDX-License-Identifier: Apache-2.0
// bodies.yaml: the bodies of a machine. docs/collision.md has the format.
#pragma once

#include <string>

#include "collision/bodies.hpp"

namespace trunnion::collision {

struct MachineBodies {
  MachineLinks links;
  BodySet set;
  bool derived = false;  ///< from the chain alone: the machine has no bodies.yaml
};

/// `file` is named in errors. `structure` is that of a machine whose file names none. Throws
/// std::runtime_error that begins with file:line:column: a key that is not known, a value outside its limits,
/// an axis that the machine does not have, a name that is there twice or that is none of a body.
MachineBodies parse_bodies(const std::string& text, const std::string& file,
                           const geometry::ChainParameters& design,
                           const std::vector<volumetric::StructureAxis>& structure = {});

/// Of the machine in `directory`; without bodies.yaml the derived_bodies().
MachineBodies load_bodies(const std::string& directory, const geometry::ChainParameters& design,
                          const std::vector<volumetric::StructureAxis>& structure = {});

}  // namespace trunnion::collision
