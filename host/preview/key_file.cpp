#include "host/preview/key_file.h"

#include <algorithm>
#include <iterator>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/document/file.h"
#include "host/content/document/folder_lock.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_json.h"

namespace mars::preview {

animator::Remarks KeyFile::set(const PoseUnderWay& pose, std::uint32_t frame) {
  Change change;
  animator::Remarks remarks;
  film::change_film(path_, [&](document::Json& json, const animator::Film& film) {
    change.before = document::read_file(path_);
    std::map<std::string, std::vector<animator::PartSetting>> figures;
    for (const auto& [names, angles] : pose.angles()) figures[names.first].push_back({"/" + names.second, angles});
    for (const auto& [actor, settings] : figures)
      std::ranges::copy(animator::pose(json, film, actor, settings, frame, {.beyond = animator::Beyond::clamped}),
                        std::back_inserter(remarks));
    change.after = document::laid_out(json);
  });
  changes_.push_back(std::move(change));
  return remarks;
}

bool KeyFile::undo() {
  if (changes_.empty()) return false;
  const document::FolderLock lock(path_);
  if (document::read_file(path_) != changes_.back().after)
    throw Failure("has been changed since the key was set", path_.string(), "undo it where it was changed");
  document::write_whole_file(path_, changes_.back().before);
  changes_.pop_back();
  return true;
}

}  // namespace mars::preview
