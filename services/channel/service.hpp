// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "core/channel_core.hpp"
#include "core/recorder_watch.hpp"
#include "record_keeper.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"
#include "service/request.hpp"
#include "stream/batch_reader.hpp"
#include "stream/replica_watch.hpp"
#include "unusable_parameters.hpp"

namespace trunnion::channel {

class ChannelService : public service::Service {
 public:
  explicit ChannelService(service::Node& node);
  void pump() override;
  double period() const override { return 0.02; }
  service::Health health() const override;
  service::SnapshotAnswer snapshot() override;
  void end() override;

 private:
  void start_stream();
  void recover();
  void continue_from_snapshot();
  void drain();
  void answer_requests();
  void fetch_text();
  void change_tables();
  void print_lines();
  void read_bodies();
  void read_variables();
  void save_variables();
  void publish_variables(const language::VariableStore& variables);
  std::optional<std::string> read_file(const std::string& file, std::uint32_t part, const std::string& loss);
  void put_aside(const std::string& file, const std::string& problem);
  void read_record();
  void keep_record();
  void watch_text();
  void read_on();
  void report_events();
  void watch_cycle();
  void read_hand_over();
  void watch_alarms();
  void tell_unreferenced();
  void set_holds();
  void take_outputs(const idl::plc::Outputs& outputs);
  void watch_replicas();
  void watch_recorders();
  void publish();

  service::Node& node_;
  service::ParameterClient parameters_;
  ChannelCore core_;
  UnusableParameters unusable_;
  service::RequestServer<idl::channel::ChannelRequest, idl::channel::ChannelReply> requests_;
  service::RequestClient<idl::program::ProgramRequest, idl::program::ProgramReply> program_client_,
      print_client_;
  service::RequestClient<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> table_client_;
  bus::Reader<idl::parameters::ToolTable> tools_;
  bus::Reader<idl::parameters::WorkOffsets> offsets_;
  bus::Reader<idl::program::ProgramList> programs_;
  bus::Reader<idl::plc::AuxiliaryDone> done_;
  bus::Reader<idl::plc::MacroSignal> signals_;
  bus::Reader<CycleReply> cycle_replies_;
  bus::Reader<idl::plc::Outputs> outputs_;
  bus::Reader<idl::service::Alarm> alarm_reader_;
  bus::Reader<idl::service::Cluster> cluster_reader_;
  stream::ReplicaWatch replicas_;
  std::optional<bus::Reader<idl::stream::StageProgress>> progress_reader_;  ///< of a machine with replicas
  RecorderWatch recorders_;
  std::optional<bus::Reader<idl::stream::RecordingProgress>> recording_reader_;  ///< in virtual time
  bus::Writer<idl::channel::ChannelState> state_writer_;
  bus::Writer<idl::channel::Variables> variables_writer_;
  bus::Writer<idl::channel::AuxiliaryRequest> auxiliary_writer_;
  bus::Writer<CycleRequest> cycle_writer_;
  bus::Writer<idl::stream::StreamRequest> stream_writer_;
  std::optional<bus::Writer<idl::stream::PathBatch>> batch_writer_;
  std::optional<stream::BatchReader<idl::stream::Feedback>> feedback_reader_;
  std::optional<stream::BatchReader<idl::stream::Feedback>>
      present_reader_;  ///< without history; until recovered

  using AlarmKey = std::array<std::uint32_t, 3>;
  std::map<AlarmKey, std::string> holding_alarms_;
  std::set<AlarmKey> unreferenced_;  ///< alarms 115; those of two drives while one is swapped
  std::string hand_over_file_;
  std::optional<HandOver> hand_over_;  ///< from the process before
  std::string variables_file_, saved_variables_, boot_;
  std::string record_file_;
  RecordKeeper record_;
  RunningProgram kept_;
  double kept_at_ = 0, text_missing_since_ = 0, cycle_unheard_since_ = -1, read_on_at_ = 0;
  bool record_failed_ = false;
  bool plc_hold_ = false;
  bool have_tools_ = false, have_offsets_ = false, have_programs_ = false;
  // A channel that has not heard the launcher refuses to start: it must not be counted as one that takes
  // part.
  bool have_cluster_ = false;
  idl::stream::PathBatch batch_;
  idl::stream::Feedback feedback_, present_;
  bool have_present_ = false;
  idl::program::ProgramRequest wanted_;
  std::uint64_t messages_in_ = 0, messages_out_ = 0;
  double last_state_ = 0, last_feedback_ = 0;
  RunState last_run_ = RunState::IDLE;
  bool changed_ = true;
};

}  // namespace trunnion::channel
