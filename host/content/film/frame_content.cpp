#include "host/content/film/frame_content.h"

#include <algorithm>
#include <span>

#include "host/content/document/checksum.h"

namespace mars::film {
namespace {

using document::Checksum;

// Structs without padding (changed_frames.cpp asserts it), with their number, so that no two lists run together.
template <typename T>
void add(Checksum& sum, std::span<const T> values) {
  const std::uint64_t count = values.size();
  sum.add(std::as_bytes(std::span(&count, 1)));
  sum.add(std::as_bytes(values));
}

template <typename T>
void add(Checksum& sum, const T& value) {
  add(sum, std::span(&value, 1));
}

void add(Checksum& sum, const wire::PackedFilm& film, const wire::Skin& skin, std::uint32_t points) {
  add(sum, film.bones_of(skin));
  add(sum, film.weights_of(skin, points));
}

std::string checksum_of_shape(const wire::PackedFilm& film, const wire::Shape& shape) {
  Checksum sum;
  add(sum, film.patches().subspan(shape.first_patch, shape.patch_count));
  for (const wire::NetPatch& patch : film.net_patches_of(shape))
    for (const std::uint32_t stencil : patch.stencils)
      for (const wire::StencilTerm& term : film.terms_of(film.stencils()[stencil])) {
        const wire::NetPoint& point = film.net_points()[term.point];
        add(sum, term.weight);
        add(sum, point.place);
        add(sum, film, point.skin, 1);
      }
  for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count)) {
    add(sum, meshlet.low);
    add(sum, meshlet.high);
    add(sum, film.mesh_places().subspan(meshlet.first_vertex, meshlet.vertex_count));
    add(sum, film.mesh_normals().subspan(meshlet.first_vertex, meshlet.vertex_count));
    add(sum, film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count));
    if (meshlet.skin.bone_count > 0) add(sum, film, meshlet.skin, meshlet.vertex_count);
  }
  return sum.digits();
}

}  // namespace

wire::FilmSettings shown_settings(wire::FilmSettings settings) {
  settings.frames = 0;
  settings.rate = 0;
  settings.camera = {};
  return settings;
}

std::string FrameContent::checksum(std::uint32_t frame) const {
  std::call_once(read_, [this] {
    for (const wire::Shape& shape : film_.shapes()) shapes_.push_back(checksum_of_shape(film_, shape));
  });
  Checksum sum;
  add(sum, shown_settings(film_.settings()));
  add(sum, film_.camera_at(frame));
  for (const wire::Track& light : film_.light_tracks()) add(sum, film_.lights()[film_.value_at(light, frame)]);
  for (const wire::Segment& segment : film_.segments()) {
    const std::string& shape = shapes_[segment.shape];
    add(sum, std::span(shape.data(), shape.size()));
    add_place(segment, frame, sum);
    add(sum, film_.material_at(segment, frame));
  }
  add(sum, film_.moving(film_.interval_at(frame)));
  add_layers(frame, sum);
  return sum.digits();
}

void FrameContent::add_place(const wire::Segment& segment, std::uint32_t frame, Checksum& sum) const {
  if (segment.bone_count == 0) return add(sum, film_.matrix_at(segment, frame));
  if (segment.blend != wire::Blend::linear) add(sum, segment.blend);
  for (const wire::Track& bone : film_.bones_of(segment)) add(sum, film_.matrix_at(bone, frame));
}

// Motion is seen from the frame before, and identities are those of names.
void FrameContent::add_layers(std::uint32_t frame, Checksum& sum) const {
  const auto add_text = [&](std::string_view text) { add(sum, std::span(text.data(), text.size())); };
  const bool ids = (layers_ & wire::set_of(wire::Layer::surfaces)) != 0;
  const bool motion = frame > 0 && (layers_ & wire::set_of(wire::Layer::motion)) != 0;
  if (motion) add(sum, film_.camera_at(frame - 1));
  for (const wire::Segment& segment : film_.segments()) {
    if (motion) add_place(segment, frame - 1, sum);
    if (!ids) continue;
    add_text(film_.name(segment));
    add_text(film_.material_name(segment));
  }
}

}  // namespace mars::film
