#include "host/content/film/moment.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/film/motion_writer.h"

namespace mars::film {
namespace {

CompiledFilm compiled(const wire::FilmData& data, const animator::Film& film) {
  const std::vector<std::byte> block = wire::pack(data);
  CompiledFilm compiled;
  compiled.lines.resize(block.size() / sizeof(CompiledFilm::Line));
  std::memcpy(compiled.lines.data(), block.data(), block.size());
  compiled.source = film.source;
  compiled.actors = static_cast<std::uint32_t>(film.actors.size());
  for (const animator::Actor& actor : film.actors)
    compiled.joints += static_cast<std::uint32_t>(film.models[actor.model].joints.size());
  return compiled;
}

}  // namespace

FilmShapes shapes_of(const animator::Film& film) {
  FilmShapes shapes;
  shapes.numbers = write_shapes(film, shapes.parts);
  return shapes;
}

wire::FilmData moment_of(const animator::Film& film, const ShapeNumbers& shapes, std::uint32_t frame) {
  wire::FilmData data;
  FilmWriter writer(film, {frame, 1}, data);
  writer.write_settings();
  writer.write_segments(shapes);
  std::vector<wire::Matrix> of_bones;  // behind all segments'
  const auto stand = [&](std::size_t number) {
    data.changes.push_back({0, static_cast<std::uint32_t>(number)});
    return wire::Track{static_cast<std::uint32_t>(data.changes.size() - 1), 1};
  };
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    const animator::ActorState state = animator::state_at(film, actor, frame);
    for (std::size_t joint = 0; joint < state.segments.size(); ++joint) {
      if (!state.segments[joint]) continue;
      check_near(*state.segments[joint], film, actor, joint, frame);
      data.segments[data.matrices.size()].motion = stand(data.matrices.size());
      data.matrices.push_back(*state.segments[joint]);
      for (std::size_t number = 0; number < state.bones[joint].size(); ++number) {
        const wire::Matrix& bone = state.bones[joint][number];
        check_near(bone, film, actor, joint, frame);
        check_volume(bone, film, actor, joint, film.model_of(actor).joints[joint].segment->bones[number], frame);
        data.bones[of_bones.size()] = stand(data.segments.size() + of_bones.size());
        of_bones.push_back(bone);
      }
    }
  }
  data.matrices.insert(data.matrices.end(), of_bones.begin(), of_bones.end());
  data.intervals.push_back({0, 1, 0, 0});
  return data;
}

CompiledFilm compiled_moment(const animator::Film& film, std::uint32_t frame) {
  FilmShapes shapes = shapes_of(film);
  wire::FilmData data = moment_of(film, shapes.numbers, frame);
  data.shapes = std::move(shapes.parts.shapes);
  data.patches = std::move(shapes.parts.patches);
  data.meshlets = std::move(shapes.parts.meshlets);
  data.mesh_places = std::move(shapes.parts.mesh_places);
  data.mesh_normals = std::move(shapes.parts.mesh_normals);
  data.mesh_triangles = std::move(shapes.parts.mesh_triangles);
  data.net_points = std::move(shapes.parts.net_points);
  data.stencil_terms = std::move(shapes.parts.stencil_terms);
  data.stencils = std::move(shapes.parts.stencils);
  data.net_patches = std::move(shapes.parts.net_patches);
  data.skin_bones = std::move(shapes.parts.skin_bones);
  data.skin_weights = std::move(shapes.parts.skin_weights);
  return compiled(data, film);
}

std::span<const std::uint32_t> Cut::moving_at(std::uint32_t frame) const {
  const auto after = std::upper_bound(intervals.begin(), intervals.end(), frame,
                                      [](std::uint32_t f, const wire::Interval& i) { return f < i.first_frame; });
  const wire::Interval& interval = *(after - 1);
  return std::span(moving).subspan(interval.first_moving, interval.moving_count);
}

}  // namespace mars::film
