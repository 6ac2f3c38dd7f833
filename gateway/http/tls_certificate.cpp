// SPDX-License-Identifier: Apache-2.0
#include "http/tls_certificate.hpp"

#include <openssl/ssl.h>
#include <sys/stat.h>

#include <boost/asio/ssl/context.hpp>
#include <boost/system/system_error.hpp>
#include <ctime>
#include <stdexcept>

#include "access/certificate.hpp"
#include "machine/yaml.hpp"

namespace trunnion::gateway {

namespace ssl = boost::asio::ssl;

namespace {

constexpr std::int64_t warned = 30 * 86400;  // s before the end

std::filesystem::file_time_type changed(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::last_write_time(file, error);
}

std::shared_ptr<ssl::context> context_of(const access::CertificatePair& pair) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  auto* native = context->native_handle();
  // RFC 9325, 3.1 and 4.2: TLS 1.2 and 1.3, forward secrecy and authenticated encryption.
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(native, "ECDHE+AESGCM:ECDHE+CHACHA20");
  SSL_CTX_set_options(native,
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_NO_COMPRESSION);
  context->use_certificate_chain(boost::asio::buffer(pair.certificate));
  context->use_private_key(boost::asio::buffer(pair.key), ssl::context::pem);
  return context;
}

}  // namespace

struct TlsCertificate::Loaded {
  std::shared_ptr<ssl::context> context;
  std::int64_t ends;
};

TlsCertificate::TlsCertificate(TlsFiles files) : files_(std::move(files)) {
  read_ = {changed(files_.certificate), changed(files_.key)};
  const auto loaded = load();
  context_ = loaded.context, ends_ = loaded.ends;
}

TlsCertificate::Loaded TlsCertificate::load() const {
  const auto readable = [](const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
      throw std::runtime_error(file.string() +
                               ": there is no such file: make it with 'trunnion certificate MACHINE'");
    return machine::read_text(file.string());
  };
  const access::CertificatePair pair{readable(files_.certificate), readable(files_.key)};
  struct stat status {};
  if (::stat(files_.key.c_str(), &status) == 0 && (status.st_mode & 027) != 0)
    throw std::runtime_error(files_.key.string() +
                             ": others can read or change this key: set its mode to 0600");
  if (const auto problem = access::certificate_problem(pair, std::time(nullptr)); !problem.empty())
    throw std::runtime_error(files_.certificate.string() + ", " + files_.key.string() + ": " + problem);
  try {
    return {context_of(pair), access::certificate_facts(pair.certificate).ends};
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(files_.certificate.string() + ": OpenSSL refuses it: " + error.code().message());
  }
}

std::shared_ptr<ssl::context> TlsCertificate::context() const {
  const std::lock_guard lock(mutex_);
  return context_;
}

void TlsCertificate::refresh() {
  const std::pair now{changed(files_.certificate), changed(files_.key)};
  {
    const std::lock_guard lock(mutex_);
    if (now == read_) return;
    read_ = now;
  }
  try {
    const auto loaded = load();
    const std::lock_guard lock(mutex_);
    context_ = loaded.context, ends_ = loaded.ends;
    refused_.clear();
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    refused_ = error.what();
  }
}

std::string TlsCertificate::refused() const {
  const std::lock_guard lock(mutex_);
  return refused_;
}

std::string TlsCertificate::ending(std::int64_t now) const {
  const std::lock_guard lock(mutex_);
  if (ends_ - now > warned) return {};
  return files_.certificate.string() + (now < ends_ ? " ends on " : " has ended on ") +
         access::day_text(ends_);
}

}  // namespace trunnion::gateway
