// SPDX-License-Identifier: Apache-2.0
#include "core/static_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace trunnion::gateway {
namespace {

namespace fs = std::filesystem;

class StaticFiles : public testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::temp_directory_path() / ("trunnion_static_" + std::to_string(getpid()));
    fs::remove_all(top_);
    fs::create_directories(top_ / "page" / "assets");
    for (const auto* name :
         {"page/index.html", "page/assets/a.js", "page/.secret", "outside.txt", "page/a b.css"})
      std::ofstream(top_ / name) << name;
    fs::create_symlink(top_ / "outside.txt", top_ / "page" / "link.txt");
    fs::create_symlink(top_, top_ / "page" / "up");
  }
  void TearDown() override { fs::remove_all(top_); }
  auto find(std::string_view target) const { return find_static(top_ / "page", target); }
  fs::path top_;
};

TEST_F(StaticFiles, RootIsTheIndexAndTypesFollowTheExtension) {
  ASSERT_TRUE(find("/"));
  EXPECT_EQ(find("/")->type, "text/html; charset=utf-8");
  EXPECT_FALSE(find("/")->immutable);
  ASSERT_TRUE(find("/assets/a.js"));
  EXPECT_EQ(find("/assets/a.js")->type, "text/javascript; charset=utf-8");
  EXPECT_TRUE(find("/assets/a.js")->immutable);
  EXPECT_TRUE(find("/a%20b.css"));
}

TEST_F(StaticFiles, NothingOutsideTheDirectoryIsReached) {
  for (const auto* target :
       {"/../outside.txt", "/%2e%2e/outside.txt", "/assets/../../outside.txt", "/..%2foutside.txt",
        "/link.txt", "/up/outside.txt", "/.secret", "/%2Esecret", "//etc/passwd", "/%2fetc/passwd",
        "/index.html%00.js", "/assets", "/assets/", "/missing", "", "index.html", "/%", "/%g0"})
    EXPECT_FALSE(find(target)) << target;
}

TEST_F(StaticFiles, WithoutADirectoryThereIsNothing) {
  EXPECT_FALSE(find_static("", "/"));
  EXPECT_FALSE(find_static(top_ / "nowhere", "/"));
}

}  // namespace
}  // namespace trunnion::gateway
