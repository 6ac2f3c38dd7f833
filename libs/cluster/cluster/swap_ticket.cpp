// SPDX-License-Identifier: Apache-2.0
#include "cluster/swap_ticket.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include "bus/json.hpp"

namespace trunnion::cluster {
namespace fs = std::filesystem;
namespace {

// Without what identifies one message of it.
std::string text_of(SwapRequest request) {
  request.client = request.number = 0;
  return bus::text_of(bus::to_json(request)) + "\n";
}

std::string path_of(const std::string& run_directory, const std::string& token) {
  return run_directory + "/swap-" + token + ".request";
}

bool is_token(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Why its content may be another user's; empty when it is not.
std::string refused_owner(const fs::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return path.string() + ": " + std::strerror(errno);
  if (status.st_uid != geteuid() && status.st_uid != 0)
    return path.string() + " belongs to another user than the launcher's";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) return path.string() + " is writable for other users";
  return "";
}

}  // namespace

void put_ticket(const std::string& run_directory, SwapRequest& request) {
  std::random_device random;
  char token[33];
  std::snprintf(token, sizeof token, "%08x%08x%08x%08x", random(), random(), random(), random());
  request.token = token;
  const auto path = path_of(run_directory, request.token);
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const auto text = text_of(request);
  const bool written =
      file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (file >= 0) close(file);
  if (!written) throw std::runtime_error(path + ": cannot be written: " + std::strerror(reason));
}

std::string take_ticket(const std::string& run_directory, const SwapRequest& request) {
  const std::string refusal = "the request does not come from the launcher's user on this host";
  if (!is_token(request.token)) return refusal;
  const auto path = path_of(run_directory, request.token);
  if (!refused_owner(path).empty()) return refusal;
  std::string text;
  {
    std::ifstream in(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  unlink(path.c_str());
  return text == text_of(request) ? "" : "the request is not the one that was written into the run directory";
}

std::string refused_executable(const std::string& executable, const std::vector<std::string>& directories) {
  std::error_code error;
  const auto file = fs::canonical(executable, error);
  if (error) return executable + ": " + error.message();
  std::string allowed;
  for (const auto& directory : directories) {
    allowed += (allowed.empty() ? "" : ", ") + directory;
    const auto root = fs::canonical(directory, error);
    if (error) continue;
    const auto inside = fs::relative(file, root, error);
    if (error || inside.empty() || *inside.begin() == "..") continue;
    auto path = root;
    if (auto why = refused_owner(path); !why.empty()) return why;
    for (const auto& part : inside) {
      path /= part;
      if (auto why = refused_owner(path); !why.empty()) return why;
    }
    return "";
  }
  return executable + " is in none of the directories that 'swap_directories' of machine.yaml allows (" +
         allowed + ")";
}

}  // namespace trunnion::cluster
