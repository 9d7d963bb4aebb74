// A studio at work: its server, the signals that end it, the clock by which it looks at files. One thread does it all.
#pragma once

#include <filesystem>
#include <functional>

#include "host/studio/studio.h"
#include "host/studio/studio_settings.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

using MakeParts = std::function<Parts(const std::filesystem::path& file, boost::asio::io_context&)>;

// Prints the link, and returns when SIGINT or SIGTERM has come. Throws Failure.
void serve_studio(const StudioSettings& settings, const MakeParts& make_parts);

}  // namespace mars::studio
