// SPDX-License-Identifier: Apache-2.0
// Texts of the state directory with a last line that proves them whole: name, format version, generation,
// checksum. Pure: what is on the disk comes in, what is to be used comes out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::storage {

/// How much of a kept file can be used.
enum class KeptState {
  absent,    ///< neither the file nor its previous generation is there: the machine is new
  good,      ///< the newest generation
  previous,  ///< the newest generation is damaged or missing; the one before is used
  unusable   ///< there was a file, and nothing of it can be used
};

/// What reading a kept file has given.
struct Kept {
  KeptState state = KeptState::absent;
  std::string content;           ///< of `good` and `previous`, without the last line that proves it
  std::uint64_t generation = 0;  ///< of the content; 0: written before files had generations
  std::string problem;           ///< of `previous` and `unusable`: what is wrong, without the file's name
};

/// The first format whose files have this last line. A file without one, and without a previous generation
/// beside it, is of format 0 and is taken as it is.
inline constexpr unsigned kept_format = 1;
/// Behind the name of a file: its previous generation.
inline constexpr const char* previous_suffix = ".previous";
/// Behind the name of a file: put aside because it is damaged.
inline constexpr const char* damaged_suffix = ".damaged";

/// `content` with its last line; `name` is the file's name without directory. Text that does not end with a
/// line end gets one, which unseal() removes again.
std::string seal(std::string_view name, std::uint64_t generation, std::string_view content);

struct Unsealed {
  std::string content;
  std::uint64_t generation = 0;
};
/// The content of a text that seal() made; otherwise nothing, and `problem` says what is wrong.
std::optional<Unsealed> unseal(std::string_view name, std::string_view text, std::string& problem);

/// Decides which generation is used. `newest` and `previous` are the bytes of the two files, if they are
/// there. `interrupted`: the process ended while it replaced the file (a temporary file is still there).
Kept decide(std::string_view name, const std::optional<std::string>& newest,
            const std::optional<std::string>& previous, bool interrupted);

}  // namespace trunnion::storage
