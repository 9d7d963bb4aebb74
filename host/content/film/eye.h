// The eyes of a stereo pair (docs/cameras.md); in the middle is the film's camera itself.
#pragma once

namespace mars::film {

enum class Eye { middle, left, right };

}  // namespace mars::film
