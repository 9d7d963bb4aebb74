// A film that is open: poses, places and the camera are changed at a frame. Its models are others' files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/studio/project/film_gesture.h"
#include "host/studio/project/work.h"

namespace mars::studio {

class FilmWork : public Work {
 public:
  explicit FilmWork(std::filesystem::path path) : path_(std::move(path)) {}

  const animator::Film& film() const override { return film_; }
  std::uint64_t shapes_revision() const override { return shapes_revision_; }

  void prepare(const std::string& text, bool models_stay) override;
  void accept() override;
  void reject() override;
  std::string text_after(const Step& step, std::uint32_t frame, animator::Remarks& remarks) const override;

  void show(const Step& step, std::uint32_t frame) override;
  void take_back() override { gesture_.take_back(film_); }
  bool shows() const override { return gesture_.shows(); }
  std::set<std::size_t> shown_actors() const override { return gesture_.actors(); }

  bool rig_lights() const override { return !json_.contains("lights"); }
  void describe(Json& project, std::uint32_t frame) const override;
  void describe_shown(Json& poses, std::uint32_t frame) const override;

 private:
  struct Prepared {
    Json json;
    animator::Film film;
    bool models_lent;  // they are film_'s own
  };

  animator::Film read(const document::Element& root, bool models_stay);

  std::filesystem::path path_;
  Json json_;
  animator::Film film_;
  std::optional<Prepared> prepared_;
  std::uint64_t shapes_revision_ = 0;
  FilmGesture gesture_;
};

}  // namespace mars::studio
