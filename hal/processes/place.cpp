#include "hal/processes/place.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"

namespace mars::processes {

void leave_place(const Place& place) {
  const std::string text =
      std::to_string(place.index) + "," + std::to_string(place.segment) + "," + std::to_string(place.socket);
  setenv(messages::kPlaceSetting, text.c_str(), 1);
}

std::optional<Place> take_place() {
  const std::optional<std::string> text = messages::take_place_text();
  if (!text) return std::nullopt;
  Place place;
  if (std::sscanf(text->c_str(), "%d,%d,%d", &place.index, &place.segment, &place.socket) != 3)
    throw Failure("\"" + *text + "\" is no place in a job",
                  std::string("environment variable ") + messages::kPlaceSetting, "unset it");
  return place;
}

}  // namespace mars::processes
