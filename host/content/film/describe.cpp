#include "host/content/film/describe.h"

#include "host/content/document/checksum.h"
#include "host/content/document/text.h"

namespace mars::host {
namespace {

constexpr std::size_t kMostRows = 60;  // of the table of intervals

// Patches as they are rendered and stored; the same of meshes, where there are any.
std::string polygons_of(const node::FilmView& film) {
  std::uint64_t patches = 0, triangles = 0;
  for (const node::Segment& segment : film.segments()) {
    const node::Shape& shape = film.shapes()[segment.shape];
    patches += shape.patch_count;
    for (const node::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count))
      triangles += meshlet.triangle_count;
  }
  const auto line = [](const char* what, std::uint64_t rendered, std::size_t stored) {
    return formatted("%-11s %llu, %zu of them stored\n", what, static_cast<unsigned long long>(rendered), stored);
  };
  std::string text = line("patches", patches, film.patches().size());
  if (!film.meshlets().empty())
    text += line("triangles", triangles, film.mesh_triangles().size()) +
            formatted("pieces      %zu, of up to %u triangles\n", film.meshlets().size(), node::kMeshletTriangles);
  return text;
}

std::string table_of(const node::FilmView& film) {
  std::string table = "  first frame   frames   moving segments\n";
  std::size_t row = 0;
  for (const node::Interval& interval : film.intervals()) {
    if (++row > kMostRows)
      return table + formatted("  ... and %zu more\n", film.intervals().size() - kMostRows);
    table +=
        formatted("  %11u %8u %17u\n", interval.first_frame, interval.frame_count, interval.moving_count);
  }
  return table;
}

}  // namespace

std::string describe(const CompiledFilm& film) {
  const node::FilmView view = film.view();
  const node::FilmSettings& settings = view.settings();
  std::string text = film.source + "\n";
  text += formatted("size        %u x %u\n", settings.width, settings.height);
  text += formatted("frames      %u at %g a second, %.2f seconds\n", settings.frames, settings.rate,
                    settings.frames / settings.rate);
  text += settings.dice == 0 ? "dicing      adaptive\n"
                             : formatted("dicing      %u x %u\n", settings.dice, settings.dice);
  text += formatted("actors      %u with %u joints\n", film.actors, film.joints);
  text += formatted("segments    %zu of %zu shapes\n", view.segments().size(), view.shapes().size());
  text += polygons_of(view);
  text += formatted("lights      %zu\n", view.light_tracks().size());
  text += formatted("matrices    %zu\n", view.matrices().size());
  text += formatted("bytes       %zu\n", film.block().size());
  text += "checksum    " + checksum_of(film.block()) + "\n";
  text += formatted("intervals   %zu\n", view.intervals().size());
  return text + table_of(view);
}

}  // namespace mars::host
