// Onion skin: how figures stand at the frames around the one that is shown, and the way of a joint through them, as
// handles to be drawn below all others (docs/studio-protocol.md, "Ghosts").
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "host/content/animator/pose/actor_state.h"
#include "host/studio/stage/handles.h"
#include "host/studio/stage/moments.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

// How many ghosts are shown before and after the frame, and how many frames apart.
struct GhostFrames {
  int before = 0, after = 0, step = 1;

  bool any() const { return before > 0 || after > 0; }
  bool operator==(const GhostFrames&) const = default;
};

class Ghosts {
 public:
  // Both must outlive it.
  Ghosts(const Project& project, const Moments& moments) : project_(project), moments_(moments) {}
  Ghosts(const Project&&, auto&&...) = delete;
  Ghosts(auto&&, const Moments&&) = delete;

  // Of the selected actor; where none is selected, of all that move. Back to front, then the trail. Made only where
  // something is another than the last time for the same view.
  const std::vector<Handle>& handles(std::uint32_t view, const GhostFrames& frames, const Selection& selection,
                                     const Screen& screen);

 private:
  using States = std::map<std::uint32_t, animator::ActorState>;  // by frame
  struct Placed {
    double depth;
    Handle handle;
  };

  struct Seen {
    std::uint64_t moment = 0;
    GhostFrames frames{};
    Selection selection{};
    Screen screen;

    bool operator==(const Seen&) const = default;
  };

  std::vector<Handle> make_handles(const Seen& seen);
  void follow_project();
  const animator::ActorState& state_of(std::size_t actor, std::uint32_t frame);
  std::vector<std::size_t> actors_near(const Selection& selection) const;
  void add_ghost(std::size_t actor, std::uint32_t frame, const Screen& screen, std::vector<Placed>& ghosts);
  void add_trail(const GhostFrames& frames, const Selection& selection, const Screen& screen,
                 std::vector<Handle>& handles);
  const std::vector<glm::dvec3>& points_of(std::size_t segment);

  const Project& project_;
  const Moments& moments_;
  std::map<std::uint32_t, std::pair<Seen, std::vector<Handle>>> shown_;  // by views
  std::uint64_t revision_ = 0, film_number_ = 0;
  std::vector<States> states_;                               // of actors, as they are needed
  std::vector<std::size_t> first_segments_;                  // of actors
  std::map<std::uint32_t, std::vector<glm::dvec3>> points_;  // of shapes
};

}  // namespace mars::studio
