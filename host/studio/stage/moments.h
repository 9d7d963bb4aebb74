// The project's film at the frame that is shown, as a scene for the renderer: bit for bit what the compiled film has
// there (host/content/film/moment.h). And the film's shapes, which nodes load once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/film/moment.h"
#include "host/content/modeler/bent_skin.h"
#include "host/preview/wireframe.h"
#include "host/studio/project/project.h"

namespace mars::studio {

// Whose segment it is.
struct Owner {
  std::size_t actor;
  std::size_t joint;
};

// Whether it may change over the film: it has two keys of anything, or may be carried.
bool moves(const animator::Actor& actor);

class Moments {
 public:
  // It must outlive it.
  explicit Moments(const Project& project) : project_(project) {}
  explicit Moments(const Project&&) = delete;

  // Follows the project. A film that shows nothing at this frame leaves what was; `problem` then says why.
  void renew();
  const std::string& problem() const { return problem_; }
  // What is here is the film as it is now. If not, the film may have lost the actors that are seen here.
  bool show_the_film() const { return film_number_ > 0 && problem_.empty(); }

  // Goes up with each other film that nodes must load; 0: there is none yet.
  std::uint64_t film_number() const { return film_number_; }
  std::shared_ptr<const std::vector<std::byte>> film_block() const { return film_block_; }
  // Goes up whenever now() changes.
  std::uint64_t number() const { return number_; }

  // With the film's own camera and size. A shape that is being pulled is the scene's own, behind the film's.
  const wire::FilmData& now() const { return *now_; }
  const std::shared_ptr<const wire::FilmData>& shared_now() const { return now_; }
  const wire::FilmData& shapes() const { return shapes_.parts; }
  const std::vector<Owner>& owners() const { return owners_; }  // of now()'s segments
  const wire::Matrix& matrix_of(std::size_t segment) const { return now_->matrices[segment]; }
  const wire::Matrix& bone_of(const wire::Segment& segment, std::size_t bone) const {
    return now_->matrices[now_->changes[now_->bones[segment.first_bone + bone].first].value];
  }
  // Of a segment with a skin, where the vertices of a meshlet of its shape are in the world.
  std::vector<std::array<float, 3>> bent_places(std::size_t segment, const wire::Meshlet& meshlet) const;
  // The same of its patches.
  std::vector<wire::Patch> bent_patches(std::size_t segment) const;
  // What a point of its patch follows most: a number in the list of the segment's bones.
  std::uint32_t bone_at(std::size_t segment, std::size_t patch, std::size_t point) const;
  // The patches of a segment's shape, wherever they are.
  std::span<const wire::Patch> patches_of(std::size_t segment) const;
  // What moves or is a model; else figures; else everything. Of a film that is not shown the ball of one unit.
  preview::Ball subject() const;
  // Of segments that count; none where none does.
  std::optional<preview::Ball> ball_of(const std::function<bool(const Owner&)>& counts) const;

  // What moves in the film's own interval that has the frame: only with this is a picture the film's own. None where
  // the film is too long to know it at once.
  std::optional<std::span<const std::uint32_t>> own_moving();

 private:
  void load_shapes();
  void take_moment();
  void put_pulled(wire::FilmData& moment) const;
  const wire::Shape& shape_of(std::size_t segment) const;
  std::vector<std::array<float, 3>> bent(std::size_t segment, const wire::Skin& skin,
                                         std::span<const std::array<float, 3>> points) const;
  modeler::BentSkin bones_of(std::size_t segment) const;
  bool is_short() const;

  const Project& project_;
  std::string problem_;
  std::uint64_t film_number_ = 0, number_ = 0;
  std::optional<std::uint64_t> shapes_revision_, revision_;
  std::uint32_t frame_ = 0;
  film::FilmShapes shapes_;
  std::shared_ptr<const std::vector<std::byte>> film_block_;
  std::shared_ptr<const wire::FilmData> now_ = std::make_shared<wire::FilmData>();
  std::vector<Owner> owners_;
  std::optional<film::Cut> cut_;  // of the film as it is at cut_revision_
  std::uint64_t cut_revision_ = 0;
};

}  // namespace mars::studio
