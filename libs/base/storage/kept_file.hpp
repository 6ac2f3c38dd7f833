// SPDX-License-Identifier: Apache-2.0
// Kept texts on the disk: written so that a crash at any instant leaves a whole generation, the one before is
// kept, and damage is found when they are read.
#pragma once

#include <string>

#include "storage/kept_text.hpp"

namespace trunnion::storage {

/// Reads `path` and its previous generation; writes nothing. Throws StorageError when a file that is there
/// cannot be read.
Kept read_kept(const std::string& path);

/// The first half of write_kept(): the new generation as a temporary file, on the disk. Throws StorageError,
/// and nothing is left then.
void prepare_kept(const std::string& path, const std::string& content);
/// The second half: the file becomes its previous generation, the temporary file the newest. A file that is
/// damaged is put aside instead (damaged_suffix). It lasts once the directory is synchronized. Throws
/// StorageError.
void publish_kept(const std::string& path);
/// Takes prepare_kept() back.
void discard_kept(const std::string& path);
/// Makes `content` the newest generation, and returns when it is on the disk. Throws StorageError.
void write_kept(const std::string& path, const std::string& content);

/// For the owner of a file that was read as KeptState::previous: puts the damaged file aside and writes its
/// content as the newest generation. Throws StorageError.
void repair_kept(const std::string& path, const Kept& kept);

/// One line for an alarm: file, what is wrong, what is used or lost, what to do. `loss` names what the file
/// has, for example "parameters". Of `previous` and `unusable`.
std::string damage_text(const std::string& path, const Kept& kept, const std::string& loss);

}  // namespace trunnion::storage
