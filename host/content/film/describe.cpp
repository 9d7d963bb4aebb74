#include "host/content/film/describe.h"

#include "host/content/document/text.h"
#include "host/content/film/panorama.h"

namespace mars::film {
namespace {

constexpr std::size_t kMostRows = 60;  // of the table of intervals

// Patches as they are rendered and stored; the same of meshes, where there are any.
std::string polygons_of(const wire::PackedFilm& film) {
  std::uint64_t patches = 0, triangles = 0;
  for (const wire::Segment& segment : film.segments()) {
    const wire::Shape& shape = film.shapes()[segment.shape];
    patches += shape.patch_count;
    for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count))
      triangles += meshlet.triangle_count;
  }
  const auto line = [](const char* what, std::uint64_t rendered, std::size_t stored) {
    return document::formatted("%-11s %llu, %zu of them stored\n", what, static_cast<unsigned long long>(rendered),
                               stored);
  };
  std::string text = line("patches", patches, film.patches().size());
  if (!film.meshlets().empty())
    text += line("triangles", triangles, film.mesh_triangles().size()) +
            document::formatted("pieces      %zu, of up to %u triangles\n", film.meshlets().size(),
                                wire::kMeshletTriangles);
  if (!film.bones().empty()) text += document::formatted("bones       %zu\n", film.bones().size());
  return text;
}

std::string colors_of(const wire::FilmSettings& settings) {
  if (settings.color_space == wire::ColorSpace::coded) return "colours     coded\n";
  switch (settings.curve) {
    case wire::Curve::filmic: return "colours     linear, filmic curve\n";
    case wire::Curve::agx: return "colours     linear, AgX\n";
    case wire::Curve::none: break;
  }
  return "colours     linear, no curve\n";
}

std::string panorama_text(const wire::FilmSettings& settings) {
  const std::uint32_t side = face_side(settings.width);
  return document::formatted("camera      panorama, of six faces of %u x %u\n", side, side);
}

std::string table_of(const wire::PackedFilm& film) {
  std::string table = "  first frame   frames   moving segments\n";
  std::size_t row = 0;
  for (const wire::Interval& interval : film.intervals()) {
    if (++row > kMostRows)
      return table + document::formatted("  ... and %zu more\n", film.intervals().size() - kMostRows);
    table += document::formatted("  %11u %8u %17zu\n", interval.first_frame, interval.frame_count,
                                 film.moving_segments(interval).size());
  }
  return table;
}

}  // namespace

std::string describe(const CompiledFilm& film) {
  const wire::PackedFilm view = film.view();
  const wire::FilmSettings& settings = view.settings();
  std::string text = film.source + "\n";
  text += "size        " + size_text(settings) + "\n";
  if (settings.pixel_aspect != 1)
    text += document::formatted("pixels      %g times as wide as high\n", double{settings.pixel_aspect});
  text += document::formatted("samples     %u a pixel\n", settings.samples);
  if (is_panorama(view)) text += panorama_text(settings);
  text += colors_of(settings);
  text += document::formatted("frames      %u at %g a second, %.2f seconds\n", settings.frames, settings.rate,
                              settings.frames / settings.rate);
  text += settings.dice == 0 ? "dicing      adaptive\n"
                             : document::formatted("dicing      %u x %u\n", settings.dice, settings.dice);
  text += document::formatted("actors      %u with %u joints\n", film.actors, film.joints);
  text += document::formatted("segments    %zu of %zu shapes\n", view.segments().size(), view.shapes().size());
  text += polygons_of(view);
  text += document::formatted("lights      %zu\n", view.light_tracks().size());
  text += document::formatted("matrices    %zu\n", view.matrices().size());
  text += document::formatted("bytes       %zu\n", film.block().size());
  text += "checksum    " + film.checksum() + "\n";
  text += document::formatted("intervals   %zu\n", view.intervals().size());
  return text + table_of(view);
}

}  // namespace mars::film
