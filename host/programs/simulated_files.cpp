#include "host/programs/simulated_files.h"

#include "host/experiments/platform.h"

namespace mars::programs {

sinks::ServedSinks::Serve serve_files(simulated::World& world, images::PictureFormat format) {
  return [&world, format](const images::FileWork& work) {
    const int host = world.nodes();
    if (work.files == 0) return sinks::ServedSinks::Times{0, world.clock(host), world.clock(host)};
    const double seconds = experiments::file_seconds(world.machine(), format, work);
    const double made = world.reserve(host, seconds);
    const double there = world.store(host, made, static_cast<double>(work.file_bytes));
    world.set_alarm(host, there);
    return sinks::ServedSinks::Times{seconds, made, there};
  };
}

farm::Writing counted_writing() {
  return {std::vector<std::byte>(1), {}, [](const wire::Hello&) { return true; }, [](const wire::Written&) {}};
}

}  // namespace mars::programs
