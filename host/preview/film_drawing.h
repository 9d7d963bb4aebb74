// A frame of a film as lines: one of the thesis's three representations, seen from anywhere.
#pragma once

#include <map>
#include <span>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/modeler/bent_skin.h"
#include "host/preview/drawing.h"
#include "host/preview/wireframe.h"

namespace mars::preview {

inline constexpr Color kPaper{0.07f, 0.08f, 0.10f};

// A colour as lines of it are drawn: bright enough to be seen on kPaper.
Color line_color(const Color& color);

// What hides lines, where it stands.
struct Cover {
  const Facets* facets;
  Placing to_world;
};

// How a person's hand changes a picture of a film.
struct Posed {
  JointNumber selected;                                 // is brighter
  std::map<std::size_t, animator::ActorState> figures;  // by actor: those that stand otherwise than in the film
};

class FilmDrawing {
 public:
  // `wireframe` must outlive it.
  explicit FilmDrawing(const Wireframe& wireframe);
  explicit FilmDrawing(const Wireframe&&) = delete;

  // Not As::surface. What never moves is dim where something does. `pen`: pixels a line is wide. `ground`: a grid at
  // height 0 beneath it all, and the world's axes in the corner (x red, y green, z blue). Lines behind `covers` are
  // left out.
  void draw(Drawing& drawing, As as, std::uint32_t frame, const wire::Camera& camera, std::uint32_t pen, bool ground,
            std::span<const Cover> covers = {}, const Posed& posed = {}) const;

 private:
  modeler::BentSkin skin_of(const Part& part, std::uint32_t frame, const Posed& posed) const;
  void draw_axes(Drawing& drawing, const wire::Camera& camera, std::uint32_t pen) const;

  const Wireframe& wireframe_;
  Lines grid_;
  bool moving_ = false;  // anything in the film
};

// Half as wide and high, each pixel the mean of four: lines two pixels wide become smooth ones. Sizes are even.
images::Image halved(const images::Image& image);

}  // namespace mars::preview
