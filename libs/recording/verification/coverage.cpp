// SPDX-License-Identifier: Apache-2.0
#include "verification/coverage.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "bus/codec.hpp"
#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/parameters.hpp"

namespace trunnion::verification {
namespace {

using idl::channel::AuxiliaryKind;
using idl::stream::AxisBatch;
using idl::stream::DriveMode;
using idl::stream::PathBatch;

const std::map<std::string, std::vector<std::string>>& feature_names() {
  static const std::map<std::string, std::vector<std::string>> names = {
      {"channel",
       {"motion", "tool tip control", "skip move", "tapping", "M", "S", "T", "cycle of a service",
        "refused command"}},
      {"kinematics", {"motion", "tool tip control", "tool length"}},
      {"compensation", {"motion", "backlash", "pitch error", "correction"}},
      {"gantry", {"motion", "gantry pair"}},
      {"drive", {"motion", "braking", "hold", "skip input", "spindle", "homing", "drives off"}},
      {"plc", {"function", "refused function"}},
      {"parameters", {"parameters", "tools", "offsets", "refused change"}},
      {"program", {"change of the list", "text", "refused request"}},
  };
  return names;
}

class Search {
 public:
  Search(const std::vector<StoredMessage>& expected, const StoredRecording& recording) {
    for (const auto& message : expected) see_output(message);
    for (const auto& message : recording.messages) see_input(message);
  }
  const std::set<std::string>& seen() const { return seen_; }

 private:
  using Place = std::tuple<std::uint16_t, std::uint32_t, std::uint64_t>;  // channel, epoch, first cycle

  void see(const char* feature, bool holds) {
    if (holds) seen_.insert(feature);
  }
  template <class T>
  static bool is(const StoredMessage& message, const char* handle, T& value) {
    return message.topic->handle == handle && bus::decode(message.cdr, value);
  }

  void see_output(const StoredMessage& message) {
    const auto& type = message.topic->type;
    if (type == bus::Fields<PathBatch>::name && bus::decode(message.cdr, path_)) {
      see("motion", path_.count > 0);
      see("tool tip control", path_.transformation == idl::stream::Transformation::RTCP);
      see("skip move", !path_.snapshot.skip_stopped.empty());
      see("tapping", !path_.spindle.empty() && !path_.follows_spindle);
    } else if (type == bus::Fields<AxisBatch>::name && bus::decode(message.cdr, axis_)) {
      see("motion", axis_.count > 0);
      revisions_.insert(axis_.revision);
      outputs_[{axis_.channel, axis_.epoch, axis_.first}] = {axis_.axes.size(), axis_.setpoints};
    } else if (is(message, "feedback", feedback_)) {
      see("motion", feedback_.count > 0);
      see("braking", feedback_.mode == DriveMode::BRAKING);
      see("hold", feedback_.mode == DriveMode::HELD);
      see("homing", feedback_.mode == DriveMode::HOMING);
      see("drives off", feedback_.mode == DriveMode::OFF);
      see("skip input", !feedback_.skips.empty());
      see("spindle", std::any_of(feedback_.spindle_speed.begin(), feedback_.spindle_speed.end(),
                                 [](double speed) { return speed != 0; }));
    } else if (is(message, "auxiliary_request", auxiliary_)) {
      see("M", auxiliary_.kind == AuxiliaryKind::M);
      see("S", auxiliary_.kind == AuxiliaryKind::S);
      see("T", auxiliary_.kind == AuxiliaryKind::T);
    } else if (message.topic->handle == "cycle_request") {
      see("cycle of a service", true);
    } else if (is(message, "auxiliary_done", done_)) {
      see(done_.failed ? "refused function" : "function", true);
    } else if (message.topic->handle == "macro_signal") {
      see("function", true);
    } else if (is(message, "channel_reply", channel_reply_)) {
      see("refused command", !channel_reply_.accepted);
    } else if (is(message, "parameter_reply", parameter_reply_)) {
      see("refused change", !parameter_reply_.accepted);
    } else if (is(message, "program_reply", program_reply_)) {
      see("refused request", !program_reply_.accepted);
      see("text", !program_reply_.data.empty());
    }
    see("parameters", message.topic->handle == "parameter_set");
    see("tools", message.topic->handle == "tool_table");
    see("offsets", message.topic->handle == "work_offsets");
    see("change of the list", message.topic->handle == "program_list");
  }

  void see_input(const StoredMessage& message) {
    idl::parameters::ParameterSet set;
    if (is(message, "parameter_set", set)) {
      if (revisions_.contains(set.revision)) see_parameters(machine::parameters_of(set));
    } else if (is(message, "path_batch", path_)) {
      if (!outputs_.contains({path_.channel, path_.epoch, path_.first})) return;
      see("tool tip control", path_.transformation == idl::stream::Transformation::RTCP);
      see("tool length", path_.tool_length != 0);
    } else if (message.topic->type == bus::Fields<AxisBatch>::name && bus::decode(message.cdr, axis_)) {
      const auto output = outputs_.find({axis_.channel, axis_.epoch, axis_.first});
      if (output == outputs_.end() || axis_.stage == idl::stream::Stage::GANTRY) return;
      see("gantry pair", output->second.first > axis_.axes.size());
      see("correction",
          output->second.first == axis_.axes.size() && output->second.second != axis_.setpoints);
    }
  }

  void see_parameters(const machine::Parameters& p) {
    for (const auto& axis : machine::drive_axes(p)) {
      see("backlash", p.integer(parameter::backlash_type, axis.number) != 0);
      see("pitch error", p.integer(parameter::pitch_type, axis.number) != 0);
    }
  }

  std::set<std::string> seen_;
  std::set<std::uint64_t> revisions_;
  std::map<Place, std::pair<std::size_t, std::vector<double>>> outputs_;  // columns and setpoints
  PathBatch path_;
  AxisBatch axis_;
  idl::stream::Feedback feedback_;
  idl::channel::AuxiliaryRequest auxiliary_;
  idl::plc::AuxiliaryDone done_;
  idl::channel::ChannelReply channel_reply_;
  idl::parameters::ParameterReply parameter_reply_;
  idl::program::ProgramReply program_reply_;
};

std::string list_of(const std::vector<Feature>& features, bool seen) {
  std::string list;
  for (const auto& feature : features)
    if (feature.seen == seen) list += (list.empty() ? "" : ", ") + feature.name;
  return list;
}

}  // namespace

std::vector<Feature> coverage_of(const std::string& service, const std::vector<StoredMessage>& expected,
                                 const StoredRecording& recording) {
  const auto names = feature_names().find(service);
  if (names == feature_names().end()) return {};
  const Search search(expected, recording);
  std::vector<Feature> features;
  for (const auto& name : names->second) features.push_back({name, search.seen().contains(name)});
  return features;
}

std::string text_of(const std::vector<Feature>& features) {
  const auto count = std::count_if(features.begin(), features.end(), [](const auto& f) { return f.seen; });
  std::string text = std::to_string(count) + " of " + std::to_string(features.size()) + " features seen";
  if (count > 0) text += ": " + list_of(features, true);
  if (count < std::ssize(features)) text += "; not " + list_of(features, false);
  return text;
}

std::vector<std::string> missing(const std::vector<Feature>& features,
                                 const std::vector<std::string>& required) {
  std::vector<std::string> result;
  for (const auto& name : required) {
    bool known = name == "all";
    for (const auto& feature : features) {
      if (name != "all" && name != feature.name) continue;
      known = true;
      if (!feature.seen) result.push_back(feature.name);
    }
    if (!known)
      throw std::runtime_error("the service has no feature '" + name + "', but " + list_of(features, true) +
                               (list_of(features, true).empty() ? "" : ", ") + list_of(features, false));
  }
  return result;
}

}  // namespace trunnion::verification
