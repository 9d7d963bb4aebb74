#include "host/shell/job/render_job.h"

#include "hal/failure/failure.h"
#include "host/content/film/panorama.h"
#include "host/shell/job/film_of.h"

namespace mars::job {
namespace {

std::string replay_of(options::RenderOptions options, const std::string& backend, std::uint32_t nodes,
                      std::optional<std::uint32_t> frame) {
  if (frame) options.frames = film::FrameSet(std::to_string(*frame));
  options.nodes = nodes;
  options.backend = backend == "mpi"       ? options::Backend::mpi
                    : backend == "threads" ? options::Backend::threads
                                           : options::Backend::simulated;
  options.watch.clear();
  std::string command = "mars render";
  for (const std::string& argument : options::arguments_for(options::Program::mars, options)) command += " " + argument;
  return command;
}

// Nodes draw no panorama, but its faces.
film::CompiledFilm load_to_draw(const options::RenderOptions& options, const Warn& warn) {
  film::CompiledFilm film = load_film_of(options, warn);
  if (film::is_panorama(film.view()))
    throw Failure("is a panorama, which mars render joins of its faces", options.film,
                  "use mars render, or add --faces to draw the faces alone");
  return film;
}

session::Writers writers_of(options::WriteWhere write) {
  switch (write) {
    case options::WriteWhere::automatic: break;
    case options::WriteWhere::host: return session::Writers::host;
    case options::WriteWhere::nodes: return session::Writers::nodes;
  }
  return session::Writers::automatic;
}

}  // namespace

session::RenderJob job_of(const options::RenderOptions& options, const std::string& backend) {
  session::RenderJob job;
  job.film = options.film;
  job.load_film = [options](const auto& warn) { return load_to_draw(options, warn); };
  job.film_options = options::film_arguments(options);
  job.overwrite = options.overwrite;
  job.kept_film = options.kept_film;
  job.folder = options.sink == options::SinkKind::files ? options.folder : "";
  job.view = options::view_of(options);
  job.form = options::form_of(options);
  job.writers = writers_of(options.write);
  job.frames = options.frames;
  job.mapping = options.mapping;
  job.exchange = options.exchange;
  job.coherence = !options.no_coherence;
  job.block = options.block;
  job.groups = options.groups;
  job.sharers = static_cast<std::int32_t>(options.sharers);
  job.most_frames = options.cut;
  job.report = options.report;
  job.trace = options.trace;
  job.watch = options.watch;
  job.backend = backend;
  job.arguments = options::arguments_for(options::Program::host, options);
  job.replay = [options, backend](std::uint32_t nodes, std::optional<std::uint32_t> frame) {
    return replay_of(options, backend, nodes, frame);
  };
  return job;
}

}  // namespace mars::job
