// Connections that are silent, slow or too many, over real sockets, with and without TLS.
#include "host/studio/web/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hal/failure/failure.h"
#include "tests/temporary_folder.h"

namespace mars::web {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int kLongest = 200'000;  // ms that a test waits for what must come
constexpr std::size_t kMostPages = 16, kMostConnections = 64;

template <auto free>
struct Freed {
  void operator()(auto* made) const { free(made); }
};
using Context = std::unique_ptr<SSL_CTX, Freed<SSL_CTX_free>>;

void write_pem(const fs::path& path, const std::function<int(std::FILE*)>& write) {
  const std::unique_ptr<std::FILE, Freed<std::fclose>> file(std::fopen(path.c_str(), "wb"));
  ASSERT_TRUE(file && write(file.get()) == 1);
}

// A key and its certificate, which nobody answers for.
void write_certificate(const fs::path& key_path, const fs::path& certificate_path) {
  const std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>> key(EVP_EC_gen("P-256"));
  const std::unique_ptr<X509, Freed<X509_free>> certificate(X509_new());
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), 0);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), 3600);
  X509_set_pubkey(certificate.get(), key.get());
  ASSERT_GT(X509_sign(certificate.get(), key.get(), EVP_sha256()), 0);
  write_pem(key_path,
            [&](std::FILE* to) { return PEM_write_PrivateKey(to, key.get(), nullptr, nullptr, 0, nullptr, nullptr); });
  write_pem(certificate_path, [&](std::FILE* to) { return PEM_write_X509(to, certificate.get()); });
}

// Somebody at the other end, who shakes hands at once where there is TLS.
class Client {
 public:
  Client(std::uint16_t port, SSL_CTX* tls) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    if (tls == nullptr) return;
    tls_.reset(SSL_new(tls));
    SSL_set_fd(tls_.get(), socket_);
    EXPECT_EQ(SSL_connect(tls_.get()), 1);
  }
  ~Client() { close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const std::string& text) {
    const auto sent = tls_ ? SSL_write(tls_.get(), text.data(), static_cast<int>(text.size()))
                           : ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    EXPECT_EQ(sent, static_cast<ssize_t>(text.size()));
  }

  // What comes within the time; "": nothing, or the end.
  std::string read(int milliseconds = kLongest) {
    std::array<char, 4096> bytes{};
    pollfd at{socket_, POLLIN, 0};
    while ((tls_ && SSL_pending(tls_.get()) > 0) || poll(&at, 1, milliseconds) > 0) {
      const auto size = tls_ ? SSL_read(tls_.get(), bytes.data(), static_cast<int>(bytes.size()))
                             : recv(socket_, bytes.data(), bytes.size(), 0);
      if (tls_ && SSL_get_error(tls_.get(), static_cast<int>(size)) == SSL_ERROR_WANT_READ) continue;  // TLS's own
      ended_ = size <= 0;
      if (size > 0) answered_ = true;
      return size > 0 ? std::string(bytes.data(), static_cast<std::size_t>(size)) : "";
    }
    return "";
  }
  bool answered(int milliseconds) {
    if (!answered_) read(milliseconds);
    return answered_;
  }
  bool ended() const { return ended_; }
  // Without TLS every end is one.
  bool ended_in_order() const {
    return ended_ && (!tls_ || (SSL_get_shutdown(tls_.get()) & SSL_RECEIVED_SHUTDOWN) != 0);
  }

  // Of an answer: "200".
  std::string status() { return read().substr(9, 3); }

  bool ends() {
    while (!ended_ && !read().empty()) {
    }
    return ended_;
  }
  bool is_open() {
    read(0);
    return !ended_;
  }

  // As a browser does, to all that came: whether there was one.
  bool answer_pings() {
    const std::string came = read(0);
    const bool asked = came.find(kPing) != std::string::npos;
    if (asked) send(kPong);
    return asked;
  }

 private:
  static inline const std::string kPing{'\x89', '\0'}, kPong{'\x8a', '\x80', '\0', '\0', '\0', '\0'};

  int socket_;
  std::unique_ptr<SSL, Freed<SSL_free>> tls_;
  bool answered_ = false, ended_ = false;
};

const std::string kGoingAway{'\x88', '\x82', '\0', '\0', '\0', '\0', '\x03', '\xe9'};

// Within the time that a test waits.
bool comes(const std::function<bool()>& what) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::milliseconds(kLongest);
  while (!what() && std::chrono::steady_clock::now() < last) std::this_thread::sleep_for(5ms);
  return what();
}

using Clients = std::vector<std::unique_ptr<Client>>;

// What came of a page's upload: its name, its bytes, and how it ended.
struct Came {
  std::string bytes;
  std::atomic<int> ended = 0, cut = 0;
};

class Noted final : public studio::Upload {
 public:
  explicit Noted(Came& came) : came_(came) {}
  ~Noted() override {
    if (!whole_) ++came_.cut;
  }
  void take(std::string_view piece) override {
    if (piece.find("full") != piece.npos) throw Failure("the disk is full", "", "");
    came_.bytes += piece;
  }
  void end() override {
    whole_ = true;
    ++came_.ended;
  }

 private:
  Came& came_;
  bool whole_ = false;
};

// Without TLS, and with it.
class ServerTest : public testing::TestWithParam<bool> {
 protected:
  ~ServerTest() override {
    context_.stop();
    if (thread_.joinable()) thread_.join();
  }

  void serve(const Patience& patience) {
    std::ofstream(folder_ / "index.html") << "<!DOCTYPE html>";
    ServerSettings settings;
    settings.folder = folder_.path();
    settings.patience = patience;
    if (GetParam()) use_tls(settings);
    server_ = make_server(context_, settings,
                          {[this](PageNumber) { ++opened_; }, [](PageNumber, const Json&) {},
                           [this](PageNumber) { ++closed_; },
                           [this](const studio::UploadedFile& file) {
                             if (file.import != 7) throw Failure("no import waits for this file", "", "");
                             return std::make_unique<Noted>(came_);
                           }});
    const std::string link = server_->link();
    const std::size_t scheme = link.find("://");
    origin_ = link.substr(0, link.find("/?"));
    address_ = origin_.substr(scheme + 3);
    token_ = link.substr(link.find("token=") + 6);
    thread_ = std::thread([this] { context_.run(); });
  }

  void use_tls(ServerSettings& settings) {
    settings.key = folder_ / "key.pem";
    settings.certificate = folder_ / "certificate.pem";
    write_certificate(settings.key, settings.certificate);
    tls_.reset(SSL_CTX_new(TLS_client_method()));
    SSL_CTX_clear_mode(tls_.get(), SSL_MODE_AUTO_RETRY);  // nothing is read that was not waited for
    std::signal(SIGPIPE, SIG_IGN);
  }

  std::uint16_t port() const { return static_cast<std::uint16_t>(std::stoi(address_.substr(address_.find(':') + 1))); }

  std::unique_ptr<Client> client(const std::string& text = "") {
    auto made = std::make_unique<Client>(port(), tls_.get());
    if (!text.empty()) made->send(text);
    return made;
  }

  Clients crowd(std::size_t size, const std::string& text) {
    Clients clients;
    while (clients.size() < size) clients.push_back(client(text));
    return clients;
  }

  std::string request() const { return "GET / HTTP/1.1\r\nHost: " + address_ + "\r\n\r\n"; }
  std::string page_request() const {
    return "GET /ws?token=" + token_ + " HTTP/1.1\r\nHost: " + address_ + "\r\nOrigin: " + origin_ +
           "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  }

  // The beginning of an upload of this many bytes.
  std::string upload(const std::string& target, std::size_t bytes) const {
    return "POST " + target + " HTTP/1.1\r\nHost: " + address_ + "\r\nOrigin: " + origin_ +
           "\r\nContent-Length: " + std::to_string(bytes) + "\r\n\r\n";
  }
  std::string with_token(const std::string& path) const { return path + "?token=" + token_; }

  Clients pages(std::size_t size) {
    Clients clients = crowd(size, page_request());
    for (const auto& each : clients) EXPECT_EQ(each->status(), "101");
    return clients;
  }

  const test::TemporaryFolder folder_;
  boost::asio::io_context context_{1};
  std::atomic<int> opened_ = 0, closed_ = 0;
  Came came_;
  std::unique_ptr<Server> server_;
  std::string origin_, address_, token_;
  Context tls_;
  std::thread thread_;
};

TEST_P(ServerTest, WhoSendsNothingGivesWay) {
  serve({});
  for (const std::string& text : {std::string(), std::string("GET / HTTP/1.1\r\nHo")}) {
    const Clients silent = crowd(kMostConnections, text);
    EXPECT_EQ(client(request())->status(), "200") << text;
    EXPECT_TRUE(silent.front()->ends()) << text;
    EXPECT_TRUE(silent.back()->is_open()) << text;
  }
}

TEST_P(ServerTest, WhoAskedLastGivesWayLast) {
  serve({});
  const auto early = client(request());
  EXPECT_EQ(early->status(), "200");
  const Clients silent = crowd(kMostConnections - 1, "");
  early->send(request());
  EXPECT_EQ(early->status(), "200");
  EXPECT_EQ(client(request())->status(), "200");
  EXPECT_TRUE(silent.front()->ends());
  EXPECT_TRUE(early->is_open());
}

TEST_P(ServerTest, WhoSendsNoWholeRequestIsEnded) {
  serve({.request = 400ms});
  const auto silent = client(), slow = client();
  for (const char letter : std::string("GET / HTTP/1.1")) {
    if (!slow->is_open()) break;
    slow->send(std::string(1, letter));
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_TRUE(slow->ends());
  EXPECT_TRUE(silent->ends());
}

TEST_P(ServerTest, WhoShakesNoHandsIsEnded) {
  serve({.request = 100ms});
  Client silent(port(), nullptr), slow(port(), nullptr);
  slow.send({'\x16', '\x03', '\x01'});
  EXPECT_TRUE(silent.ends());
  EXPECT_TRUE(slow.ends());
}

TEST_P(ServerTest, PagesThatAnswerNoPingGiveWayToTheNewest) {
  serve({.answer = 200ms});
  const Clients idle = pages(kMostPages);
  const Clients more = crowd(kMostConnections - kMostPages, page_request());
  const auto unanswered = [&] {
    return std::ranges::count_if(more, [](const auto& each) { return !each->answered(1); });
  };
  while (unanswered() > 1) {
  }
  const auto newest = client(page_request());
  EXPECT_EQ(newest->status(), "101");
  EXPECT_GE(closed_, static_cast<int>(kMostPages));
  for (const auto& each : idle) EXPECT_TRUE(each->ends());
}

TEST_P(ServerTest, PagesWhoseBrowsersAnswerStay) {
  serve({.answer = 500ms});
  const Clients open = pages(kMostPages);
  const auto newcomer = client(page_request());
  std::size_t answered = 0;
  std::string answer;
  while (answer.empty()) {
    for (const auto& each : open) answered += each->answer_pings();
    answer = newcomer->read(5);
    ASSERT_FALSE(newcomer->ended());
  }
  EXPECT_EQ(answer.substr(9, 3), "503");
  EXPECT_EQ(answered, kMostPages);
  EXPECT_EQ(closed_, 0);
}

TEST_P(ServerTest, AnIdlePageStaysWhileItsBrowserAnswers) {
  serve({.silence = 400ms});
  const Clients both = pages(2);
  int answered = 0;
  while (answered < 3) {
    answered += both[0]->answer_pings();
    ASSERT_FALSE(both[0]->ended());
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_TRUE(both[1]->ends());
  EXPECT_TRUE(both[0]->is_open());
}

TEST_P(ServerTest, APageThatClosesIsAnswered) {
  serve({});
  auto page = std::move(pages(1).front());
  page->send(kGoingAway);
  EXPECT_EQ(page->read(), std::string("\x88\x02\x03\xe9"));
  EXPECT_TRUE(page->ends());
  EXPECT_TRUE(page->ended_in_order());
  page.reset();
  EXPECT_TRUE(comes([&] { return closed_ == 1; }));
}

TEST_P(ServerTest, PagesAreClosedWithTheServer) {
  serve({});
  Clients both = pages(2);
  EXPECT_TRUE(comes([&] { return opened_ == 2; }));
  boost::asio::post(context_, [this] { server_->close(); });
  for (const auto& page : both) EXPECT_EQ(page->read(), std::string("\x88\x02\x03\xe9"));
  both[0]->send(kGoingAway);
  EXPECT_TRUE(both[0]->ends());
  EXPECT_TRUE(both[0]->ended_in_order());
  both[0].reset();
  EXPECT_TRUE(comes([&] { return closed_ == 1; }));
}

TEST_P(ServerTest, UploadsComeWholeAndInTurn) {
  serve({});
  const std::string large(300'000, 'x');
  const auto page = client(upload(with_token("/import/7/0"), large.size()) + large);
  EXPECT_EQ(page->status(), "200");
  EXPECT_EQ(came_.bytes, large);
  page->send(upload(with_token("/import/7/1"), 0));
  EXPECT_EQ(page->status(), "200");
  page->send(request());
  EXPECT_EQ(page->status(), "200");
  EXPECT_EQ(came_.ended, 2);
  EXPECT_EQ(came_.cut, 0);
}

TEST_P(ServerTest, UploadsOfNobodyAreRefused) {
  serve({});
  const auto status = [&](const std::string& text) { return client(text)->status(); };
  EXPECT_EQ(status(upload("/import/7/0?token=" + std::string(48, '0'), 3) + "abc"), "403");
  EXPECT_EQ(status(upload("/import/7/0", 3) + "abc"), "403");
  EXPECT_EQ(status(upload(with_token("/index.html"), 3) + "abc"), "405");
  for (const char* path : {"/import/8/0", "/import/7", "/import/7/", "/import//0", "/import/7/x", "/import/-7/0",
                           "/import/7/0/0", "/import/7/../0"})
    EXPECT_EQ(status(upload(with_token(path), 3) + "abc"), "409") << path;
  std::string chunked = upload(with_token("/import/7/0"), 3);
  chunked.replace(chunked.find("Content-Length: 3"), 17, "Transfer-Encoding: chunked");
  EXPECT_EQ(status(chunked), "411");
  EXPECT_EQ(came_.ended + came_.cut, 0);
}

TEST_P(ServerTest, CutAndFailedUploadsDoNotEnd) {
  serve({.request = 400ms});
  client(upload(with_token("/import/7/0"), 10) + "abc");
  const auto slow = client(upload(with_token("/import/7/1"), 10) + "abc");
  EXPECT_TRUE(slow->ends());
  EXPECT_EQ(client(upload(with_token("/import/7/2"), 10) + "it is full")->status(), "409");
  EXPECT_TRUE(comes([&] { return came_.cut == 3; }));
  EXPECT_EQ(came_.ended, 0);
}

INSTANTIATE_TEST_SUITE_P(, ServerTest, testing::Bool(),
                         [](const auto& each) { return each.param ? "WithTls" : "WithoutTls"; });

}  // namespace
}  // namespace mars::web
