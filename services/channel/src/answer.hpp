// Why a channel refuses a request.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trunnion::channel {

/// A name of alarms.yaml, and the reason for the operator.
struct Refusal {
  const char* alarm = "request_invalid";
  std::string reason;
};

/// What the operator is answered.
struct Answer {
  bool accepted = true;
  std::uint32_t alarm = 0;
  std::string reason;
};

/// A number as an operator reads it: up to six digits, without trailing zeros.
std::string number_text(double value);

}  // namespace trunnion::channel
