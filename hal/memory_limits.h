// What a failure for want of memory or threads says of the limits that whoever started the process gave it.
#pragma once

#include <string>

#include "hal/failure.h"

namespace mars {

// With the process's own limit (ulimit -v or -d), where it has one, named in the problem and to be raised first.
Failure within_limits(const std::string& problem, const std::string& where, const std::string& remedy);

// Of std::bad_alloc.
Failure no_more_memory();
// Of a thread that could not be started.
Failure no_more_threads(const std::string& problem);

}  // namespace mars
