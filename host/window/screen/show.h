// What the window's program does from its start to its end: shows what comes over its connection.
#pragma once

#include <string>

#include "host/window/screen/starter.h"
#include "host/window/window_process.h"

namespace mars::window {

// Until a person closes the window, or the player has ended. Tells the starter that there is a display; throws Failure
// if there is none.
void show(Starter& starter, Shows shows, const std::string& title);

}  // namespace mars::window
