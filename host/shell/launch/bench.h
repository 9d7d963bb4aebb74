// `mars bench`: the benchmarks that were built beside a program, each a program `run` in a folder of its own name in
// BUILD/bench (tests/bench). An installed MARS has none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mars::launch {

// The benchmarks beside `program`, BUILD/bin/mars, as a person reads them. Throws Failure where there are none.
std::string list_benchmarks(const std::filesystem::path& program);

// Becomes that benchmark, with these words for its command line. Throws Failure where it is not there.
[[noreturn]] void run_benchmark(const std::filesystem::path& program, const std::string& name,
                                const std::vector<std::string>& words);

}  // namespace mars::launch
