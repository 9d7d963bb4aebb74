// mars-window: shows what a rendering or a preview sends in a window. mars starts it.
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/child/standard_streams.h"
#include "host/cli/program.h"
#include "host/window/screen/show.h"

namespace mars::programs {
namespace {

int show(std::string_view shows, const std::string& title) {
  window::Starter starter;
  try {
    window::show(starter, shows == window::kRendering ? window::Shows::rendering : window::Shows::player, title);
    return 0;
  } catch (const Failure& failure) {
    starter.explain(failure.problem, failure.remedy);
  } catch (const std::exception& failure) {
    starter.explain(reason_of(failure), "");
  }
  return cli::kFailed;
}

}  // namespace
}  // namespace mars::programs

int main(int argc, char** argv) {
  using namespace mars;
  child::prepare_standard_streams();
  const std::string_view shows = argc == 3 ? argv[1] : "";
  if (shows == window::kRendering || shows == window::kPlayer) return programs::show(shows, argv[2]);
  std::cerr << "mars-window: shows frames in a window (start it by: mars render FILM -o DIR --window)\n";
  return cli::kUsage;
}
