// Makes a C program with a main function of its own, which knows nothing of jobs, a rank of one: its first NX call, or
// its end, connects it, and exit() disconnects it in order. Linked into libmars-nx only.
#pragma once

#include "hal/messages/process.h"
#include "hal/messages/world.h"

namespace mars::program {

// The calling program's job; connects it. A Failure on any thread but the first that called.
messages::World& world();

// The next message call makes a new process for the program, with nothing sent or received: after the cube
// has changed.
void renew_process();

}  // namespace mars::program
