#include "host/preview/film_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mars::preview {
namespace {

constexpr std::array<As, 4> kAll{As::stick, As::vertices, As::prisms, As::surface};
constexpr double kOrbitStep = 10;  // degrees, of an arrow key
constexpr double kZoom = 1.15;     // of a key

const char* name_of(const std::optional<As>& as) {
  if (!as) return "all four";
  constexpr std::array<const char*, 4> names{"stick", "vertices", "prisms", "surface"};
  return names[static_cast<std::size_t>(*as)];
}

void paste(const images::Image& from, images::Image& to, std::uint32_t x, std::uint32_t y) {
  for (std::uint32_t line = 0; line < from.height; ++line)
    std::copy_n(&from.pixels[std::size_t{line} * from.width], from.width,
                &to.pixels[std::size_t{y + line} * to.width + x]);
}

}  // namespace

FilmPictures::FilmPictures(const Wireframe& wireframe, SurfaceSource& surface, const Look& look) : look_(look) {
  change_film(wireframe, surface);
}

void FilmPictures::change_film(const Wireframe& wireframe, SurfaceSource& surface) {
  wireframe_ = &wireframe;
  surface_ = &surface;
  lines_.emplace(wireframe);
  aim_.reset();
}

wire::Camera FilmPictures::camera(std::uint32_t frame, double aspect) const {
  if (look_.from != From::camera || orbit_) {
    Orbit orbit = orbit_ ? *orbit_ : orbit_from(look_.from, wireframe_->subject, aspect);
    orbit.distance /= zoom_;
    return camera_of(orbit);
  }
  wire::Camera camera = wireframe_->camera_at(frame);
  camera.focal *= zoom_;
  return camera;
}

SharedImage FilmPictures::picture(std::uint32_t frame, images::PictureSize extent) {
  complete_ = true;
  aspect_ = double(extent.width) / extent.height;
  return look_.as ? one(*look_.as, frame, extent) : all(frame, extent);
}

SharedImage FilmPictures::one(As as, std::uint32_t frame, images::PictureSize extent) {
  if (as == As::surface) return rendered(frame, extent);
  return std::make_shared<const images::Image>(drawn(as, frame, extent));
}

images::Image FilmPictures::drawn(As as, std::uint32_t frame, images::PictureSize extent) {
  const std::uint32_t pen = look_.smooth ? 2 : 1;
  const images::Image* old = drawing_ ? &drawing_->image() : nullptr;
  if (old == nullptr || old->width != pen * extent.width || old->height != pen * extent.height)
    drawing_.emplace(pen * extent.width, pen * extent.height);
  lines_->draw(*drawing_, as, frame, camera(frame, double(extent.width) / extent.height), pen, look_.ground, {},
               posed_);
  return look_.smooth ? halved(drawing_->image()) : drawing_->image();
}

SharedImage FilmPictures::rendered(std::uint32_t frame, images::PictureSize extent) {
  Aim aim{extent, std::nullopt};
  if (look_.from != From::camera || orbit_ || zoom_ != 1)
    aim.camera = camera(frame, double(extent.width) / extent.height);
  if (!aim_ || *aim_ != aim) {
    std::vector<std::uint32_t> frames = look_.frames;
    if (frames.empty()) {
      frames.resize(wireframe_->frames);
      std::iota(frames.begin(), frames.end(), 0u);
      std::rotate(frames.begin(), frames.begin() + frame, frames.end());
    }
    surface_->aim(extent, aim.camera, std::move(frames));
    aim_ = aim;
  }
  const SharedImage image = look_.wait ? surface_->wait_for(frame) : surface_->frame(frame);
  complete_ = image != nullptr;
  return image;
}

// In a row where they fit, else two above two.
SharedImage FilmPictures::all(std::uint32_t frame, images::PictureSize extent) {
  const std::uint32_t columns = extent.width >= 2 * extent.height ? 4 : 2;
  const images::PictureSize panel{std::max(extent.width / columns, 1u), std::max(extent.height * columns / 4, 1u)};
  images::Image whole{columns * panel.width, 4 / columns * panel.height, {}};
  whole.pixels.resize(std::size_t{whole.width} * whole.height);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const SharedImage part = one(kAll[i], frame, panel);
    if (part) paste(*part, whole, i % columns * panel.width, i / columns * panel.height);
  }
  return std::make_shared<const images::Image>(std::move(whole));
}

Orbit& FilmPictures::orbit(std::uint32_t frame) {
  if (!orbit_)
    orbit_ = look_.from == From::camera ? orbit_near(wireframe_->camera_at(frame), wireframe_->subject)
                                        : orbit_from(look_.from, wireframe_->subject, aspect_);
  return *orbit_;
}

bool FilmPictures::turn(double degrees, double up, std::uint32_t frame) {
  Orbit& at = orbit(frame);
  at.turn += degrees;
  at.height = std::clamp(at.height + up, -90.0, 90.0);
  return true;
}

bool FilmPictures::look_from(From from) {
  look_.from = from;
  orbit_.reset();
  zoom_ = 1;
  return true;
}

bool FilmPictures::handle_key(const KeyPress& key, std::uint32_t frame) {
  switch (key.special) {
    case Special::left: return turn(-kOrbitStep, 0, frame);
    case Special::right: return turn(kOrbitStep, 0, frame);
    case Special::up: return turn(0, kOrbitStep, frame);
    case Special::down: return turn(0, -kOrbitStep, frame);
    default: break;
  }
  switch (key.character) {
    case '1':
    case '2':
    case '3':
    case '4': look_.as = kAll[static_cast<std::size_t>(key.character - '1')]; return true;
    case '5': look_.as.reset(); return true;
    case 'c': return look_from(From::camera);
    case 'f': return look_from(From::front);
    case 's': return look_from(From::side);
    case 't': return look_from(From::top);
    case '+':
    case '=': zoom_ = std::min(zoom_ * kZoom, 1000.0); return true;
    case '-': zoom_ = std::max(zoom_ / kZoom, 0.001); return true;
    case 'g': look_.ground = !look_.ground; return true;
    default: return false;
  }
}

std::string FilmPictures::state() const {
  constexpr std::array<const char*, 4> from{"camera", "front", "side", "top"};
  std::string text =
      std::string(name_of(look_.as)) + ", " + (orbit_ ? "turned" : from[static_cast<std::size_t>(look_.from)]);
  if (look_.as == As::stick && wireframe_->sticks_of_prisms) text += ", sticks from prisms";
  return text;
}

std::string FilmPictures::keys() const {
  return " 1 stick  2 vertices  3 prisms  4 surface  5 all four  g ground\n"
         " c camera  f front  s side  t top  arrows turn  + - zoom\n";
}

}  // namespace mars::preview
