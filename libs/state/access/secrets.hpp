// SPDX-License-Identifier: Apache-2.0
// Passwords and random secrets.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::access {

/// Argon2id (RFC 9106) with 3 passes over 64 MiB and a random salt, in the encoded form $argon2id$v=19$...
/// Takes some tenths of a second. Throws std::runtime_error when there is no memory.
std::string hash_password(std::string_view password);
/// Whether `hash` was made of `password`; false also when it is no hash.
bool is_password(std::string_view password, const std::string& hash);

/// `bytes` random bytes of the system in hexadecimal. Throws std::runtime_error when it gives none.
std::string random_secret(std::size_t bytes = 32);
/// SHA-256 in hexadecimal: for secrets that are random and need no slow hash.
std::string digest(std::string_view secret);

}  // namespace trunnion::access
