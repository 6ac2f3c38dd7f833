// SPDX-License-Identifier: Apache-2.0
// The geometry of a machine as it really is: the error model of libs/machine/compensation with the errors of
// truth.yaml.
#pragma once

#include "compensation/error_model.hpp"

namespace trunnion::truth {

using volumetric::axis_count;
using volumetric::component_count;
using volumetric::ComponentError;
using volumetric::ErrorFunction;
using volumetric::ErrorTerms;
using volumetric::Harmonic;
using volumetric::heat_source_count;
using volumetric::HeatSource;
using volumetric::HeatSources;
using volumetric::MachinePose;
using volumetric::Mat3;
using volumetric::Polynomial;
using volumetric::rotation;
using volumetric::spindle_source;
using volumetric::StructureAxis;
using volumetric::Table;
using volumetric::Temperatures;
using volumetric::ToolPose;
using volumetric::Vec3;
using volumetric::WarmUp;
using AxisTruth = volumetric::AxisErrors;
using BeamTruth = volumetric::BeamErrors;
using GeometryTruth = volumetric::GeometryErrors;
using TrueGeometry = volumetric::ErrorModel;

}  // namespace trunnion::truth
