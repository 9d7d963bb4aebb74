// The control points of nets as bones move them, and the Bezier points that are means of these: each computed when it
// is first asked for, so a node computes what its own patches take. A point is `kNumbers` numbers: its place, or what
// else has means.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/wire/film.h"

namespace mars::geometry {

template <typename Real, std::size_t kNumbers>
class NetPoints {
 public:
  using Place = std::array<Real, kNumbers>;

  // Forgets all; takes room for the film's nets at the first call only.
  void start(const wire::PackedFilm& film) {
    points_.resize(film.net_points().size());
    bezier_.resize(film.stencils().size());
    if (++round_ > 0) return;
    for (auto* places : {&points_, &bezier_})
      for (Known& known : *places) known.round = 0;
    round_ = 1;
  }

  // A Bezier point, where `move` puts a control point: a Place of a wire::NetPoint. The sum begins with 0
  // and follows the stencil.
  template <typename Move>
  const Place& bezier(const wire::PackedFilm& film, std::uint32_t stencil, const Move& move) {
    Known& known = bezier_[stencil];
    if (known.round == round_) return known.place;
    known.round = round_;
    known.place = {};
    for (const wire::StencilTerm& term : film.terms_of(film.stencils()[stencil])) {
      const Place& point = moved(film, term.point, move);
      for (std::size_t axis = 0; axis < point.size(); ++axis) known.place[axis] += Real{term.weight} * point[axis];
    }
    return known.place;
  }

 private:
  struct Known {
    Place place;
    std::uint32_t round = 0;  // when it was computed
  };

  template <typename Move>
  const Place& moved(const wire::PackedFilm& film, std::uint32_t point, const Move& move) {
    Known& known = points_[point];
    if (known.round == round_) return known.place;
    known.round = round_;
    known.place = move(film.net_points()[point]);
    return known.place;
  }

  std::vector<Known> points_;
  std::vector<Known> bezier_;
  std::uint32_t round_ = 0;
};

}  // namespace mars::geometry
