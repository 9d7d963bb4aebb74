// The studio's server with little behind it: what mars studio is to a network.
#include <iostream>
#include <memory>

#include "hal/failure/explain.h"
#include "host/cli/program.h"
#include "host/studio/serve_studio.h"
#include "tests/host/studio/fakes.h"

namespace {

using namespace mars;

studio::Parts make_parts(const std::filesystem::path&, boost::asio::io_context&) {
  return {std::make_unique<test::FakeProject>(),
          [](studio::RendererLink::Listener) { return std::make_unique<test::FakeLink>(); },
          [](studio::Project&, studio::RendererLink&, studio::Stage::Listener listener) {
            return std::make_unique<test::FakeStage>(std::move(listener));
          },
          [](studio::Rendering::Listener) { return std::make_unique<test::FakeRendering>(); },
          [](const studio::Project&, studio::Importing::Listener listener) {
            return std::make_unique<test::FakeImporting>(std::move(listener));
          },
          [](studio::Thumbnails::Listener) { return std::make_unique<test::FakeThumbnails>(); }};
}

}  // namespace

int main(int argc, char** argv) {
  studio::StudioSettings settings;
  bool no_browser = false;
  cli::Program words("fake-studio", "mars studio with little behind it");
  words.add("FILM", settings.file, "");
  words.add("--port", settings.port, "");
  words.add("--listen", settings.listen, "");
  words.add("--certificate", settings.certificate, "");
  words.add("--key", settings.key, "");
  words.add_flag("--insecure", settings.insecure, "");
  words.add_flag("--no-browser", no_browser, "");
  words
      .add_read(
          "--page", [&](const std::string& folder) { settings.page = folder; }, "")
      .required();
  if (const auto code = words.read(argc, argv)) return *code;
  settings.browser = !no_browser;
  try {
    studio::serve_studio(settings, make_parts);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << reason_of(failure) << '\n';
    return 1;
  }
}
