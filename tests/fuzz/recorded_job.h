// A rendering of a small film by a host and two nodes that lived: what each rank of it received, to be given to a rank
// once more, changed. The nodes share no memory, so that all that can travel does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/render/farm/farm.h"
#include "tests/fuzz/dead_peers.h"
#include "tests/render/film_run.h"

namespace mars::fuzz {

inline constexpr int kNodes = 2;

class RecordedJob {
 public:
  // Of a film with `samples` samples a pixel, and of pixels of `format`.
  RecordedJob(std::uint32_t samples, wire::PixelFormat format, bool traced);

  const test::FilmBlock& film() const { return film_; }
  // Of a rank, as they came; the host's is kNodes.
  const std::vector<Letter>& letters_to(int rank) const { return letters_[static_cast<std::size_t>(rank)]; }
  test::RunOptions options() const;
  bool traced() const { return traced_; }

 private:
  test::FilmBlock film_;
  wire::PixelFormat format_;
  bool traced_;
  std::vector<std::vector<Letter>> letters_;
};

// Hands the letters to `peers`, changed as the script says: edited, left out, sent twice, later, by another rank or
// under another type.
void hand_changed(const std::vector<Letter>& letters, Script& script, DeadPeers& peers);

}  // namespace mars::fuzz
