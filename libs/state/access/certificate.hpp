// SPDX-License-Identifier: Apache-2.0
// The certificate by which browsers and programs know the gateway (X.509, RFC 5280).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::access {

/// Of the state directory, unless machine.yaml names others.
inline constexpr const char* certificate_file = "certificate.pem";
inline constexpr const char* certificate_key_file = "certificate.key";

inline constexpr int longest_certificate = 3650;  // days

/// PEM texts.
struct CertificatePair {
  std::string certificate, key;
};

/// A certificate signed by its own key (ECDSA P-256, SHA-256) for `names` of computers and addresses (IPv4,
/// IPv6), the first of which is its subject. It holds from an hour before `now` (seconds since 1970, UTC),
/// for clocks that are late, to `days` after it. Throws std::runtime_error for a name that is neither, no
/// names, more than 64 of them, and days outside 1 .. longest_certificate.
CertificatePair make_certificate(const std::vector<std::string>& names, int days, std::int64_t now);

struct CertificateFacts {
  std::vector<std::string> names;     ///< that it is for
  std::int64_t begins = 0, ends = 0;  ///< seconds since 1970, UTC
  std::string fingerprint;            ///< SHA-256, as browsers show it: AB:CD:...
};

/// What the first certificate of a PEM text says. Throws std::runtime_error when there is none.
CertificateFacts certificate_facts(std::string_view certificate);

/// Why a gateway cannot be reached with this pair at `now`: no certificate, no key, a key of another
/// certificate, not valid yet, or not any more. Empty when it can.
std::string certificate_problem(const CertificatePair& pair, std::int64_t now);

/// A day as 2026-11-23, UTC.
std::string day_text(std::int64_t seconds);

}  // namespace trunnion::access
