// What a page has selected.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mars::studio {

// The film's camera, or one of its lights.
struct Mark {
  std::optional<std::size_t> light{};  // none: the camera

  bool operator==(const Mark&) const = default;
};

// A figure or its joint, or a mark, or nothing.
struct Selection {
  std::optional<std::size_t> actor{};
  std::optional<std::size_t> joint{};  // none: the actor as a whole
  std::optional<Mark> mark{};          // there is no actor beside it
  std::vector<std::size_t> more{};     // joints of the actor beside `joint`, which its rings turn, too

  bool operator==(const Selection&) const = default;
};

}  // namespace mars::studio
