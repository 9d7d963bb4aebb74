// Frames of a folder (host/render/sinks/frame_folder.h) as they are shown. Light, of EXR files, is exposed and encoded
// as the film says that the folder keeps, or as a person does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host/content/film/compiled_film.h"
#include "host/images/display_view.h"
#include "host/render/sinks/manifest.h"
#include "host/videos/source.h"
#include "node/wire/film_parts.h"

namespace mars::videos {

struct Exposing {
  std::optional<double> stops{};                      // of exposure, at all frames; none: the film's
  std::optional<wire::Curve> curve{};                 // none: the film's
  std::shared_ptr<const images::DisplayView> view{};  // in place of the curve; none: the curve

  bool operator==(const Exposing&) const = default;
};

class FolderReader {
 public:
  // Throws Failure where the folder has no manifest; where its frames are light, but there is no film.mars of theirs,
  // and `exposing` does not say all; and where they are no light, but `exposing` says something.
  explicit FolderReader(std::filesystem::path folder, const Exposing& exposing = {});

  const sinks::Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& folder() const { return folder_; }
  // From any thread. Throws sinks::DamagedFrame where its file is missing, torn or of another size.
  images::Image read(std::uint32_t frame) const;
  // What decides how a frame is shown.
  std::string content(std::uint32_t frame) const;

 private:
  images::Image picture_of(const std::filesystem::path& file, std::uint32_t frame) const;
  wire::FilmSettings settings_at(std::uint32_t frame, wire::Camera& camera) const;
  images::Image expose(const images::Image& light, std::uint32_t frame) const;

  std::filesystem::path folder_;
  sinks::Manifest manifest_;
  Exposing exposing_;
  std::optional<film::CompiledFilm> film_;  // of EXR files
};

// These frames of the folder, whose reader must outlive the source.
Source source_of(const FolderReader& reader, std::vector<std::uint32_t> frames);

}  // namespace mars::videos
