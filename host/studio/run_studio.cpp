#include "host/studio/run_studio.h"

#include <utility>

#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/studio/importing/importing.h"
#include "host/studio/link/host_link.h"
#include "host/studio/models/thumbnails.h"
#include "host/studio/rendering/rendering.h"
#include "host/studio/serve_studio.h"

namespace mars::studio {

void run_studio(const StudioSettings& settings) {
  serve_studio(settings, [&](const std::filesystem::path& file, boost::asio::io_context& context) {
    const auto link = [&](RendererLink::Listener listener) {
      return make_host_link(context, settings.renderer, child::own_file(), std::move(listener));
    };
    const auto rendering = [&context, file](Rendering::Listener listener) {
      return make_rendering(context, {file, std::filesystem::current_path(), child::own_file()}, std::move(listener));
    };
    const auto importing = [&context, file](const Project& project, Importing::Listener listener) {
      return make_importing(context, {file, child::own_file()}, project, std::move(listener));
    };
    const auto thumbnails = [&context, file](Thumbnails::Listener listener) {
      return make_thumbnails(context, {file, child::own_file(), child::temporary_folder(child::own_environment())},
                             std::move(listener));
    };
    const NewFile begins = settings.film ? NewFile::film : NewFile::model;
    return Parts{open_project(file, std::filesystem::current_path(), begins),
                 link,
                 make_stage,
                 rendering,
                 importing,
                 thumbnails};
  });
}

}  // namespace mars::studio
