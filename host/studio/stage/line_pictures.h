// Views of sticks, control vertices and prisms (thesis, figure 2.6), drawn here by the preview from the moment's
// matrices; and where a picture differs from the one before.
#pragma once

#include <deque>
#include <map>
#include <span>
#include <vector>

#include "host/preview/film_drawing.h"
#include "host/render/pictures/reading.h"
#include "host/studio/project/project.h"
#include "host/studio/stage/moments.h"

namespace mars::studio {

struct LineLook {
  preview::As as = preview::As::stick;  // not As::surface
  bool hidden = false;                  // lines behind surfaces are left out; of sticks, which run within, none
  bool ground = true;
};

class LinePictures {
 public:
  // Both must outlive it.
  LinePictures(const Project& project, const Moments& moments) : project_(project), moments_(moments) {}
  LinePictures(const Project&&, auto&&...) = delete;
  LinePictures(auto&&, const Moments&&) = delete;

  // The moment as it is now.
  void draw(const LineLook& look, const wire::Camera& camera, preview::Drawing& drawing);

 private:
  void take_segments(preview::As as, preview::Wireframe& wireframe);
  void take_bones(preview::Wireframe& wireframe);
  void take_sticks(preview::Wireframe& wireframe);
  std::uint32_t net_of(std::size_t segment, preview::Wireframe& wireframe);
  const preview::Facets& facets_of(std::size_t segment);
  std::vector<preview::Cover> covers_of(preview::As as, const preview::Wireframe& wireframe);
  bool pulled(std::size_t segment) const;

  const Project& project_;
  const Moments& moments_;
  std::uint64_t film_number_ = 0;
  preview::Wireframe
      nets_;  // of control vertices: the pulled shape's, then those of the film's shapes as they are needed
  std::map<std::uint32_t, std::uint32_t> net_numbers_;  // of shapes
  std::map<std::uint32_t, preview::Facets> facets_;     // of shapes, as they are needed
  preview::Facets pulled_facets_;
  std::deque<preview::Facets> bent_facets_;  // of skins, in the world
};

// The blocks of 16 pixels each way that differ, joined to rectangles that do not overlap; all where there was no
// picture of this size before.
std::vector<pictures::Rect> changed_rects(const images::Image& before, const images::Image& now);

}  // namespace mars::studio
