// The keys of actors: what they have, what their keys may have, what goes along with them.
#pragma once

#include "host/content/keys/key.h"

namespace mars::keys {

Object actor();
Object matrices_key();
Object part();    // of a key
Object point();   // that goes along with an actor
Object attach();  // what carries an actor

}  // namespace mars::keys
