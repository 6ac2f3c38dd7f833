// SPDX-License-Identifier: Apache-2.0
#include "access/certificate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace trunnion::access {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t noon = 1'795'435'200;  // 2026-11-23 12:00:00 UTC: 20780 days of 86400 s and 43200 s
constexpr std::int64_t one_day = 86400;

TEST(Certificate, HoldsForItsNamesAndDaysFromAnHourAgo) {
  const auto made = make_certificate({"mill-3", "mill-3.local", "192.168.7.20", "fe80::1"}, 825, noon);
  const auto facts = certificate_facts(made.certificate);
  EXPECT_THAT(facts.names, ElementsAre("mill-3", "mill-3.local", "192.168.7.20", "fe80::1"));
  EXPECT_EQ(facts.begins, noon - 3600);
  EXPECT_EQ(facts.ends, noon + 825 * one_day);
  EXPECT_EQ(day_text(noon), "2026-11-23");
  EXPECT_EQ(certificate_problem(made, noon), "");
}

TEST(Certificate, EveryOneHasAKeyAndFingerprintOfItsOwn) {
  const auto one = make_certificate({"mill"}, 1, noon), other = make_certificate({"mill"}, 1, noon);
  EXPECT_NE(one.key, other.key);
  EXPECT_NE(certificate_facts(one.certificate).fingerprint, certificate_facts(other.certificate).fingerprint);
}

TEST(Certificate, IsRefusedOutsideItsTimeAndWithAnotherKey) {
  const auto made = make_certificate({"mill"}, 10, noon), other = make_certificate({"mill"}, 10, noon);
  EXPECT_THAT(certificate_problem(made, noon - 3601), HasSubstr("does not hold before 2026-11-23"));
  EXPECT_EQ(certificate_problem(made, noon + 10 * one_day - 1), "");
  EXPECT_THAT(certificate_problem(made, noon + 10 * one_day), HasSubstr("has ended on 2026-12-03"));
  EXPECT_THAT(certificate_problem({made.certificate, other.key}, noon), HasSubstr("another certificate"));
  EXPECT_THAT(certificate_problem({made.certificate, ""}, noon), HasSubstr("no private key"));
  EXPECT_THAT(certificate_problem({made.certificate.substr(0, 200), made.key}, noon),
              HasSubstr("no certificate"));
}

TEST(Certificate, NamesAndDaysOutOfRangeAreRefused) {
  EXPECT_THROW(make_certificate({}, 10, noon), std::runtime_error);
  EXPECT_THROW(make_certificate(std::vector<std::string>(65, "mill"), 10, noon), std::runtime_error);
  for (const auto* name : {"", "mill 3", "mill,IP:1.2.3.4", "mill..local", ".mill", "mill\n"})
    EXPECT_THROW(make_certificate({name}, 10, noon), std::runtime_error) << name;
  EXPECT_THROW(make_certificate({"mill"}, 0, noon), std::runtime_error);
  EXPECT_THROW(make_certificate({"mill"}, 3651, noon), std::runtime_error);
}

TEST(Certificate, TheProgramOpensslReadsTheSame) {
  const auto file = testing::TempDir() + "/certificate_of_test.pem";
  const auto made = make_certificate({"mill-3", "192.168.7.20"}, 100, noon);
  std::ofstream(file) << made.certificate;
  const auto command = "openssl x509 -in " + file +
                       " -noout -text -fingerprint -sha256 2>&1; openssl verify -CAfile " + file +
                       " -purpose sslserver -attime " + std::to_string(noon) + " " + file + " 2>&1";
  std::string told;
  FILE* const pipe = popen(command.c_str(), "r");
  for (int c; (c = std::fgetc(pipe)) != EOF;) told += static_cast<char>(c);
  pclose(pipe);
  std::filesystem::remove(file);
  EXPECT_THAT(told, HasSubstr("DNS:mill-3, IP Address:192.168.7.20"));
  EXPECT_THAT(told, HasSubstr("CA:FALSE"));
  EXPECT_THAT(told, HasSubstr("TLS Web Server Authentication"));
  EXPECT_THAT(told, HasSubstr("ingerprint=" + certificate_facts(made.certificate).fingerprint));
  EXPECT_THAT(told, HasSubstr(": OK"));
}

}  // namespace
}  // namespace trunnion::access
