// The joints that a person can pose, in the order in which keys step through them.
#pragma once

#include <optional>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/preview/wireframe.h"

namespace mars::preview {

class JointOrder {
 public:
  // Each joint before those below it. Figures that move in the film come first; figures that matrices move, and joints
  // without freedom, are left out.
  explicit JointOrder(const animator::Film& film);
  explicit JointOrder(const animator::Film&&) = delete;

  bool empty() const { return joints_.empty(); }
  // The one after `from`, or with `by` -1 the one before, round and round; from none the first, or the last.
  JointNumber beside(const std::optional<JointNumber>& from, int by) const;
  // The next one above it in the tree, or the first below it; itself where there is none.
  JointNumber above(const JointNumber& joint) const;
  JointNumber below(const JointNumber& joint) const;

 private:
  void add(std::size_t actor);

  const animator::Film& film_;
  std::vector<JointNumber> joints_;
};

}  // namespace mars::preview
