// A film that is open: poses, places and the camera are changed at a frame. Its models are others' files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "host/editing/film_in_memory.h"
#include "host/studio/project/work.h"

namespace mars::studio {

class FilmWork : public Work {
 public:
  // Files that steps name must be below `folder`.
  FilmWork(std::filesystem::path path, std::filesystem::path folder)
      : path_(std::move(path)), folder_(std::move(folder)) {}

  const animator::Film& film() const override { return film_; }
  std::uint64_t shapes_revision() const override { return shapes_revision_; }

  void prepare(const std::string& text, bool models_stay) override;
  void accept() override;
  void reject() override;

  animator::Remarks show(const Step& step, For what) override;
  void take_back() override;
  void keep() override;
  bool shows() const override { return shown_.has_value(); }
  std::string text() const override { return document::laid_out(json_); }
  std::set<std::size_t> shown_actors() const override { return edited_->changed_actors(); }

  Json channels(const std::vector<std::string>& things) override;
  Json curves(const CurvesWanted& wanted) override;
  bool rig_lights() const override { return !json_.contains("lights"); }
  bool has_keys(const std::string& thing, const std::string& part) const override;
  void describe(Json& project, std::uint32_t frame) const override;
  void describe_shown(Json& poses, std::uint32_t frame) const override;

 private:
  struct Prepared {
    Json json;
    animator::Film film;
    bool models_lent;  // they are film_'s own
  };

  animator::Film read(const document::Element& root, bool models_stay);
  void execute(const Step& step, For what);
  bool shows_other_shapes() const;

  std::filesystem::path path_, folder_;
  Json json_;
  animator::Film film_;
  std::optional<Prepared> prepared_;
  std::uint64_t shapes_revision_ = 0;
  std::optional<Step> shown_;
  std::unique_ptr<editing::FilmInMemory> edited_;  // while a step is shown
};

}  // namespace mars::studio
