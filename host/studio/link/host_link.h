// The RendererLink that starts a serving host for itself.
#pragma once

#include <filesystem>
#include <memory>

#include "host/shell/options/render_options.h"
#include "host/studio/link/renderer_link.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

// Of `options` backend, nodes, hostfile, mapping and block count, as for a rendering. `self`: the running program's own
// file. The host starts at once, and ends with the link. Throws Failure where there is nothing to start.
std::unique_ptr<RendererLink> make_host_link(boost::asio::io_context& context, const options::RenderOptions& options,
                                             const std::filesystem::path& self, RendererLink::Listener listener);

}  // namespace mars::studio
