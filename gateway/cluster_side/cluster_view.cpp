// SPDX-License-Identifier: Apache-2.0
#include "cluster_side/cluster_view.hpp"

#include <utility>

#include "contracts/topics.hpp"
#include "machine/axes.hpp"
#include "service/node.hpp"

namespace trunnion::gateway {
namespace {

/// Replaces `kept` by the newest sample; true when there was one.
template <class T>
bool keep_newest(bus::Reader<T>& reader, std::shared_ptr<const T>& kept) {
  T value;
  if (!reader.take_newest(value)) return false;
  kept = std::make_shared<const T>(std::move(value));
  return true;
}

std::vector<std::uint16_t> drive_columns(const machine::Parameters& parameters) {
  std::vector<std::uint16_t> columns;
  for (const auto& axis : machine::drive_axes(parameters)) columns.push_back(axis.number);
  return columns;
}

}  // namespace

ClusterView::ClusterView(bus::Bus& bus, std::string title, FeedbackChange change)
    : announcements_(bus.reader(topics::announcement)),
      service_states_(bus.reader(topics::service_state)),
      alarms_(bus.reader(topics::alarm)),
      cluster_(bus.reader(topics::cluster)),
      channel_states_(bus.reader(topics::channel_state)),
      feedback_(bus, topics::feedback),
      outputs_(bus.reader(topics::plc_outputs)),
      image_(bus.reader(topics::plc_image)),
      variables_(bus.reader(topics::variables)),
      forces_(bus.reader(topics::plc_forces)),
      plc_programs_(bus.reader(topics::plc_programs)),
      watched_(bus.reader(topics::plc_watched)),
      measurement_(bus.reader(topics::measurement_state)),
      measurement_result_(bus.reader(topics::measurement_result)),
      parameters_(bus.reader(topics::parameter_set)),
      tools_(bus.reader(topics::tool_table)),
      offsets_(bus.reader(topics::work_offsets)),
      programs_(bus.reader(topics::program_list)),
      change_(std::move(change)) {
  document_.set_title(std::move(title));
}

void ClusterView::drain(double now) {
  idl::service::Announcement announcement;
  while (announcements_.take(announcement)) document_.apply(announcement);
  // Before the alarms: the one that has ended a program comes before the state that shows its end.
  idl::channel::ChannelState channel;
  while (channel_states_.take(channel)) {
    document_.apply(channel);
    next_.channels[channel.channel] = channel;
  }
  idl::service::Alarm alarm;
  while (alarms_.take(alarm)) {
    const auto time = service::time_of_day();
    document_.apply(alarm, now, time);
    history_.apply(alarm, time);
  }
  idl::service::ServiceState state;
  while (service_states_.take(state)) {
    document_.apply(state, now);
    history_.keep([this](const auto& active) { return document_.is_active(active); }, service::time_of_day());
  }
  idl::service::Cluster cluster;
  if (cluster_.take_newest(cluster)) document_.apply(cluster);
  idl::stream::Feedback batch;
  while (feedback_.take(batch)) {
    if (change_) change_(batch);
    document_.apply(batch);
    press_ = {batch.press_client, batch.press_number};
    ++batches_;
  }
  idl::plc::Outputs outputs;
  if (outputs_.take_newest(outputs)) document_.apply(outputs);
  keep_newest(image_, next_.image);
  keep_newest(forces_, next_.plc_forces);
  keep_newest(plc_programs_, next_.plc_programs);
  if (keep_newest(measurement_, next_.measurement)) document_.apply(*next_.measurement);
  keep_newest(measurement_result_, next_.measurement_result);
  idl::plc::Watched watched;
  while (watched_.take(watched))
    next_.plc_watched[watched.slot] = std::make_shared<const idl::plc::Watched>(watched);
  idl::channel::Variables variables;
  while (variables_.take(variables))
    next_.variables[variables.channel] = std::make_shared<const idl::channel::Variables>(variables);
  std::shared_ptr<const idl::parameters::ParameterSet> parameters;
  if (keep_newest(parameters_, parameters)) {
    next_.set_parameters(std::move(parameters));
    document_.set_revision("parameters", next_.parameters->revision);
    document_.set_revision("pending", next_.parameters->pending.size());
    document_.set_drive_axes(drive_columns(*next_.values));
  }
  if (keep_newest(tools_, next_.tools)) document_.set_revision("tools", next_.tools->revision);
  if (keep_newest(offsets_, next_.offsets)) document_.set_revision("work_offsets", next_.offsets->revision);
  if (keep_newest(programs_, next_.programs)) document_.set_revision("programs", next_.programs->revision);
}

std::shared_ptr<const ClusterState> ClusterView::state(double now, const bus::Json& operating,
                                                       bool with_replies) {
  ++next_.sequence;
  if (with_replies) next_.replies = next_.sequence;
  next_.document = document_.document(now);
  next_.past_alarms = history_.newest();
  if (!operating.is_null()) next_.document["operating"] = operating;
  return std::make_shared<const ClusterState>(next_);
}

}  // namespace trunnion::gateway
