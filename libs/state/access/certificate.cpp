// SPDX-License-Identifier: Apache-2.0
#include "access/certificate.hpp"

#include <arpa/inet.h>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>

namespace trunnion::access {
namespace {

template <auto free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Text = std::unique_ptr<BIO, Freed<BIO_free>>;
using Names = std::unique_ptr<GENERAL_NAMES, Freed<GENERAL_NAMES_free>>;

constexpr std::int64_t one_day = 86400, late_clock = 3600;  // s
constexpr std::size_t most_names = 64, longest_host_name = 253;

void demand(bool good) {
  if (!good) throw std::runtime_error("the certificate could not be made by OpenSSL");
}

Text reader(std::string_view text) {
  return Text(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

std::string content(BIO* written) {
  char* data = nullptr;
  const auto size = BIO_get_mem_data(written, &data);
  return {data, static_cast<std::size_t>(size)};
}

/// Of a key with a password there is none: nobody could enter it.
int no_password(char*, int, int, void*) { return 0; }

Certificate certificate_of(std::string_view text) {
  return Certificate(PEM_read_bio_X509(reader(text).get(), nullptr, no_password, nullptr));
}

Key key_of(std::string_view text) {
  return Key(PEM_read_bio_PrivateKey(reader(text).get(), nullptr, no_password, nullptr));
}

bool is_address_text(const std::string& name) {
  std::array<unsigned char, 16> bytes{};
  return inet_pton(AF_INET, name.c_str(), bytes.data()) == 1 ||
         inet_pton(AF_INET6, name.c_str(), bytes.data()) == 1;
}

/// Labels of letters, digits and hyphens (RFC 1123, 2.1), with which no other field of the certificate can be
/// written.
bool is_host_name(const std::string& name) {
  if (name.empty() || name.size() > longest_host_name || name.front() == '.' || name.back() == '.')
    return false;
  return name.find("..") == std::string::npos && std::ranges::all_of(name, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_';
         });
}

std::int64_t seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? static_cast<std::int64_t>(timegm(&parts)) : 0;
}

void extend(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  demand(extension && X509_add_ext(certificate, extension.get(), -1) == 1);
}

std::string alternative_names(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    if (!text.empty()) text += ',';
    text.append(is_address_text(name) ? "IP:" : "DNS:").append(name);
  }
  return text;
}

std::string name_text(const GENERAL_NAME* name) {
  int kind = 0;
  const auto* value = static_cast<const ASN1_STRING*>(GENERAL_NAME_get0_value(name, &kind));
  if (kind != GEN_DNS && kind != GEN_IPADD) return {};
  const auto* data = ASN1_STRING_get0_data(value);
  const auto size = static_cast<std::size_t>(ASN1_STRING_length(value));
  if (kind == GEN_DNS) return {reinterpret_cast<const char*>(data), size};
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (size != 4 && size != 16) return {};
  inet_ntop(size == 4 ? AF_INET : AF_INET6, data, text.data(), text.size());
  return text.data();
}

}  // namespace

CertificatePair make_certificate(const std::vector<std::string>& names, int days, std::int64_t now) {
  if (names.empty() || names.size() > most_names)
    throw std::runtime_error("a certificate has 1 to " + std::to_string(most_names) + " names");
  for (const auto& name : names)
    if (!is_address_text(name) && !is_host_name(name))
      throw std::runtime_error("'" + name + "' is neither a computer's name nor an address");
  if (days < 1 || days > longest_certificate)
    throw std::runtime_error("a certificate holds for 1 to " + std::to_string(longest_certificate) + " days");

  const Key key(EVP_EC_gen("P-256"));
  const Certificate certificate(X509_new());
  demand(key && certificate);
  std::array<unsigned char, 16> serial{};
  demand(RAND_bytes(serial.data(), static_cast<int>(serial.size())) == 1);
  serial[0] = static_cast<unsigned char>((serial[0] & 0x3f) | 0x40);  // positive (RFC 5280, 4.1.2.2)
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(
      BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr));
  auto* made = certificate.get();
  demand(number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(made)) != nullptr);
  demand(X509_set_version(made, X509_VERSION_3) == 1 && X509_set_pubkey(made, key.get()) == 1 &&
         ASN1_TIME_set(X509_getm_notBefore(made), now - late_clock) != nullptr &&
         ASN1_TIME_set(X509_getm_notAfter(made), now + days * one_day) != nullptr);
  auto* subject = X509_get_subject_name(made);
  // A common name has at most 64 characters (RFC 5280, appendix A); the names below are what counts.
  const auto common = names.front().substr(0, 64);
  demand(X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8,
                                    reinterpret_cast<const unsigned char*>(common.c_str()), -1, -1, 0) == 1 &&
         X509_set_issuer_name(made, subject) == 1);
  extend(made, NID_subject_alt_name, alternative_names(names));
  // Who trusts it trusts no other certificate by it.
  extend(made, NID_basic_constraints, "critical,CA:FALSE");
  extend(made, NID_key_usage, "critical,digitalSignature");
  extend(made, NID_ext_key_usage, "serverAuth");
  extend(made, NID_subject_key_identifier, "hash");
  demand(X509_sign(made, key.get(), EVP_sha256()) > 0);

  const Text certificate_text(BIO_new(BIO_s_mem())), key_text(BIO_new(BIO_s_mem()));
  demand(certificate_text && key_text && PEM_write_bio_X509(certificate_text.get(), made) == 1 &&
         PEM_write_bio_PKCS8PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) ==
             1);
  return {content(certificate_text.get()), content(key_text.get())};
}

CertificateFacts certificate_facts(std::string_view text) {
  const auto certificate = certificate_of(text);
  if (!certificate) throw std::runtime_error("there is no certificate in PEM form");
  CertificateFacts facts;
  facts.begins = seconds_of(X509_get0_notBefore(certificate.get()));
  facts.ends = seconds_of(X509_get0_notAfter(certificate.get()));
  const Names names(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate.get(), NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i)
    if (auto name = name_text(sk_GENERAL_NAME_value(names.get(), i)); !name.empty())
      facts.names.push_back(std::move(name));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size);
  for (unsigned i = 0; i < size; ++i) {
    std::array<char, 4> part{};
    std::snprintf(part.data(), part.size(), i == 0 ? "%02X" : ":%02X", digest[i]);
    facts.fingerprint += part.data();
  }
  return facts;
}

std::string certificate_problem(const CertificatePair& pair, std::int64_t now) {
  const auto certificate = certificate_of(pair.certificate);
  if (!certificate) return "there is no certificate in PEM form";
  const auto key = key_of(pair.key);
  if (!key) return "there is no private key in PEM form without a password";
  if (X509_check_private_key(certificate.get(), key.get()) != 1)
    return "the key is that of another certificate";
  const auto begins = seconds_of(X509_get0_notBefore(certificate.get()));
  const auto ends = seconds_of(X509_get0_notAfter(certificate.get()));
  if (now < begins) return "the certificate does not hold before " + day_text(begins);
  if (now >= ends) return "the certificate has ended on " + day_text(ends);
  return {};
}

std::string day_text(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
  return text.data();
}

}  // namespace trunnion::access
