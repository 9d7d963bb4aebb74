#include "host/render/farm/farm.h"

#include <algorithm>

#include "hal/nx/nx_messages.h"
#include "host/render/farm/film_pictures.h"
#include "host/render/farm/film_work.h"

namespace mars::farm {
namespace {

EngineOptions engine_options(const FarmOptions& farm, const sinks::SinkPool::Shape& shape) {
  EngineOptions engine = farm;
  engine.width = shape.width;
  engine.height = shape.height;
  engine.format = shape.format;
  engine.watched = farm.watch != nullptr;
  return engine;
}

NodeMemory node_memory(const FilmRun& run) {
  const std::uint64_t bytes = run.options.memory == 0 ? run.engine.node_memory() : run.options.memory;
  const shadow::ShadowNeeds shadows = shadow::shadow_needs(run.film, run.engine.has_layers());
  if (!run.options.asked_memory.shadows) check_shadow_memory(bytes, shadows);
  return share_node_memory(bytes, run.options.asked_memory, run.film.settings(), shadows, run.engine.nodes_together());
}

void let_nodes_write(const Writing& writing, const FilmRun& run, std::vector<GroupWork>& groups) {
  const NodeInbox& inbox = run.engine.inbox();
  const std::string warning =
      choose_writers(groups, inbox.hellos(), writing, [&](int node) { return inbox.sees_folder(node); });
  if (!warning.empty() && run.listener.warned) run.listener.warned(warning);
}

bool load_film(std::span<const std::byte> film_block, const FilmRun& run, std::vector<GroupWork>& groups) {
  const double begun = dclock();
  run.report.node_memory = node_memory(run);
  run.report.film_bytes = film_block.size();
  wire::Load load{};
  load.mapping = run.options.mapping;
  load.exchange = run.options.exchange;
  load.groups = static_cast<std::int32_t>(run.plan.groups.size());
  load.memory = run.report.node_memory.frames;
  load.still_memory = run.report.node_memory.still;
  load.shadow_memory = run.report.node_memory.shadows;
  const Writing* const writing = run.options.writing;
  const NodeInbox& inbox = run.engine.inbox();
  const bool nodes_write = writing != nullptr && (!writing->is_wanted || writing->is_wanted(inbox.hellos()));
  const bool loaded =
      run.engine.load_film(film_block, load, nodes_write ? writing->orders : std::span<const std::byte>());
  if (loaded && nodes_write) let_nodes_write(*writing, run, groups);
  if (loaded && run.listener.warned) std::ranges::for_each(inbox.apart(), run.listener.warned);
  run.report.load_seconds = dclock() - begun;
  return loaded;
}

void finish_sinks(const FilmRun& run) {
  if (run.options.heartbeats == nullptr) return run.sinks.finish();
  run.options.heartbeats->during("waiting for storage", [&] { run.sinks.finish(); });
}

// Whether all frames are drawn.
bool render(const FilmRun& run, FilmPictures& pictures) {
  FilmWork work(run, pictures);
  pictures.begin();
  run.engine.set_doing("rendering");
  run.engine.run(work, pictures);
  run.report.render_seconds = run.engine.seconds();
  run.report.busy_seconds = run.engine.busy_seconds();
  run.report.slow_times = work.slow_times();
  if (work.goes_on()) return false;
  const ScopedSpan span(trace::HostSpan::finish);
  finish_sinks(run);
  pictures.note_with_sinks();
  run.report.groups = run.plan.groups;
  run.report.files = run.sinks.made();
  run.report.sinks = run.sinks.shape().threads;
  run.report.storing_seconds = run.report.files.storing_seconds + pictures.storing_seconds();
  run.report.total_seconds = run.engine.seconds();
  return true;
}

}  // namespace

FarmReport render_film(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options,
                       sinks::SinkPool& sinks, const FarmListener& listener) {
  const wire::PackedFilm film(film_block, "film");
  FarmReport report;
  Engine engine(engine_options(options, sinks.shape()));
  const FilmRun run{film, plan, options, sinks, listener, engine, report};
  bool drawn = false;
  if (engine.shake_hands()) {
    report.nodes = engine.inbox().hellos();
    if (listener.booted) listener.booted(report.nodes, plan.keyframes(), plan.inbetweens());
    FilmPictures pictures(run);
    drawn = load_film(film_block, run, pictures.groups()) && render(run, pictures);
  }
  engine.stop(drawn);
  report.cancelled = !drawn;
  return report;
}

void dismiss_nodes() {
  Engine engine({.credits = 1});
  engine.shake_hands();
  engine.stop(true);
}

}  // namespace mars::farm
