// SPDX-License-Identifier: Apache-2.0
#include "synthetic_run.hpp"

#include <gtest/gtest.h>

#include "bus/codec.hpp"
#include "bus/registry.hpp"
#include "channel_setup/channel_setup.hpp"
#include "contracts/topics.hpp"
#include "language/interpreter.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "motion/trajectory.hpp"
#include "program_execution/tapping.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::report::test {
namespace {

using language::AxisValues;

struct Row {
  AxisValues position;
  std::uint32_t line;
  bool rtcp;
  double tool_length;
};

// What the channel does, without a bus: commands into motion, motion into rows.
std::vector<Row> rows_of(const std::string& program, const MachineTables& tables) {
  channel_setup::ChannelSetup environment(tables);
  const auto chain = machine::make_chain(tables.parameters, 0);
  motion::Limits limits;
  const auto axes = machine::channel_axes(tables.parameters, 0);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const auto a = axes.number[i];
    limits.axes[axes.index[i]] = {tables.parameters.get(parameter::maximum_feed, a) / 60,
                                  tables.parameters.get(parameter::rapid_feed, a) / 60,
                                  tables.parameters.get(parameter::maximum_acceleration, a)};
  }
  motion::Trajectory trajectory(limits, &chain, 0.001);
  language::StringSource source(program);
  language::Interpreter interpreter(environment);
  interpreter.start(source, {}, {});
  auto transformation = language::Transformation::none;
  double tool_length = 0;
  trajectory.start({}, transformation, tool_length);
  std::vector<Row> rows;
  const auto step = [&] {
    const auto s = trajectory.step(1, 1, false);
    rows.push_back({s.position, s.line, transformation == language::Transformation::rtcp, tool_length});
  };
  language::Command command;
  for (;;) {
    const auto got = interpreter.next(command);
    if (got == language::Step::working || got == language::Step::pending) continue;
    if (got != language::Step::command) {
      EXPECT_EQ(got, language::Step::end) << interpreter.alarm().text.data();
      break;
    }
    using language::CommandKind;
    if (command.kind == CommandKind::tap) command = program_execution::Tapping::line(command);
    if (command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
        command.kind == CommandKind::arc) {
      while (!trajectory.can_accept()) step();
      EXPECT_TRUE(trajectory.push(command)) << command.line;
      continue;
    }
    trajectory.finish();
    while (!trajectory.at_rest()) step();
    if (command.kind == CommandKind::end) break;
    if (command.kind == CommandKind::transformation) {
      transformation = command.modal.transformation;
      tool_length = transformation == language::Transformation::rtcp ? command.modal.tool_length : 0;
      trajectory.start(command.target, transformation, tool_length);
    }
  }
  return rows;
}

class RecordingFile {
 public:
  explicit RecordingFile(const std::string& path) : sink_(path), writer_(sink_) {
    writer_.metadata("trunnion",
                     {{"machine", "ac-table"}, {"contract", topics::contract_hash}, {"version", "test"}});
    for (const auto& entry : bus::all_topics())
      channels_[entry.description.name] =
          writer_.add_channel(entry.description.name, entry.type, entry.schema);
  }
  template <class T>
  void write(const bus::Topic<T>& topic, const T& value, std::int64_t time) {
    bus::encode(value, bytes_);
    ASSERT_TRUE(
        writer_.write(channels_.at(topic.name), ++sequence_, static_cast<std::uint64_t>(time), bytes_));
  }
  void finish(bool whole) { ASSERT_TRUE(whole ? writer_.finish() : writer_.flush()); }

 private:
  recording::FileSink sink_;
  recording::Writer writer_;
  std::map<std::string, std::uint16_t> channels_;
  bus::Bytes bytes_;
  std::uint32_t sequence_ = 0;
};

}  // namespace

MachineTables ac_table() {
  MachineTables t;
  auto& values = t.parameters.values;
  const char* names[] = {"X", "Y", "Z", "A", "C"};
  const std::uint32_t letters[] = {0, 1, 2, 3, 5};
  for (std::uint32_t a = 0; a < 5; ++a) {
    values[40001 + letters[a]] = {static_cast<double>(a), ""};
    values[100000 + 1000 * a] = {0, names[a]};
    values[100001 + 1000 * a] = {a < 3 ? 1.0 : 3.0, ""};
  }
  values[40425] = {35, ""};
  values[40426] = {-1, ""};
  values[40431] = {-1, ""};
  values[40437] = {-400, ""};
  t.parameters.revision = 1;
  t.tools.tools.resize(1);
  t.tools.tools[0].number = 1;
  t.tools.tools[0].length = 100;
  t.offsets.offsets.resize(1);
  t.offsets.offsets[0].values = {0, 0, -380, 0, 0, 0, 0, 0, 0};
  return t;
}

std::uint64_t record_run(const RunOptions& options) {
  const MachineTables tables = ac_table();
  const auto rows = rows_of(options.program, tables);
  const auto chain = machine::make_chain(tables.parameters, 0);
  const auto axes = machine::channel_axes(tables.parameters, 0);
  RecordingFile file(options.file);

  idl::parameters::ParameterSet set;
  set.revision = 1;
  for (std::uint32_t a = 0; a < options.play.size(); ++a)
    if (options.play[a] > 0) set.values.push_back({100910 + 1000 * a, options.play[a], ""});
  for (const auto& [number, value] : tables.parameters.values)
    set.values.push_back({number, value.value, value.text});
  file.write(topics::parameter_set, set, start_time - 3);
  file.write(topics::tool_table, tables.tools, start_time - 2);
  file.write(topics::work_offsets, tables.offsets, start_time - 1);

  std::uint64_t cycle = first_cycle;
  int batch_number = 0;
  for (std::size_t i = 0; i < rows.size(); ++batch_number) {
    idl::stream::PathBatch path;
    path.epoch = 1;
    path.first = cycle;
    path.revision = 1;
    path.starts = i == 0;
    path.transformation =
        rows[i].rtcp ? idl::stream::Transformation::RTCP : idl::stream::Transformation::NO_TRANSFORMATION;
    path.tool_length = rows[i].tool_length;
    idl::stream::AxisBatch joints;
    idl::stream::Feedback feedback;
    joints.epoch = 1;
    joints.first = feedback.first = cycle;
    joints.starts = path.starts;
    joints.axes = axes.number;
    feedback.axis_count = 5;
    const bool rtcp = rows[i].rtcp;
    for (; path.count < batch_cycles && i < rows.size() && rows[i].rtcp == rtcp; ++i, ++path.count, ++cycle) {
      AxisValues p = rows[i].position;
      path.setpoints.insert(path.setpoints.end(), p.begin(), p.end());
      path.lines.push_back(rows[i].line);
      if (rtcp) {
        const Vec3 at =
            chain.machine_from_tip({p[0], p[1], p[2]}, geometry::angles_of(p.data()), path.tool_length);
        std::copy_n(at.data(), 3, p.begin());
      }
      std::array<double, 5> command{p[0], p[1], p[2], p[3], p[5]};
      if (options.compensation) options.compensation(cycle - first_cycle, command);
      joints.setpoints.insert(joints.setpoints.end(), command.begin(), command.end());
      feedback.commanded.insert(feedback.commanded.end(), command.begin(), command.end());
      if (options.encoder_error) options.encoder_error(cycle - first_cycle, command);
      feedback.actual.insert(feedback.actual.end(), command.begin(), command.end());
    }
    path.ends = joints.ends = i == rows.size();
    joints.count = feedback.count = path.count;
    joints.lines = path.lines;
    std::int64_t time = start_time + batch_number * batch_interval;
    if (batch_number >= options.late_batches) file.write(topics::path_batch, path, time);
    using idl::stream::Stage;
    for (const auto stage : {Stage::KINEMATICS, Stage::COMPENSATION, Stage::GANTRY}) {
      joints.stage = stage;
      time += stage_latency[static_cast<int>(stage) - static_cast<int>(Stage::KINEMATICS)];
      if (stage == Stage::KINEMATICS) file.write(topics::kinematics_batch, joints, time);
      if (stage == Stage::KINEMATICS && options.replicas) {
        joints.replica = 1;
        file.write(topics::kinematics_batch, joints, time + 500);
        joints.replica = 0;
      }
      if (stage == Stage::COMPENSATION) file.write(topics::compensation_batch, joints, time);
      if (stage == Stage::GANTRY && batch_number != options.skipped_batch)
        file.write(topics::gantry_batch, joints, time);
    }
    file.write(topics::feedback, feedback, time + stage_latency[3]);
  }
  file.finish(!options.cut_off);
  return cycle - first_cycle;
}

}  // namespace trunnion::report::test
