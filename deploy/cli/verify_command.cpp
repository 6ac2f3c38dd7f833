// SPDX-License-Identifier: Apache-2.0
// verify: one service against a recording
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "commands.hpp"
#include "verification/verify.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::cli {
namespace {

int verify_service(const Common& common, verification::VerifyOptions options,
                   const std::vector<std::string>& tolerances, const std::vector<std::string>& required) {
  options.domain = common.domain;
  for (const auto& text : tolerances) verification::add_tolerance(options.comparison, text);
  const auto result = verification::verify(options);
  const auto missing = verification::missing(result.features, required);
  const int status = result.equal() && missing.empty() ? 0 : 1;
  if (common.json) {
    auto json = verification::json_of(result.difference);
    json["equal"] = result.equal();
    json["problem"] = result.problem;
    json["parameters"] = result.parameters;
    json["cut_off"] = result.cut_off;
    json["not_compared"] = result.not_compared;
    json["inputs"] = result.inputs;
    json["outputs"] = result.outputs;
    json["unrecorded"] = result.unrecorded;
    json["requests"] = result.requests;
    json["left_out"] = result.left_out;
    json["samples"] = result.samples;
    json["cycles"] = result.cycles;
    json["seconds"] = result.seconds;
    json["times_real_time"] = result.times_real_time;
    for (const auto& feature : result.features) json["features"][feature.name] = feature.seen;
    json["missing"] = missing;
    std::cout << bus::text_of(json, 2) << "\n";
    return status;
  }
  std::cout << verification::text_of(result.difference, "recorded", "written now");
  if (!result.parameters.empty()) std::cout << "parameters: " << result.parameters << "\n";
  if (!result.not_compared.empty()) std::cout << "not compared: " << result.not_compared << "\n";
  if (!result.problem.empty()) std::cout << "problem: " << result.problem << "\n";
  if (!result.cut_off.empty()) std::printf("verified as far as it goes: %s\n", result.cut_off.c_str());
  std::printf("%s: %s; %zu messages in, %zu out", options.service.c_str(),
              result.equal() ? "as recorded" : "NOT as recorded", result.inputs, result.outputs);
  if (result.samples > 0)
    std::printf(", %zu requests over HTTP, %zu comparisons of the state", result.requests, result.samples);
  if (result.left_out > 0) std::printf(", %zu requests left out", result.left_out);
  if (result.cycles > 0 && result.seconds > 0)
    std::printf(", %llu cycles in %.3f s, %.0f times real time",
                static_cast<unsigned long long>(result.cycles), result.seconds, result.times_real_time);
  std::printf("\n");
  if (!result.features.empty())
    std::printf("%s: %s\n", options.service.c_str(), text_of(result.features).c_str());
  for (const auto& name : missing) std::printf("required, and not in the recording: %s\n", name.c_str());
  return status;
}

// In JSON it is told apart from a failure, unless features are required: those are not in the recording.
int run_verification(const Common& common, const verification::VerifyOptions& options,
                     const std::vector<std::string>& tolerances, const std::vector<std::string>& required) {
  try {
    return verify_service(common, options, tolerances, required);
  } catch (const verification::NothingToVerify& nothing) {
    if (!common.json || !required.empty()) throw;
    std::cout << bus::text_of({{"equal", false}, {"skipped", nothing.what()}}, 2) << "\n";
    return 1;
  }
}

}  // namespace

void add_verify_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<verification::VerifyOptions>();
  auto tolerances = std::make_shared<std::vector<std::string>>();
  auto required = std::make_shared<std::vector<std::string>>();
  auto* command =
      add_command(app, common, "verify",
                  "Start one service alone, feed it what a recording says was sent to it, compare "
                  "what it writes; status 0: equal",
                  [&common, options, tolerances, required] {
                    return run_verification(common, *options, *tolerances, *required);
                  });
  command->add_option("--service", options->service, "Service, as in machine.yaml")->required();
  command->add_option("--recording", options->recording, "Recording")->required()->check(CLI::ExistingFile);
  command->add_option("--exec", options->executable, "Executable to verify (default: the one of this build)");
  command->add_option("--vendor", options->vendor, "DDS vendor of the service")
      ->check(CLI::IsMember({"fastdds", "cyclonedds"}));
  command->add_option(
      "--machine", options->machine,
      "Name or directory of the machine with its programs (default: the one the recording names); "
      "parameters are the recording's");
  command->add_flag("--machine-parameters", options->machine_parameters,
                    "Use the parameters of the machine's directory instead of the recording's");
  command->add_option("--channel", options->channel, "Which channel, for --service channel")
      ->check(CLI::Range(0, 31));
  command
      ->add_option(
          "--tolerance", *tolerances,
          "Largest difference of numbers, or FIELD=NUMBER for fields that begin so (default: the same bits)")
      ->delimiter(',');
  command
      ->add_option("--require", *required,
                   "Features that the recording must exercise, separated by commas, or all: else status 1")
      ->delimiter(',');
  command
      ->add_option("--around", options->comparison.around,
                   "Rows before and after the first difference in the JSON")
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--timeout,--patience", options->timeout,
                   "Seconds without an answer after which it has failed")
      ->check(CLI::PositiveNumber);
}

}  // namespace trunnion::cli
