#include "host/programs/plot_command.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <memory>

#include "hal/failure/failure.h"
#include "host/content/animator/plot.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_json.h"

extern char** environ;

namespace mars::host {
namespace {

// A file in memory, for a program's input or output.
class Pipe {
 public:
  Pipe() : number_(memfd_create("plot", MFD_CLOEXEC)) {
    if (number_ < 0) throw Failure(std::strerror(errno), "starting gnuplot", "");
  }
  ~Pipe() { close(number_); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int number() const { return number_; }

  void put(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t more = write(number_, text.data() + done, text.size() - done);
      if (more < 0 && errno != EINTR) throw Failure(std::strerror(errno), "starting gnuplot", "");
      if (more > 0) done += static_cast<std::size_t>(more);
    }
    lseek(number_, 0, SEEK_SET);
  }

  std::string content() const {
    std::string bytes(static_cast<std::size_t>(lseek(number_, 0, SEEK_END)), '\0');
    const ssize_t got = pread(number_, bytes.data(), bytes.size(), 0);
    bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return bytes;
  }

 private:
  int number_;
};

std::string drawn_by_gnuplot(const std::string& script) {
  Pipe input, output, errors;
  input.put(script);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.number(), 0);
  posix_spawn_file_actions_adddup2(&actions, output.number(), 1);
  posix_spawn_file_actions_adddup2(&actions, errors.number(), 2);
  std::string name = "gnuplot";
  char* words[] = {name.data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawnp(&process, words[0], &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw Failure(error == ENOENT ? "is not installed" : std::strerror(error), "gnuplot",
                  "install it, on Debian with: apt install gnuplot-nox");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Failure("drew nothing: " + errors.content().substr(0, 300), "gnuplot", "is it version 5 or newer?");
  return output.content();
}

struct Words {
  std::string film, thing, output;
  std::vector<std::string> parts;
};

void plot(const Words& words) {
  const std::filesystem::path output = words.output;
  if (output.extension() != ".png" && output.extension() != ".svg")
    throw Failure("is neither .png nor .svg", words.output, "name the picture like angles.png or angles.svg");
  FilmFile file = open_film(words.film);
  const Choice choice{words.thing.empty(), words.thing, words.parts};
  const PlotAs as = output.extension() == ".png" ? PlotAs::png : PlotAs::svg;
  check_can_write(output);
  const std::string picture = drawn_by_gnuplot(plot_script(file.json, file.film, choice, as));
  write_whole_file(output, picture);
}

}  // namespace

void add_plot(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("plot", "Draw joint angles and places over time, with gnuplot");
  command->add_option("FILM", words->film, "The film file. Example: film.json")->required();
  command->add_option("ACTOR", words->thing, "An actor, or camera; default: all that has keys. Example: robot");
  command->add_option("PART", words->parts, "Only these of its joints, place and turn. Example: elbow shoulder");
  command->add_option("-o,--output", words->output, "The picture, .png or .svg. Example: -o angles.png")
      ->required()
      ->type_name("FILE");
  command->footer("Dots are keys; the band behind a curve is what its joint's limits allow.\n");
  command->callback([words] { plot(*words); });
}

}  // namespace mars::host
