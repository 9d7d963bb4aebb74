// Composes a film's frames from the strips of its groups, for files and for a watcher; where nodes write the files, it
// counts them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/render/farm/engine.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/group_work.h"
#include "host/render/sinks/busy_time.h"
#include "node/wire/work.h"

namespace mars::farm {

class FilmPictures : public PictureTaker {
 public:
  // All nodes are there.
  explicit FilmPictures(const FilmRun& run);
  explicit FilmPictures(const FilmRun&&) = delete;
  // The first command goes out next.
  void begin();

  bool expects(const wire::Strip& strip, bool is_drawn) const override;
  void take_strip(StripMessage strip) override;
  bool compose() override;
  bool prepare() override;
  void take_drawn(const wire::Strip& drawn) override;
  bool take_written(const wire::Written& written) override;
  void warn(const std::string& text) override;

  std::vector<GroupWork>& groups() { return groups_; }
  GroupWork& group_of(int node) { return groups_[number_of_group(node)]; }
  std::size_t frames_left() const { return frames_left_; }

  // Notes which frames the sinks have now.
  void note_with_sinks();
  bool sinks_have_all() const { return with_sinks_.empty(); }
  // In which nodes were writing at least one file.
  double storing_seconds() const { return storing_.seconds(); }

 private:
  std::uint32_t number_of_group(int node) const { return group_numbers_[static_cast<std::size_t>(node)]; }
  void follow_first_busy();
  void show(const StripMessage& strip, const compositor::Compositor& compositor, const compositor::Frame& frame);
  void submit(const GroupWork::Composed& composed);
  void finish_written(const std::optional<GroupWork::Composed>& frame);
  FinishedFrame finished(const GroupWork::Composed& composed);
  void charge(wire::Work kind, std::uint64_t units);

  const FilmRun& run_;
  watch::Watch* const watch_;     // may be nullptr
  PasteListener paste_listener_;  // of the watch
  std::vector<GroupWork> groups_;
  std::vector<std::uint32_t> group_numbers_;  // of each node
  std::uint32_t followed_ = 0;                // the group whose picture is watched
  std::unordered_map<std::uint32_t, FinishedFrame> with_sinks_;
  std::size_t frames_left_;
  sinks::BusyTime storing_;
};

}  // namespace mars::farm
