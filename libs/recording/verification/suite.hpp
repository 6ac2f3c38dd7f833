// SPDX-License-Identifier: Apache-2.0
// A list of verifications as YAML: which services of which recordings, with which executables, tolerances and
// required features. No DDS, no clock.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace trunnion::verification {

/// One item of `tests`: some services of one recording.
struct SuiteEntry {
  std::string recording;                           ///< path
  std::string machine;                             ///< name or directory; empty: the one the recording names
  std::string vendor;                              ///< empty: the default of `verify`
  std::vector<std::string> services;               ///< empty: all of the machine
  std::map<std::string, std::string> executables;  ///< by service
  /// Largest difference of numbers by the beginning of the field's name; "" is that of all fields.
  std::map<std::string, double> tolerances;
  std::map<std::string, std::vector<std::string>> required;  ///< features by service; "all" is every one
  std::string place;                                         ///< "file:line:column: error: " of the item
};

struct Suite {
  std::string title;
  double timeout = 20;  ///< s without an answer after which a service has failed
  std::vector<SuiteEntry> entries;
};

/// Relative paths count from the directory of `file`. Throws std::runtime_error, beginning with
/// file:line:column.
Suite parse_suite(const std::string& text, const std::string& file);

/// One process of the machine of a recording.
struct VerifiedProcess {
  std::string service;
  std::uint16_t channel = 0;  ///< of a channel
};

/// One verification.
struct SuiteTest {
  std::size_t entry = 0;  ///< of Suite::entries
  VerifiedProcess process;
  std::string name;  ///< "kinematics", "channel 1"
};

/// Every verification of the suite, in its order. `processes_of` gives those of an entry's machine. Throws
/// std::runtime_error for a service that the machine does not have.
std::vector<SuiteTest> tests_of(
    const Suite& suite, const std::function<std::vector<VerifiedProcess>(const SuiteEntry&)>& processes_of);

/// The arguments of `trunnion verify` for a test, without the program.
std::vector<std::string> verify_arguments(const Suite& suite, const SuiteTest& test);

}  // namespace trunnion::verification
