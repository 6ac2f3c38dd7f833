// SPDX-License-Identifier: Apache-2.0
// The certificate of the gateway while it runs: renewed files are used without a restart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace trunnion::gateway {

/// PEM files; empty = no TLS.
struct TlsFiles {
  std::filesystem::path certificate, key;
  bool on() const { return !certificate.empty(); }
};

/// May be used by several threads.
class TlsCertificate {
 public:
  /// Reads both files. Throws std::runtime_error with file and reason in one line.
  explicit TlsCertificate(TlsFiles files);

  /// Of connections from now on.
  std::shared_ptr<boost::asio::ssl::context> context() const;
  /// Reads the files again when one of them has changed. What cannot be used is in refused(), and the pair
  /// from before stays.
  void refresh();

  /// Why the files, as they are now, are not used; empty when they are.
  std::string refused() const;
  /// What an operator is told from 30 days before the end of the pair in use, at `now` (seconds since 1970),
  /// else empty.
  std::string ending(std::int64_t now) const;

 private:
  struct Loaded;
  Loaded load() const;
  const TlsFiles files_;
  mutable std::mutex mutex_;
  std::shared_ptr<boost::asio::ssl::context> context_;
  std::int64_t ends_ = 0;
  std::string refused_;
  std::pair<std::filesystem::file_time_type, std::filesystem::file_time_type> read_;
};

}  // namespace trunnion::gateway
