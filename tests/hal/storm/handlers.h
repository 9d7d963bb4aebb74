// NX's handlers are plain functions: here one a number, each for all ranks of a program.
#pragma once

#include "hal/nx/nx_messages.h"

namespace mars::storm {

class Rank;

// Whose handlers they are on the rank `id`; nullptr: nobody's.
void handle_for(int id, Rank* rank);

// That call Rank::received and Rank::sent with `number`, 0 to kHandlers - 1.
nx_handler receive_handler(int number);
nx_handler send_handler(int number);

// Returns when all ranks have called it.
void meet();

}  // namespace mars::storm
