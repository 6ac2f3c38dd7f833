// DDS Security: who has the right certificate takes part, who has not neither writes nor reads. Every
// participant is a process of its own, as in a cluster.
#include <array>
#include <cstdio>
#include <future>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

/// Certificates of an authority of its own, made once for a process.
class Authority {
 public:
  explicit Authority(const std::string& name)
      : directory_(fs::temp_directory_path() / ("trunnion-" + name + "-" + std::to_string(getpid()))) {
    fs::remove_all(directory_);
    const auto made = output_of(std::string(TRUNNION_SECURITY) + "/make_certificates.sh " + path());
    EXPECT_NE(made.find("22 identities"), std::string::npos) << made;
  }
  ~Authority() { fs::remove_all(directory_); }
  Authority(const Authority&) = delete;
  Authority& operator=(const Authority&) = delete;
  std::string path() const { return directory_.string(); }

 private:
  fs::path directory_;
};

struct Peer {
  std::string vendor, identity, security;
};

/// What a peer did: how many others it found and how many samples it wrote or got, or why it was refused.
struct Result {
  int matched = 0, samples = 0;
  std::string text;
};

std::future<Result> start(const Peer& peer, const std::string& action, std::uint32_t domain,
                          double seconds = 4, const std::string& topic = "path_frame") {
  const std::string command =
      deploy::binary_directory() + "/security-peer --domain " + std::to_string(domain) + " --vendor " +
      peer.vendor + " --seconds " + std::to_string(seconds) +
      (peer.security.empty() ? "" : " --security " + peer.security + " --identity " + peer.identity) + " " +
      action + " " + topic;
  return std::async(std::launch::async, [command] {
    Result result;
    result.text = output_of(command);
    const auto at = result.text.rfind("matched ");
    if (at != std::string::npos)
      std::sscanf(result.text.c_str() + at, "matched %d samples %d", &result.matched, &result.samples);
    return result;
  });
}

struct Pair {
  const char *writer, *reader;
};

class Security : public testing::TestWithParam<Pair> {
 protected:
  static void SetUpTestSuite() {
    authority_ = std::make_unique<Authority>("security");
    others_ = std::make_unique<Authority>("rogue");
  }
  ~Security() override { deploy::RunDirectory{domain}.remove(); }
  static void TearDownTestSuite() { authority_.reset(), others_.reset(); }
  std::string writer_vendor() const { return GetParam().writer; }
  std::string reader_vendor() const { return GetParam().reader; }
  Peer kinematics() const { return {reader_vendor(), "kinematics", authority_->path()}; }
  Peer channel() const { return {writer_vendor(), "channel", authority_->path()}; }
  static std::unique_ptr<Authority> authority_, others_;
  const std::uint32_t domain = deploy::free_domain();
};
std::unique_ptr<Authority> Security::authority_, Security::others_;

TEST_P(Security, TheChannelWritesThePathToTheKinematics) {
  auto reader = start(kinematics(), "read", domain);
  auto writer = start(channel(), "write", domain);
  const auto got = reader.get(), sent = writer.get();
  EXPECT_EQ(got.matched, 1) << got.text;
  EXPECT_EQ(sent.matched, 1) << sent.text;
  EXPECT_GT(got.samples, 20);
}

TEST_P(Security, WhoHasNoCertificateNeitherWritesNorReads) {
  auto reader = start(kinematics(), "read", domain);
  auto rogue = start({writer_vendor(), "", ""}, "write", domain);
  auto got = reader.get();
  auto tried = rogue.get();
  EXPECT_GT(tried.samples, 20) << "it did write: " << tried.text;
  EXPECT_EQ(got.matched, 0) << got.text;
  EXPECT_EQ(got.samples, 0);

  auto spy = start({reader_vendor(), "", ""}, "read", domain);
  auto writer = start(channel(), "write", domain);
  got = spy.get();
  tried = writer.get();
  EXPECT_GT(tried.samples, 20);
  EXPECT_EQ(tried.matched, 0) << tried.text;
  EXPECT_EQ(got.samples, 0) << got.text;
}

TEST_P(Security, WhoseCertificateIsOfAnotherAuthorityNeitherWritesNorReads) {
  auto reader = start(kinematics(), "read", domain);
  auto rogue = start({writer_vendor(), "channel", others_->path()}, "write", domain);
  auto got = reader.get();
  auto tried = rogue.get();
  EXPECT_GT(tried.samples, 20) << "it did write: " << tried.text;
  EXPECT_EQ(got.matched, 0) << got.text;
  EXPECT_EQ(got.samples, 0);

  auto spy = start({reader_vendor(), "kinematics", others_->path()}, "read", domain);
  auto writer = start(channel(), "write", domain);
  EXPECT_EQ(spy.get().samples, 0);
  EXPECT_EQ(writer.get().matched, 0);
}

TEST_P(Security, AServiceWithTheRightsOfAnotherNeitherWritesNorReads) {
  auto reader = start(kinematics(), "read", domain);
  auto program = start({writer_vendor(), "program", authority_->path()}, "write", domain);
  auto got = reader.get();
  EXPECT_EQ(program.get().matched, 0);
  EXPECT_EQ(got.matched, 0) << got.text;
  EXPECT_EQ(got.samples, 0) << "only the channel may write path frames";

  auto spy = start({reader_vendor(), "program", authority_->path()}, "read", domain);
  auto writer = start(channel(), "write", domain);
  EXPECT_EQ(spy.get().samples, 0) << "path frames are not for the program service";
  EXPECT_EQ(writer.get().matched, 0);
}

TEST_P(Security, PermissionsOfAnotherServiceDoNotGoWithOnesCertificate) {
  const Authority stolen("stolen");
  for (const auto* file : {"ca.pem", "governance.p7s"})
    fs::copy(authority_->path() + "/" + file, stolen.path() + "/" + file,
             fs::copy_options::overwrite_existing);
  const auto own = "/program-" + writer_vendor() + "/", others = "/channel-" + writer_vendor() + "/";
  for (const auto* file : {"certificate.pem", "key.pem"})
    fs::copy(authority_->path() + own + file, stolen.path() + own + file,
             fs::copy_options::overwrite_existing);
  fs::copy(authority_->path() + others + "permissions.p7s", stolen.path() + own + "permissions.p7s",
           fs::copy_options::overwrite_existing);
  auto reader = start(kinematics(), "read", domain);
  auto program = start({writer_vendor(), "program", stolen.path()}, "write", domain);
  const auto got = reader.get();
  EXPECT_EQ(program.get().matched, 0);
  EXPECT_EQ(got.matched, 0) << got.text;
  EXPECT_EQ(got.samples, 0);
}

INSTANTIATE_TEST_SUITE_P(Vendors, Security,
                         testing::Values(Pair{"cyclonedds", "cyclonedds"}, Pair{"fastdds", "fastdds"},
                                         Pair{"cyclonedds", "fastdds"}, Pair{"fastdds", "cyclonedds"}),
                         [](const auto& pair) {
                           return std::string(pair.param.writer) + "_to_" + pair.param.reader;
                         });

class SecureCluster : public testing::TestWithParam<const char*> {};

TEST_P(SecureCluster, RunsAProgramWhileARogueNeitherReadsNorWritesSetpoints) {
  const Authority authority("cluster");
  const auto directory = fs::temp_directory_path() / ("trunnion-secure-" + std::to_string(getpid()));
  fs::remove_all(directory);
  fs::copy(deploy::find_machine("ac-table"), directory, fs::copy_options::recursive);
  std::ofstream(directory / "machine.yaml", std::ios::app) << "security: " << authority.path() << "\n";
  {
    Cluster cluster(directory.string(), Time::virtual_, GetParam());
    const auto domain = cluster.running().run.domain;
    const std::string vendor = GetParam(), rogue_vendor = vendor == "mixed" ? "cyclonedds" : vendor;
    auto spy = start({rogue_vendor, "", ""}, "read", domain, 4, "gantry_frame");
    // Not the same topic: the two would talk to each other.
    auto rogue = start({rogue_vendor, "", ""}, "write", domain, 4, "path_frame");
    std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
    for (int i = 0; i < 20; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
    cluster.start_text(text + "X0 Y0 A0 C0\nG49\nM30\n");
    ASSERT_TRUE(cluster.finish()) << cluster.told();
    EXPECT_EQ(cluster.lost_frames, 0u);
    const auto read = spy.get(), written = rogue.get();
    EXPECT_EQ(read.samples, 0) << read.text;
    EXPECT_GT(written.samples, 20) << written.text;
    EXPECT_EQ(written.matched, 0) << "nobody listened";
    EXPECT_FALSE(cluster.has_alarm(103)) << "a foreign frame would differ from ours";
    EXPECT_EQ(cluster.active_alarms(), "");
  }
  fs::remove_all(directory);
}

INSTANTIATE_TEST_SUITE_P(Vendors, SecureCluster, testing::Values("cyclonedds", "fastdds", "mixed"),
                         [](const auto& vendor) { return std::string(vendor.param); });

}  // namespace
}  // namespace trunnion::integration
