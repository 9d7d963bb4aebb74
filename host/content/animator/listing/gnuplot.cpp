#include "host/content/animator/listing/gnuplot.h"

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/environment.h"
#include "host/child/process.h"
#include "host/child/programs.h"

namespace mars::animator {

std::string draw_with_gnuplot(const std::string& script) {
  const auto program = child::find_program("gnuplot", child::program_path(child::own_environment()));
  if (!program) throw Failure("is not installed", "gnuplot", "install it, on Debian with: apt install gnuplot-nox");
  const child::Descriptor input = child::file_in_memory(script), output = child::file_in_memory(),
                          errors = child::file_in_memory();
  child::Process process(child::Command{{}, {program->string()}},
                         {.streams = {{0, input.number()}, {1, output.number()}, {2, errors.number()}}});
  if (!process.wait().well())
    throw Failure("drew nothing: " + child::content_of(errors).substr(0, 300), "gnuplot", "is it version 5 or newer?");
  return child::content_of(output);
}

}  // namespace mars::animator
