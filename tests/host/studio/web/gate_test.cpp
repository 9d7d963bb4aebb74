// Who may speak with the studio, and which files are the page's.
#include "host/studio/web/gate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "host/studio/web/message_rate.h"
#include "host/studio/web/page_files.h"
#include "host/studio/web/token.h"
#include "tests/temporary_folder.h"

namespace mars::web {
namespace {

namespace fs = std::filesystem;

Request to(std::string_view host, std::string_view origin = "", std::string_view target = "/") {
  return {"GET", target, host, origin, ""};
}

TEST(Gate, KnowsItsOwnNames) {
  const Gate gate("secret", false, {"box"});
  for (const char* host : {"127.0.0.1:8640", "localhost", "LOCALHOST:1", "box:8640", "[::1]:8640", "10.0.0.7:1"})
    EXPECT_EQ(gate.check(to(host)).status, 0u) << host;
  for (const char* host : {"", ":8640", "evil.example", "evil.example:8640", "box.evil.example", "localhost.evil",
                           "127.0.0.1.evil", "[::1", "[::1].evil", "1.2.3", "[]", "boxx"})
    EXPECT_EQ(gate.check(to(host)).status, 403u) << host;
  EXPECT_EQ(Gate("secret", true, {}).check(to("cluster.example:8640")).status, 0u);
}

TEST(Gate, RefusesOtherOriginsAndMethods) {
  const Gate gate("secret", false, {});
  EXPECT_EQ(gate.check(to("localhost:1", "http://localhost:1")).status, 0u);
  for (const char* origin : {"http://localhost:2", "https://localhost:1", "http://evil.example", "null"})
    EXPECT_EQ(gate.check(to("localhost:1", origin)).status, 403u) << origin;
  Request post = to("localhost:1");
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "get", ""}) {
    post.method = method;
    EXPECT_EQ(gate.check(post).status, 405u) << method;
  }
}

TEST(Gate, SocketsNeedOriginAndToken) {
  const Gate gate("secret", false, {});
  const char *host = "localhost:1", *own = "http://localhost:1";
  EXPECT_EQ(gate.check_socket(to(host, own, "/ws?token=secret")).status, 0u);
  EXPECT_EQ(gate.check_socket(to(host, own, "/ws?a=b&token=secret&c")).status, 0u);
  EXPECT_EQ(gate.check_socket(to(host, "", "/ws?token=secret")).status, 403u);
  for (const char* target : {"/ws", "/ws?", "/ws?token", "/ws?token=", "/ws?token=secre", "/ws?token=secrets",
                             "/ws?token=Secret", "/ws?xtoken=secret", "/ws?x=&token=&token=secret"})
    EXPECT_EQ(gate.check_socket(to(host, own, target)).status, 403u) << target;
}

TEST(Gate, UploadsNeedOriginAndToken) {
  const Gate gate("secret", false, {});
  const char *host = "localhost:1", *own = "http://localhost:1", *target = "/import/1/0?token=secret";
  EXPECT_EQ(gate.check_upload(to(host, own, target)).status, 0u);
  EXPECT_EQ(gate.check_upload(to(host, "", target)).status, 403u);
  EXPECT_EQ(gate.check_upload(to(host, "http://evil.example", target)).status, 403u);
  EXPECT_EQ(gate.check_upload(to("evil.example", "http://evil.example", target)).status, 403u);
  EXPECT_EQ(gate.check_upload(to(host, own, "/import/1/0")).status, 403u);
  EXPECT_EQ(gate.check_upload(to(host, own, "/import/1/0?token=secrets")).status, 403u);
}

TEST(Token, IsLongAndNew) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(make_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 48u);  // 192 bits
  EXPECT_TRUE(same_token("ab", "ab"));
  for (const char* other : {"", "a", "aa", "abc"}) EXPECT_FALSE(same_token("ab", other));
}

TEST(MessageRate, LetsBurstsThroughAndNoFlood) {
  MessageRate rate;
  auto now = MessageRate::Clock::now();
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(rate.take(now).count(), 0) << i;
  EXPECT_GT(rate.take(now).count(), 0);
  int read = 0;
  for (const auto end = now + std::chrono::seconds(1); now < end; ++read) now += rate.take(now);
  EXPECT_NEAR(read, 2000, 10);
}

class PageFiles : public testing::Test {
 protected:
  PageFiles() {
    fs::create_directories(folder_ / "page/panels");
    for (const char* name : {"page/index.html", "page/main.js", "page/panels/pose.js", "page/.hidden.js", "page/x.sh",
                             "secret.js", "page-2.js"})
      std::ofstream(folder_ / name) << name;
    fs::create_symlink("../secret.js", folder_ / "page/out.js");
    fs::create_symlink("main.js", folder_ / "page/in.js");
    fs::create_directory_symlink("..", folder_ / "page/up");
    fs::create_directory(folder_ / "page/folder.js");
  }

  Answer get(std::string_view path, std::string_view known = "") { return answer_file(folder_ / "page", path, known); }

  const test::TemporaryFolder folder_;
};

TEST_F(PageFiles, AreServed) {
  EXPECT_EQ(get("/").body, "page/index.html");
  EXPECT_EQ(get("/panels/pose.js").body, "page/panels/pose.js");
  EXPECT_EQ(get("/panels/pose.js").type, "text/javascript; charset=utf-8");
  EXPECT_EQ(get("/in.js").status, 200u);
  const Answer first = get("/main.js");
  EXPECT_EQ(get("/main.js", first.tag).status, 304u);
  std::ofstream(folder_ / "page/main.js") << "another";
  EXPECT_EQ(get("/main.js", first.tag).body, "another");
}

TEST_F(PageFiles, NothingElseIs) {
  for (const char* path : {"",
                           "main.js",
                           "/../secret.js",
                           "/panels/../main.js",
                           "/./main.js",
                           "//main.js",
                           "/out.js",
                           "/up/secret.js",
                           "/up/page/main.js/",
                           "/.hidden.js",
                           "/x.sh",
                           "/folder.js",
                           "/panels",
                           "/%2e%2e/secret.js",
                           "/..%2fsecret.js",
                           "/panels\\..\\main.js",
                           "/main.js\n",
                           "/none.js",
                           "/../page-2.js",
                           "/etc/passwd"})
    EXPECT_EQ(get(path).status, 404u) << path;
  EXPECT_EQ(get(std::string_view("/main.js\0", 9)).status, 404u);
  EXPECT_EQ(answer_file(folder_ / "none", "/", "").status, 404u);
}

}  // namespace
}  // namespace mars::web
