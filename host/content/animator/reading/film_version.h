// Which version of the format a film file needs.
#pragma once

#include "host/content/document/json_file.h"

namespace mars::animator {

// Makes "version": 2 its first key if it holds something of version 2: splines, values that hold, parts of keys with an
// ease or slopes of their own, attachments, points of actors. A film that needs none stays as it is.
void write_version(document::Json& film);

// Whether that would change it.
bool needs_newer_version(const document::Json& film);

}  // namespace mars::animator
