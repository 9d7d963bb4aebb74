// The environment variable MUTANT_OF_MARS says which mutant a process is. The variable's name does not begin with
// MARS_, because MARS warns of variables of such names that it does not know. Each object has its own copy of all this,
// because kernels are compiled for several instruction sets.
#pragma once

#include <cstdlib>

namespace mutants {
namespace {

int chosen = -1;  // until the environment was read

[[maybe_unused]] inline bool on(int number) {
  int known = __atomic_load_n(&chosen, __ATOMIC_RELAXED);
  if (known < 0) {
    const char* text = std::getenv("MUTANT_OF_MARS");
    known = text == nullptr ? 0 : std::atoi(text);
    __atomic_store_n(&chosen, known, __ATOMIC_RELAXED);
  }
  return known == number;
}

}  // namespace
}  // namespace mutants
