// Angles of joints over the frames as a picture: the script for gnuplot. A panel a part, a curve for each
// axis that is free, dots at keys, the limits as a band: a curve that leaves its band leaves its limits.
#pragma once

#include <string>

#include "host/content/animator/keys/things.h"

namespace mars::animator {

enum class PlotAs { png, svg };

// The script for gnuplot, whose standard output is then the picture. Without parts: of the chosen thing all that
// has keys. Throws where nothing is keyed, or more than would be legible.
std::string plot_script(document::Json& film, const Film& meaning, const Choice& choice, PlotAs as);

}  // namespace mars::animator
