// The studio's server with little behind it: what mars studio is to a network.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "hal/failure/explain.h"
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
          [](studio::Rendering::Listener) { return std::make_unique<test::FakeRendering>(); }};
}

}  // namespace

int main(int argc, char** argv) {
  studio::StudioSettings settings;
  CLI::App app("mars studio with little behind it", "fake-studio");
  app.add_option("FILM", settings.file);
  app.add_option("--port", settings.port);
  app.add_option("--listen", settings.listen);
  app.add_option("--certificate", settings.certificate);
  app.add_option("--key", settings.key);
  app.add_flag("--insecure", settings.insecure);
  app.add_flag("!--no-browser", settings.browser);
  app.add_option("--page", settings.page)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    studio::serve_studio(settings, make_parts);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << reason_of(failure) << '\n';
    return 1;
  }
}
