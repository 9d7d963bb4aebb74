// A film's pictures in one of its four representations, or all four side by side, seen from where one wishes.
#pragma once

#include <optional>
#include <vector>

#include "host/preview/film_drawing.h"
#include "host/preview/pictures.h"
#include "host/preview/surface_source.h"
#include "host/preview/viewpoint.h"

namespace mars::preview {

struct Look {
  std::optional<As> as = As::prisms;  // none: all four
  From from = From::camera;
  bool ground = true;
  bool smooth = false;                // lines without steps, at four times the work
  bool wait = false;                  // for rendered frames
  std::vector<std::uint32_t> frames;  // that will be asked for; empty: all of them
};

class FilmPictures : public Pictures {
 public:
  // Both must outlive it.
  FilmPictures(const Wireframe& wireframe, SurfaceSource& surface, const Look& look);
  FilmPictures(const Wireframe&&, auto&&...) = delete;

  // What a person's hand changes, from the next picture on.
  void pose(Posed posed) { posed_ = std::move(posed); }

  // Another film from now on, seen as the one before. Both must outlive it.
  void change_film(const Wireframe& wireframe, SurfaceSource& surface);

  std::uint32_t frames() const override { return wireframe_->frames; }
  double rate() const override { return wireframe_->rate; }
  images::PictureSize extent() const override { return {wireframe_->width, wireframe_->height}; }
  SharedImage picture(std::uint32_t frame, images::PictureSize extent) override;
  bool complete() const override { return complete_; }
  bool handle_key(const KeyPress& key, std::uint32_t frame) override;
  std::string state() const override;
  std::string keys() const override;

  // Where the film is seen from at a frame.
  wire::Camera camera(std::uint32_t frame, double aspect) const;

 private:
  struct Aim {
    images::PictureSize extent;
    std::optional<wire::Camera> camera;

    bool operator==(const Aim&) const = default;
  };

  images::Image drawn(As as, std::uint32_t frame, images::PictureSize extent);
  SharedImage rendered(std::uint32_t frame, images::PictureSize extent);
  SharedImage one(As as, std::uint32_t frame, images::PictureSize extent);
  SharedImage all(std::uint32_t frame, images::PictureSize extent);
  bool turn(double degrees, double up, std::uint32_t frame);
  bool look_from(From from);
  Orbit& orbit(std::uint32_t frame);

  const Wireframe* wireframe_ = nullptr;
  SurfaceSource* surface_ = nullptr;
  std::optional<FilmDrawing> lines_;  // of view_
  Posed posed_;
  Look look_;
  std::optional<Orbit> orbit_;  // where a person went from look_.from
  double zoom_ = 1;
  bool complete_ = true;
  double aspect_ = 1;  // of the last picture
  std::optional<Drawing> drawing_;
  std::optional<Aim> aim_;
};

}  // namespace mars::preview
