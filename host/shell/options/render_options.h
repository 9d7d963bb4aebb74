// What a person may ask of a rendering, in the same words for every program that renders: `mars render`,
// and the programs it starts or a person starts instead. One table holds every option's name, help, programs
// and both directions: from a command line and to the command line of the program started next.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/command.h"
#include "host/images/display_view.h"
#include "host/images/frame_form.h"
#include "host/shell/options/render_wish.h"

namespace mars::options {

// Adds the options `program` takes to its command line, which is then checked as a whole too; `options` must
// outlive the parsing.
void add_render_options(cli::Command app, RenderOptions& options, Program program);

// Reads the whole command line of a program that does nothing but render; `purpose` heads its help. As
// read_command_line.
std::optional<int> read_render_options(Program program, const char* name, const char* purpose, RenderOptions& options,
                                       int argc, const char* const* argv);

// Throws Failure where the nodes are more than 64 for each of `cores`, which is likely to be a slip, unless --force is
// given. Not for simulated nodes, which take turns.
void check_nodes(const RenderOptions& options, std::uint32_t cores);

// A file's name as a word of a command line: one that begins with a dash would be taken for an option, and mpirun takes
// a colon for the end of a program's arguments.
inline std::string word_of_file(const std::string& name) {
  return name.starts_with('-') || name == ":" ? "./" + name : name;
}

// Whether a rendering is to be measured: then it renders.
bool measures(const RenderOptions& options);

// Where the frames of a video alone are, in the video's working folder.
std::filesystem::path frames_in(const std::filesystem::path& work);

// The options that change the compiled film, as arguments.
std::vector<std::string> film_arguments(const RenderOptions& options);

// The view that shows light; nullptr: the film's curve does. Throws Failure as images::open_view does.
std::shared_ptr<const images::DisplayView> view_of(const RenderOptions& options);

// How the files of frames are made, from the options and back. Throws Failure as view_of() does.
images::FrameForm form_of(const RenderOptions& options);
void set_form(const images::FrameForm& form, RenderOptions& options);

// The arguments that make `program` read these options again, those it takes; defaults are left out.
std::vector<std::string> arguments_for(Program program, const RenderOptions& options);

}  // namespace mars::options
