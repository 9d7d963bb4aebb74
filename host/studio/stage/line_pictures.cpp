#include "host/studio/stage/line_pictures.h"

#include <algorithm>
#include <cmath>

#include "host/content/film/light_writer.h"
#include "host/preview/shape_lines.h"
#include "host/render/compositor/rectangles.h"
#include "host/studio/stage/picking.h"

namespace mars::studio {
namespace {

constexpr std::uint32_t kBlock = 16;
constexpr int kCoverSteps = 6;  // of a patch that hides lines

// What holds at the view's only frame.
wire::Track track_of(preview::Wireframe& wireframe, std::size_t value) {
  wireframe.changes.push_back({0, static_cast<std::uint32_t>(value)});
  return {static_cast<std::uint32_t>(wireframe.changes.size() - 1), 1};
}

preview::Facets cube_facets() {
  preview::Facets cube;
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    for (const std::uint32_t axis : {0u, 1u, 2u}) cube.points.push_back(static_cast<float>(corner >> axis & 1));
  for (const std::uint32_t side : {0u, 1u})
    for (const std::uint32_t axis : {0u, 1u, 2u}) {
      const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, at = side << axis;
      cube.corners.insert(cube.corners.end(), {at, at + u, at + u + v, at, at + u + v, at + v});
    }
  return cube;
}

void add(const Triangles& triangles, preview::Facets& facets) {
  const auto first = static_cast<std::uint32_t>(facets.points.size() / 3);
  for (const auto& point : triangles.points) facets.points.insert(facets.points.end(), point.begin(), point.end());
  for (const std::uint32_t corner : triangles.corners) facets.corners.push_back(first + corner);
}

preview::Facets diced(std::span<const wire::Patch> patches) {
  preview::Facets facets;
  for (const wire::Patch& patch : patches) {
    Triangles triangles;
    add_diced(patch, kCoverSteps, triangles);
    add(triangles, facets);
  }
  return facets;
}

void append(const preview::Facets& more, preview::Facets& facets) {
  const auto first = static_cast<std::uint32_t>(facets.points.size() / 3);
  facets.points.insert(facets.points.end(), more.points.begin(), more.points.end());
  for (const std::uint32_t corner : more.corners) facets.corners.push_back(first + corner);
}

// `places_of` a meshlet gives those of its vertices.
preview::Facets meshlets_of(const wire::FilmData& shapes, const wire::Shape& shape, const auto& places_of) {
  preview::Facets facets;
  for (std::uint32_t i = 0; i < shape.meshlet_count; ++i) {
    const wire::Meshlet& meshlet = shapes.meshlets[shape.first_meshlet + i];
    const auto first = static_cast<std::uint32_t>(facets.points.size() / 3);
    for (const auto& place : places_of(meshlet)) facets.points.insert(facets.points.end(), place.begin(), place.end());
    for (std::uint32_t t = 0; t < meshlet.triangle_count; ++t)
      for (const std::uint8_t corner : shapes.mesh_triangles[meshlet.first_triangle + t])
        facets.corners.push_back(first + corner);
  }
  return facets;
}

}  // namespace

void LinePictures::draw(const LineLook& look, const wire::Camera& camera, preview::Drawing& drawing) {
  if (film_number_ != moments_.film_number()) {
    film_number_ = moments_.film_number();
    nets_.lines.clear();
    net_numbers_.clear();
    facets_.clear();
  }
  preview::Wireframe wireframe = look.as == preview::As::vertices ? std::move(nets_) : preview::Wireframe{};
  wireframe.subject = moments_.subject();
  look.as == preview::As::stick ? take_sticks(wireframe) : take_segments(look.as, wireframe);
  std::vector<preview::Cover> covers;
  if (look.hidden && look.as != preview::As::stick) covers = covers_of(look.as, wireframe);
  preview::FilmDrawing(wireframe).draw(drawing, look.as, 0, camera, 1, look.ground, covers);
  if (look.as == preview::As::vertices) nets_.lines = std::move(wireframe.lines);
}

bool LinePictures::pulled(std::size_t segment) const {
  return moments_.now().segments[segment].shape >= moments_.shapes().shapes.size();
}

// Parts, matrices and colours of the segments, in their order.
void LinePictures::take_segments(preview::As as, preview::Wireframe& wireframe) {
  const wire::FilmData& now = moments_.now();
  if (as == preview::As::prisms) wireframe.lines = {preview::cube_edges()};
  for (const wire::Material& material : now.materials)
    wireframe.colors.push_back(film::shown_of(material.color, now.settings.color_space));
  std::optional<std::uint32_t> of_pulled;
  for (std::size_t segment = 0; segment < now.segments.size(); ++segment) {
    wireframe.matrices.push_back(preview::placing(moments_.matrix_of(segment)));
    std::uint32_t lines = 0;
    if (as == preview::As::vertices && pulled(segment)) {
      if (!of_pulled) of_pulled = net_of(segment, wireframe);
      lines = *of_pulled;
    } else if (as == preview::As::vertices) {
      lines = net_of(segment, wireframe);
    }
    const wire::Track look = track_of(wireframe, now.changes[now.segments[segment].material.first].value);
    wireframe.parts[static_cast<std::size_t>(as)].push_back({lines, track_of(wireframe, segment), look});
  }
  if (as == preview::As::vertices) take_bones(wireframe);
}

// Their matrices come behind those of all segments.
void LinePictures::take_bones(preview::Wireframe& wireframe) {
  const wire::FilmData& now = moments_.now();
  for (std::size_t number = 0; number < now.segments.size(); ++number) {
    preview::Part& part = wireframe.parts[static_cast<std::size_t>(preview::As::vertices)][number];
    part.blend = now.segments[number].blend;
    for (std::size_t bone = 0; bone < now.segments[number].bone_count; ++bone) {
      wireframe.matrices.push_back(preview::placing(moments_.bone_of(now.segments[number], bone)));
      part.bones.push_back(track_of(wireframe, wireframe.matrices.size() - 1));
    }
  }
}

// The net of a shape that is pulled is made again each time, in its place before all others.
std::uint32_t LinePictures::net_of(std::size_t segment, preview::Wireframe& wireframe) {
  if (wireframe.lines.empty()) wireframe.lines.emplace_back();
  const std::uint32_t shape = moments_.now().segments[segment].shape;
  if (!pulled(segment))
    if (const auto known = net_numbers_.find(shape); known != net_numbers_.end()) return known->second;
  if (pulled(segment)) {
    const auto pulled = *project_.pulled();
    const modeler::Shape& shape = project_.film().models[pulled.model].shapes[pulled.shape];
    wireframe.lines[0] = preview::control_net(shape.patches);
    return 0;
  }
  const wire::PackedFilm film(*moments_.film_block(), "", true);
  wireframe.lines.push_back(preview::control_net(film, film.shapes()[shape]));
  return net_numbers_[shape] = static_cast<std::uint32_t>(wireframe.lines.size() - 1);
}

void LinePictures::take_sticks(preview::Wireframe& wireframe) {
  const wire::FilmData& now = moments_.now();
  const animator::Film& film = project_.film();
  for (const wire::Material& material : now.materials)
    wireframe.colors.push_back(film::shown_of(material.color, now.settings.color_space));
  wireframe.colors.push_back({0.7f, 0.7f, 0.7f});  // of joints that no segment lends its colour
  std::size_t segment = 0;
  for (std::size_t number = 0; number < film.actors.size(); ++number) {
    const modeler::Model& model = film.model_of(number);
    const animator::ActorState state = animator::state_at(film, number, project_.frame());
    const std::vector<preview::Lines> sticks = preview::sticks_of(model);
    std::vector<std::size_t> colors;
    for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
      const std::size_t parent = model.joints[joint].parent;
      if (state.segments[joint]) {
        colors.push_back(now.changes[now.segments[segment++].material.first].value);
        wireframe.matrices.push_back(preview::placing(*state.segments[joint]));
      } else {
        colors.push_back(parent == modeler::kNone ? wireframe.colors.size() - 1 : colors[parent]);
        if (state.joints.empty()) continue;
        wireframe.matrices.push_back(preview::placing(state.joints[joint]));
      }
      wireframe.lines.push_back(sticks[joint]);
      const wire::Track look = track_of(wireframe, colors.back());
      wireframe.parts[static_cast<std::size_t>(preview::As::stick)].push_back(
          {static_cast<std::uint32_t>(wireframe.lines.size() - 1), track_of(wireframe, wireframe.matrices.size() - 1),
           look});
    }
  }
}

const preview::Facets& LinePictures::facets_of(std::size_t segment) {
  if (pulled(segment)) return pulled_facets_ = diced(moments_.patches_of(segment));
  const std::uint32_t number = moments_.now().segments[segment].shape;
  if (const auto known = facets_.find(number); known != facets_.end()) return known->second;
  preview::Facets facets = diced(moments_.patches_of(segment));
  const wire::FilmData& shapes = moments_.shapes();
  const preview::Facets meshes = meshlets_of(shapes, shapes.shapes[number], [&](const wire::Meshlet& meshlet) {
    return std::span(shapes.mesh_places).subspan(meshlet.first_vertex, meshlet.vertex_count);
  });
  append(meshes, facets);
  return facets_[number] = std::move(facets);
}

// Prisms hide by their faces, control vertices by their surfaces.
std::vector<preview::Cover> LinePictures::covers_of(preview::As as, const preview::Wireframe& wireframe) {
  static const preview::Facets cube = cube_facets();
  const wire::FilmData& now = moments_.now();
  std::vector<preview::Cover> covers;
  bent_facets_.clear();
  for (std::size_t segment = 0; segment < now.segments.size(); ++segment) {
    if (as == preview::As::prisms || now.segments[segment].bone_count == 0) {
      covers.push_back({as == preview::As::prisms ? &cube : &facets_of(segment), wireframe.matrices[segment]});
      continue;
    }
    bent_facets_.push_back(diced(moments_.bent_patches(segment)));
    const wire::FilmData& shapes = moments_.shapes();
    if (!pulled(segment))
      append(meshlets_of(shapes, shapes.shapes[now.segments[segment].shape],
                         [&](const wire::Meshlet& m) { return moments_.bent_places(segment, m); }),
             bent_facets_.back());
    covers.push_back({&bent_facets_.back(), preview::placing(modeler::Axes{})});
  }
  return covers;
}

namespace {

bool differs(const images::Image& before, const images::Image& now, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t width = std::min(kBlock, now.width - x), last = std::min(y + kBlock, now.height);
  for (std::uint32_t row = y; row < last; ++row) {
    const std::size_t at = std::size_t{row} * now.width + x;
    if (!std::equal(&now.pixels[at], &now.pixels[at] + width, &before.pixels[at])) return true;
  }
  return false;
}

}  // namespace

std::vector<pictures::Rect> changed_rects(const images::Image& before, const images::Image& now) {
  compositor::BlockFlags changed(now.width, now.height, kBlock);
  const bool all = before.width != now.width || before.height != now.height;
  for (std::uint32_t y = 0; y < now.height; y += kBlock)
    for (std::uint32_t x = 0; x < now.width; x += kBlock)
      if (all || differs(before, now, x, y)) changed.set_pixels(y, x, 1);
  return compositor::rectangles_of(changed, now.width, now.height);
}

}  // namespace mars::studio
