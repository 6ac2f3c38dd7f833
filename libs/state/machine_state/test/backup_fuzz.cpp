// SPDX-License-Identifier: Apache-2.0
// Any bytes as a backup, and as a kept text: they are taken, and written back the same, or refused.
#include <cstdlib>
#include <stdexcept>

#include "machine_state/backup.hpp"
#include "machine_state/index_file.hpp"
#include "storage/kept_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::string problem;
  if (const auto kept = storage::unseal("f", bytes, problem); kept && kept->content.size() >= bytes.size())
    std::abort();
  if (storage::unseal("f", storage::seal("f", 1, bytes), problem)->content != bytes) std::abort();
  storage::decide("f", bytes, bytes.substr(0, size / 2), false);
  try {
    const auto backup = machine_state::read_backup(bytes);
    const auto again = machine_state::read_backup(machine_state::write_backup(backup));
    if (again.files != backup.files || again.configuration != backup.configuration) std::abort();
  } catch (const std::runtime_error&) {
  }
  try {
    machine_state::read_index(bytes);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
