// A film that is open: poses, places and the camera are changed at a frame. Its models are others' files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "host/editing/film_in_memory.h"
#include "host/studio/project/film_gesture.h"
#include "host/studio/project/work.h"

namespace mars::studio {

class FilmWork : public Work {
 public:
  // Files that steps name must be below `folder`.
  FilmWork(std::filesystem::path path, std::filesystem::path folder)
      : path_(std::move(path)), folder_(std::move(folder)) {}

  const animator::Film& film() const override { return edited_ ? edited_->film() : film_; }
  std::uint64_t shapes_revision() const override { return shapes_revision_; }

  void prepare(const std::string& text, bool models_stay) override;
  void accept() override;
  void reject() override;
  std::string text_after(const Step& step, std::uint32_t frame, animator::Remarks& remarks) override;

  void show(const Step& step, std::uint32_t frame) override;
  void take_back() override;
  bool shows() const override { return gesture_.shows() || edited_; }
  std::set<std::size_t> shown_actors() const override;

  Json channels(const std::vector<std::string>& things) override;
  Json curves(const CurvesWanted& wanted) override;
  bool rig_lights() const override { return !json().contains("lights"); }
  void describe(Json& project, std::uint32_t frame) const override;
  void describe_shown(Json& poses, std::uint32_t frame) const override;

 private:
  struct Prepared {
    Json json;
    animator::Film film;
    bool models_lent;  // they are film_'s own
  };

  const Json& json() const { return edited_ ? edited_->json() : json_; }  // what film() means
  animator::Film read(const document::Element& root, bool models_stay);
  std::unique_ptr<editing::FilmInMemory> edited_by(const Step& step);
  void show_edited(std::unique_ptr<editing::FilmInMemory> edited);
  bool shows_other_shapes() const;

  std::filesystem::path path_, folder_;
  Json json_;
  animator::Film film_;
  std::optional<Prepared> prepared_;
  std::uint64_t shapes_revision_ = 0;
  FilmGesture gesture_;
  std::unique_ptr<editing::FilmInMemory> edited_;  // what commands show; else null
};

}  // namespace mars::studio
