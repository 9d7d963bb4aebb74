#include "host/studio/opening.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/process.h"
#include "host/child/programs.h"
#include "host/content/document/text.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFigure = "figure.json";
constexpr std::uint16_t kUsualPort = 8640;

struct Place {
  std::string address;
  std::optional<std::uint16_t> port;
};

// ADDRESS, ADDRESS:PORT, [ADDRESS]:PORT.
Place place_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const bool v6 = text.starts_with('['), bare_v6 = !v6 && colon != text.find(':');
  if (colon == text.npos || bare_v6 || text.ends_with(']')) {
    return {v6 ? text.substr(1, text.size() - 2) : text, std::nullopt};
  }
  const auto port = document::number_in<std::uint16_t>(text.substr(colon + 1));
  if (!port) throw Failure("'" + text.substr(colon + 1) + "' is no port", "--listen " + text, "give ADDRESS:PORT");
  const std::string address = text.substr(0, colon);
  return {v6 && address.size() > 2 ? address.substr(1, address.size() - 2) : address, port};
}

void check_tls(const StudioSettings& settings, const std::string& address) {
  if (settings.certificate.empty() != settings.key.empty())
    throw Failure("a certificate and its key are needed together", "", "give both --certificate and --key");
  if (settings.certificate.empty() && !settings.insecure && !is_loopback(address))
    throw Failure("other machines would reach the studio without TLS: who listens there reads the token", address,
                  "give --certificate and --key, or --insecure; or leave out --listen and come by ssh -L");
}

void write_private(int file, const std::string& text) {
  if (write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw Failure("the browser's file cannot be written", "", "give --no-browser");
}

}  // namespace

fs::path file_to_open(const std::string& name) {
  const fs::path file = name.empty() ? kFigure : name;
  std::error_code problem;
  const bool begins = !fs::exists(fs::symlink_status(file, problem)) && file.extension() == ".json";
  const fs::path folder = fs::current_path();
  const fs::path real =
      begins ? fs::canonical(fs::absolute(file).parent_path(), problem) : fs::canonical(file, problem);
  if (problem)
    throw Failure("the file cannot be opened: " + problem.message(), file.string(),
                  "name a film or a model, or a new one: walker.json");
  if (std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first != folder.end())
    throw Failure("the file is not below the folder in which the studio was started", name,
                  "start it in " + real.parent_path().string());
  return file;
}

bool is_loopback(const std::string& address) {
  boost::system::error_code problem;
  const auto read = boost::asio::ip::make_address(address, problem);
  return !problem && read.is_loopback();
}

web::ServerSettings server_settings(const StudioSettings& settings) {
  web::ServerSettings server;
  const Place place = settings.listen.empty() ? Place{server.address, std::nullopt} : place_of(settings.listen);
  if (place.port && settings.port) throw Failure("the port is given twice", "", "leave out --port");
  check_tls(settings, place.address);
  server.address = place.address;
  server.port = place.port.value_or(settings.port.value_or(kUsualPort));
  server.may_choose = !place.port && !settings.port;
  server.certificate = settings.certificate;
  server.key = settings.key;
  server.folder = settings.page;
  return server;
}

Browser::Browser(const std::string& link) {
  const child::Environment environment = child::own_environment();
  const bool display = environment.value("DISPLAY") || environment.value("WAYLAND_DISPLAY");
  const auto opener = child::find_program("xdg-open", child::program_path(environment));
  if (!display || !opener) return;
  std::string name = child::temporary_folder(environment) + "/mars-studio-XXXXXX.html";
  const int file = mkostemps(name.data(), 5, O_CLOEXEC);
  if (file < 0) return;
  file_ = name;
  write_private(file, "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url=" + link +
                          "\"><title>MARS studio</title>\n");
  ::close(file);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  child::Process process({.environment = {}, .words = {opener->string(), name}},
                         {.streams = {{0, nothing}, {1, nothing}, {2, nothing}}});
  process.give_up();
  ::close(nothing);
}

Browser::~Browser() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

}  // namespace mars::studio
