// SPDX-License-Identifier: Apache-2.0
// Any text: users that are written and read back as they are, or one line that names the file.
#include <cstdlib>
#include <stdexcept>

#include "access/user_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::access;
  try {
    const auto users = parse_users({reinterpret_cast<const char*>(data), size}, "users.json");
    const auto text = text_of(users);
    if (text_of(parse_users(text, "users.json")) != text) std::abort();
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).rfind("users.json: error: ", 0) != 0) std::abort();
  }
  return 0;
}
