// SPDX-License-Identifier: Apache-2.0
// info, diff, export: what is in a recording
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "recording/file_stream.hpp"
#include "verification/alignment.hpp"
#include "verification/csv.hpp"
#include "verification/difference.hpp"
#include "verification/summary.hpp"

namespace trunnion::cli {
namespace {

int info(const Common& common, const std::string& file) {
  recording::FileSource source(file);
  const auto summary = verification::summarize(source);
  if (summary.messages == 0 && summary.metadata.empty() && !summary.complete)
    throw std::runtime_error(file + ": " + summary.problem);
  std::cout << (common.json ? bus::text_of(verification::json_of(summary), 2) + "\n"
                            : verification::text_of(summary));
  return 0;
}

// The name of the topic the contract calls `name`, by handle.
std::string handle_of(const std::string& name) {
  const auto* entry = bus::find_topic(name);
  if (entry == nullptr)
    throw std::runtime_error("no topic is called '" + name + "': see 'trunnion topic list'");
  return entry->handle;
}

struct DiffArguments {
  std::string a, b;
  std::vector<std::string> topics, tolerances;
  bool common = false, align = false;
  std::uint16_t channel = 0;
  std::vector<unsigned> runs{1, 1};
};

// Whole, or one run of a program.
std::vector<verification::StoredMessage> compared(const verification::StoredRecording& recording,
                                                  const DiffArguments& arguments, bool second) {
  if (!arguments.align) return recording.messages;
  try {
    return verification::aligned(recording, arguments.channel, arguments.runs.at(second ? 1 : 0));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error((second ? arguments.b : arguments.a) + ": " + error.what());
  }
}

int diff(const Common& common, const DiffArguments& arguments) {
  verification::DiffOptions options;
  for (const auto& text : arguments.tolerances) verification::add_tolerance(options, text);
  for (const auto& topic : arguments.topics) options.topics.insert(handle_of(topic));
  options.common = arguments.common;
  const auto needed = arguments.align ? std::set<std::string>{} : options.topics;
  if (arguments.align && options.topics.empty()) options.topics = verification::aligned_topics();
  const auto a = verification::load_recording(arguments.a, needed);
  const auto b = verification::load_recording(arguments.b, needed);
  for (const auto* recording : {&a, &b}) {
    const auto& file = recording == &a ? arguments.a : arguments.b;
    if (!recording->complete) std::cerr << file << ": warning: " << recording->problem << "\n";
    for (const auto& topic : recording->foreign)
      std::cerr << file << ": warning: " << topic << " is of another contract and was left out\n";
  }
  const auto result =
      verification::difference(compared(a, arguments, false), compared(b, arguments, true), options);
  if (result.topics.empty())
    throw std::runtime_error("neither recording has any of the topics that are compared");
  std::cout << (common.json ? bus::text_of(verification::json_of(result), 2) + "\n"
                            : verification::text_of(result, arguments.a, arguments.b));
  return result.equal() ? 0 : 1;
}

int export_csv(const std::string& file, const std::string& topic, const std::string& output) {
  const auto handle = handle_of(topic);
  const auto recording = verification::load_recording(file, {handle});
  if (recording.messages.empty())
    throw std::runtime_error(file + ": no message of " + handle +
                             (recording.foreign.empty() ? "" : " of this program's contract") +
                             (recording.complete ? "" : "; " + recording.problem));
  if (output.empty()) {
    verification::write_csv(recording, *bus::find_topic(handle), std::cout);
  } else {
    std::ofstream out(output, std::ios::binary);
    verification::write_csv(recording, *bus::find_topic(handle), out);
    if (!out.flush()) throw std::runtime_error(output + ": cannot be written");
  }
  if (!recording.complete) std::cerr << file << ": warning: " << recording.problem << "\n";
  return 0;
}

}  // namespace

void add_recording_commands(CLI::App& app, Common& common) {
  auto file = std::make_shared<std::string>();
  auto* command =
      add_command(app, common, "info", "What a recording holds: topics, rates, cycles, gaps, versions",
                  [&common, file] { return info(common, *file); });
  command->add_option("file", *file, "Recording")->required();

  auto arguments = std::make_shared<DiffArguments>();
  command = add_command(app, common, "diff",
                        "Compare two recordings by cycle and field; status 0: equal, 1: different",
                        [&common, arguments] { return diff(common, *arguments); });
  command->add_option("a", arguments->a, "Recording")->required();
  command->add_option("b", arguments->b, "Recording")->required();
  command
      ->add_option("--topics", arguments->topics,
                   "Handles, separated by commas (default: the stream and what is published when it changes)")
      ->delimiter(',');
  command
      ->add_option(
          "--tolerance", arguments->tolerances,
          "Largest difference of numbers, or FIELD=NUMBER for fields that begin so (default: the same bits)")
      ->delimiter(',');
  command->add_flag("--common", arguments->common, "Leave out what only one of them has");
  auto* align = command->add_flag("--align", arguments->align,
                                  "Compare one run of a program of each, counted from its start");
  command->add_option("--runs", arguments->runs, "Which start of a program in a and in b (default: 1,1)")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::PositiveNumber)
      ->needs(align);
  command->add_option("--channel", arguments->channel, "Channel whose program is aligned")
      ->check(CLI::Range(0, 31))
      ->needs(align);

  auto topic = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  command = add_command(app, common, "export", "Write one topic of a recording as CSV",
                        [file, topic, output] { return export_csv(*file, *topic, *output); });
  command->add_option("file", *file, "Recording")->required();
  command->add_option("--csv", *topic, "Topic: name or handle")->required();
  command->add_option("--output", *output, "File to write (default: standard output)");
}

}  // namespace trunnion::cli
