// The Failure that stands for any exception, as exceptions of libraries name no cause and no remedy. Where memory or
// threads ran out it names the process's own limits.
#pragma once

#include <exception>
#include <string>

#include "hal/failure/failure.h"

namespace mars {

Failure explain(const std::exception& reason);
std::string reason_of(const std::exception& failure);

// With the process's own limit (ulimit -v or -d), where it has one, named in the problem and to be raised first.
Failure within_limits(const std::string& problem, const std::string& where, const std::string& remedy);

// Of a thread that could not be started.
Failure no_more_threads(const std::string& problem);

}  // namespace mars
