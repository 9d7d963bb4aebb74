// Work in a process of its own: a library that crashes or never ends at a damaged file takes nothing with it.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "hal/failure.h"

namespace mars::host {

// What `work` returns; its Failure is thrown here. Throws `lost` where the process dies or needs more than so much
// processor time.
std::string run_apart(const std::function<std::string()>& work, std::chrono::seconds most, const Failure& lost);

}  // namespace mars::host
