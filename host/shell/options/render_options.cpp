#include "host/shell/options/render_options.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/document/work_folder.h"
#include "host/images/frame_names.h"
#include "host/images/layers.h"
#include "host/cli/program.h"
#include "host/shell/options/render_checks.h"
#include "host/shell/options/video_options.h"
#include "node/wire/film.h"

namespace mars::options {

namespace {

using Arguments = std::vector<std::string>;

struct Entry {
  unsigned programs;  // Program bits
  std::function<void(cli::Command, RenderOptions&)> add;
  std::function<Arguments(const RenderOptions&)> write;
};

// One word for each value of an enumeration, in its order from 0.
template <typename Enumeration>
constexpr std::array<const char*, 0> kWords{};
template <>
constexpr std::array kWords<Backend>{"auto", "mpi", "threads", "simulated"};
template <>
constexpr std::array kWords<Intervals>{"auto", "keyframes"};
template <>
constexpr std::array kWords<film::Eye>{"middle", "left", "right"};
template <>
constexpr std::array kWords<SinkKind>{"files", "none"};
template <>
constexpr std::array kWords<WriteWhere>{"auto", "host", "nodes"};
template <>
constexpr std::array kWords<images::PictureFormat>{"png", "png16", "exr"};
template <>
constexpr std::array kWords<images::Compression>{"zip", "zips", "piz", "pxr24", "rle", "none"};
template <>
constexpr std::array kWords<wire::Mapping>{"greedy", "optimal", "cost"};
template <>
constexpr std::array kWords<wire::Exchange>{"auto", "send", "again"};

template <typename Enumeration>
requires std::is_enum_v<Enumeration>
void read(const std::string& text, Enumeration& value) {
  const auto& words = kWords<Enumeration>;
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) throw Failure("'" + text + "' is not " + document::joined(words, " or "), "", "");
  value = static_cast<Enumeration>(found - words.begin());
}

void read(const std::string& text, std::string& value) { value = text; }

void read(const std::string& text, film::FrameSet& value) { value = film::FrameSet(text); }

void read(const std::string& text, std::optional<images::PictureSize>& value) {
  value = images::read_picture_size(text);
}

void read(const std::string& text, std::optional<film::Crop>& value) { value = film::read_crop(text); }

// Samples of a pixel.
void read(const std::string& text, std::optional<std::uint32_t>& value) {
  value = document::number_in<std::uint32_t>(text).value_or(0);
  if (!std::has_single_bit(*value) || *value > wire::kMostSamples)
    throw Failure("'" + text + "' is not 1, 2, 4, 8 or 16", "", "");
}

void read(const std::string& text, ChosenLayers& value) { value.kinds = images::layers_in(text); }

struct Count {
  std::uint32_t RenderOptions::*member;
  bool may_be_auto;  // the word "auto" is 0
  std::uint32_t most;
  std::uint32_t least = 1;
};

void read_count(const std::string& text, const Count& count, RenderOptions& options) {
  std::uint32_t& value = options.*count.member;
  if (count.may_be_auto && text == "auto") {
    value = 0;
    return;
  }
  const auto number = document::number_in<std::uint32_t>(text);
  value = number.value_or(0);
  if (!number || value < count.least || value > count.most) {
    throw Failure("'" + text + "' is not a number from " + std::to_string(count.least) + " to " +
                      std::to_string(count.most) + (count.may_be_auto ? " or auto" : ""),
                  "", "");
  }
}

template <typename Enumeration>
requires std::is_enum_v<Enumeration> std::string text_of(Enumeration value) {
  return kWords<Enumeration>[static_cast<std::size_t>(value)];
}

std::string text_of(const std::string& name) { return word_of_file(name); }

std::string text_of(const ChosenLayers& layers) { return images::text_of(layers.kinds); }

std::string text_of(const film::FrameSet& frames) { return frames.text(); }

std::string text_of(const std::optional<images::PictureSize>& size) {
  return std::to_string(size->width) + "x" + std::to_string(size->height);
}

std::string text_of(const std::optional<film::Crop>& crop) { return film::text_of(*crop); }

std::string text_of(const std::optional<std::uint32_t>& number) { return std::to_string(*number); }

// The name the program started next is given: the short one where there is one.
std::string first_name(const char* names) {
  const std::string_view all = names;
  return std::string(all.substr(0, all.find(',')));
}

template <typename Value>
Entry option(unsigned programs, const char* names, const char* type, Value RenderOptions::*member, const char* help) {
  return {programs,
          [=](cli::Command app, RenderOptions& options) {
            const auto take = [&options, member](const std::string& text) { read(text, options.*member); };
            app.add_read(names, take, help).type(type);
          },
          [=](const RenderOptions& options) -> Arguments {
            if (options.*member == RenderOptions().*member) return {};
            return {first_name(names), text_of(options.*member)};
          }};
}

// The word names no file: one that begins with a dash would be taken for an option.
Arguments word_for(const char* name, const std::string& word) {
  if (word.empty()) return {};
  if (word.starts_with('-') || word == ":") return {std::string(name) + "=" + word};
  return {name, word};
}

// The name of frames' files.
Entry frames_name(unsigned programs, const char* name, const char* help) {
  return {programs, [=](cli::Command app, RenderOptions& options) { app.add(name, options.name, help).type("NAME"); },
          [=](const RenderOptions& options) { return word_for(name, options.name); }};
}

// A word of the view.
Entry word_of_view(unsigned programs, const char* name, const char* type, std::string images::ViewWish::*member,
                   const char* help) {
  return {programs,
          [=](cli::Command app, RenderOptions& options) { app.add(name, options.view.*member, help).type(type); },
          [=](const RenderOptions& options) { return word_for(name, options.view.*member); }};
}

Entry number(unsigned programs, const char* names, const Count& count, const char* help) {
  return {programs,
          [=](cli::Command app, RenderOptions& options) {
            const auto read = [&options, count](const std::string& text) { read_count(text, count, options); };
            app.add_read(names, read, help).type("N");
          },
          [=](const RenderOptions& options) -> Arguments {
            const std::uint32_t value = options.*count.member;
            if (value == RenderOptions().*count.member) return {};
            return {first_name(names), std::to_string(value)};
          }};
}

Entry flag(unsigned programs, const char* names, bool RenderOptions::*member, const char* help) {
  return {programs, [=](cli::Command app, RenderOptions& options) { app.add_flag(names, options.*member, help); },
          [=](const RenderOptions& options) -> Arguments {
            if (!(options.*member)) return {};
            return {first_name(names)};
          }};
}

// Videos are made of the frames by mars render itself; what it starts knows of none.
void read_output(const std::string& word, bool makes_videos, RenderOptions& options) {
  const bool video = videos::is_video_name(word) && !std::filesystem::is_directory(word);
  if (video && !makes_videos) throw Failure("mars render makes videos; here frames need a folder", "", "");
  if (video && std::ranges::find(options.videos, word) != options.videos.end())
    throw Failure("'" + word + "' is given twice", "", "");
  if (video) return options.videos.push_back(word);
  if (!options.folder.empty()) throw Failure("frames go into one folder; give -o DIR once", "", "");
  options.folder = word;
}

void read_outputs(RenderOptions& options, bool makes_videos) {
  for (const std::string& word : std::exchange(options.outputs, {})) read_output(word, makes_videos, options);
  if (!options.folder.empty() || options.videos.empty()) return;
  options.folder = frames_in(document::work_folder_of(options.videos.front())).string();
  options.own_folder = true;
}

// Whether the last part of a folder's name means files: a folder's own name may have a single #.
bool names_files(const std::filesystem::path& folder) {
  const std::string last = folder.filename().string();
  const bool plain =
      !images::is_picture_name(folder) && last.find("##") == std::string::npos && last.find('%') == std::string::npos;
  return !plain && images::has_number(last) && !std::filesystem::is_directory(folder);
}

// For the program started next, which must take no own folder, as of a##.mp4, for names of files.
std::string word_of_folder(const std::string& folder) { return text_of(names_files(folder) ? folder + "/" : folder); }

Entry output(unsigned programs, const char* type, const char* help) {
  return {programs,
          [=](cli::Command app, RenderOptions& options) {
            app.add("-o,--output", options.outputs, help).repeated().type(type);
          },
          [=](const RenderOptions& options) {
            const bool makes_videos = (programs & static_cast<unsigned>(Program::mars)) != 0;
            Arguments arguments;
            if (!options.folder.empty() && !(makes_videos && options.own_folder))
              arguments.insert(arguments.end(), {"-o", word_of_folder(options.folder)});
            if (makes_videos)
              for (const std::string& video : options.videos) arguments.insert(arguments.end(), {"-o", text_of(video)});
            return arguments;
          }};
}

Entry video_form(unsigned programs) {
  return {programs, [](cli::Command app, RenderOptions& options) { add_video_form(app, options.video_form); },
          [](const RenderOptions& options) {
            const auto& [codec, quality] = options.video_form;
            Arguments arguments;
            if (!codec.empty()) arguments.insert(arguments.end(), {"--codec", codec});
            if (quality) arguments.insert(arguments.end(), {"--quality", std::to_string(*quality)});
            return arguments;
          }};
}

// A host that serves a studio needs none.
Entry film(unsigned programs, bool required) {
  return {programs,
          [required](cli::Command app, RenderOptions& options) {
            const cli::Option film = app.add("FILM", options.film,
                                             "The film to render: a .json file, or a .mars file made by mars compile.\n"
                                             "Example: examples/demo.json");
            if (required) film.required();
          },
          [](const RenderOptions& options) {
            return options.serve.empty() ? Arguments{text_of(options.film)} : Arguments{};
          }};
}

// The table: every option once, in the order of the help.
std::vector<Entry> table() {
  constexpr auto bit = [](Program program) { return static_cast<unsigned>(program); };
  constexpr unsigned all =
      bit(Program::mars) | bit(Program::host) | bit(Program::ranks) | bit(Program::threads) | bit(Program::simulated);
  constexpr unsigned submits = all | bit(Program::submit);
  constexpr unsigned plans = submits | bit(Program::plan);
  constexpr unsigned sinks = all | bit(Program::plan);
  constexpr unsigned compiles = plans | bit(Program::compile);
  constexpr unsigned counts_nodes = bit(Program::mars) | bit(Program::threads) | bit(Program::simulated) |
                                    bit(Program::plan) | bit(Program::repair) | bit(Program::studio);
  constexpr unsigned forces = counts_nodes & ~(bit(Program::simulated) | bit(Program::plan));
  constexpr unsigned serves = bit(Program::host) | bit(Program::threads);
  constexpr unsigned simulates = bit(Program::mars) | bit(Program::simulated);
  constexpr unsigned person = bit(Program::mars);
  constexpr unsigned persons = person | bit(Program::submit);
  constexpr unsigned starts = person | bit(Program::repair);
  constexpr unsigned draws = bit(Program::studio);
  constexpr std::uint32_t many = 1 << 20;
  return {
      film(compiles & ~serves, true),
      film(serves, false),
      output(persons, "FILE",
             "Folder for the frames, or a video of them: .mp4, .mov, .mkv, .webm, .gif or .apng. You can give several. "
             "Example: -o build/demo -o demo.mp4"),
      output(submits & ~persons, "DIR", "Folder for the frames; created if it is missing. Example: -o build/demo"),
      video_form(persons),
      frames_name(submits, "--name",
                  "Names of the files: # or %04d stands for the number; default: frame-####. Example: --name "
                  "shot_####"),
      number(submits, "--first-number", {&RenderOptions::first_number, false, images::kMostFirstNumber, 0},
             "Number of frame 0 in names of files; default: 0. Example: --first-number 1001"),
      flag(submits, "--overwrite", &RenderOptions::overwrite,
           "Render all requested frames, whatever the folder has. Example: --overwrite"),
      flag(submits, "--kept-film", &RenderOptions::kept_film,
           "Render the compiled film in DIR, film.mars, even if FILM has changed or is gone; FILM if DIR has none. "
           "Example: --kept-film"),
      number(counts_nodes, "--nodes", {&RenderOptions::nodes, false, many},
             "Nodes that render; default: one per processor, or the slots of the batch job or hostfile less one "
             "for the host. Example: --nodes 4"),
      flag(forces, "--force", &RenderOptions::force,
           "Start the nodes even if they are more than 64 a core. Example: --nodes 1000 --force"),
      option(
          starts, "--backend", "auto|mpi|threads|simulated", &RenderOptions::backend,
          "MPI processes, or threads of one process; auto: MPI where it is installed; simulated: nodes of --platform, "
          "whose times are counted. Example: --backend threads"),
      option(draws, "--backend", "auto|mpi|threads", &RenderOptions::backend,
             "MPI processes, or threads of one process; auto uses threads, and MPI with --hostfile. Example: --backend "
             "mpi"),
      option(simulates, "--platform", "NAME|FILE", &RenderOptions::platform,
             "Machines that --backend simulated simulates: ipsc2, fat-tree, dragonfly, ethernet, here (mars "
             "calibrate), or a file; default: fat-tree. Example: --platform fat-tree:here"),
      option(bit(Program::plan), "--platform", "here|NAME|FILE", &RenderOptions::platform,
             "Machines that would render: here, this one as mars calibrate measured it, which is the default; ipsc2, "
             "fat-tree, dragonfly, ethernet; or a file. Example: --platform fat-tree"),
      option(starts | draws, "--hostfile", "FILE", &RenderOptions::hostfile,
             "Machines to use, one per line as for mpirun: n1 slots=4. Example: --hostfile hosts"),
      option(plans, "--frames", "SET", &RenderOptions::frames,
             "Frames to render, counted from 0; default: all. Example: --frames 0-9,24,30-"),
      number(plans, "--every", {&RenderOptions::every, false, many},
             "Only every Nth frame of each range. Example: --every 10"),
      option(compiles, "--size", "WxH", &RenderOptions::size,
             "Picture size in pixels; default: the film's. Example: --size 960x540"),
      option(
          compiles, "--samples", "1|2|4|8|16", &RenderOptions::samples,
          "Samples of a pixel; default: the film's. More make smoother edges and take longer. Example: --samples 16"),
      option(
          compiles, "--eye", "middle|left|right", &RenderOptions::eye,
          "Eye of a stereo pair that sees the film, by its camera's interaxial and convergence; default: middle, the "
          "camera itself. Example: --eye left"),
      option(compiles, "--crop", "PART", &RenderOptions::crop,
             "Draw this part alone: X,Y,WxH, X,Y its left top pixel. Example: --crop 480,270,960x540"),
      number(compiles, "--margin", {&RenderOptions::margin, false, wire::kMostMargin, 0},
             "Pixels drawn around the picture or its crop (overscan); default: 0. Example: --margin 32"),
      flag(compiles, "--faces", &RenderOptions::faces,
           "Of a panorama, the six faces that it is joined of: frame n of face f of N frames is frame f N + n. "
           "Example: --faces"),
      option(plans, "--mapping", "greedy|optimal|cost", &RenderOptions::mapping,
             "How lines are divided among nodes: by edge boxes, exactly by edge boxes, or by cost; default: cost. "
             "Example: --mapping greedy"),
      option(
          plans, "--exchange", "auto|send|again", &RenderOptions::exchange,
          "How triangles reach other machines: sent, or made again there; default: auto, made again where that takes "
          "less than half the time. Example: --exchange send"),
      option(compiles, "--intervals", "auto|keyframes", &RenderOptions::intervals,
             "Where render intervals are cut: where it saves work, or at the animator's keyframes. "
             "Example: --intervals keyframes"),
      flag(plans, "--no-coherence", &RenderOptions::no_coherence,
           "Render every frame from scratch: same pictures, slower. Example: --no-coherence"),
      number(submits, "--block", {&RenderOptions::block, false, wire::kMaxSide},
             "Side of the compositor's blocks in pixels: same pictures. Example: --block 32"),
      number(plans, "--groups", {&RenderOptions::groups, true, many},
             "Groups of nodes; each renders intervals of its own. 1: all nodes work on the same interval, as in the "
             "thesis. Example: --groups 1"),
      number(plans, "--sharers", {&RenderOptions::sharers, true, many},
             "Nodes that draw an inbetween together; default: as forecast, or 1. Example: --sharers 4"),
      number(plans, "--cut", {&RenderOptions::cut, true, many},
             "Frames of an interval that a group gets at a time; default: as forecast, or all. "
             "Example: --cut 12"),
      option(plans, "--format", "png|png16|exr", &RenderOptions::format,
             "Files of the frames: PNG of 8 or 16 bits, or EXR: light before exposure and curve; default: png. "
             "Example: --format exr"),
      flag(plans, "--alpha", &RenderOptions::alpha,
           "Leave the background out: files have alpha, straight in PNG, premultiplied in EXR. Example: --alpha"),
      option(plans, "--layers", "LAYERS", &RenderOptions::layers,
             "What EXR files show beside colours: depth, normal, unshadowed, motion, ids (Cryptomatte); or all. "
             "Example: --layers depth,ids"),
      option(submits, "--compression", "zip|zips|piz|pxr24|rle|none", &RenderOptions::compression,
             "How EXR files are compressed, all without loss; default: zip. Example: --compression piz"),
      word_of_view(submits, "--ocio", "CONFIG", &images::ViewWish::config,
                   "Show light in PNG files by a view of this OpenColorIO config, not by the film's curve. Example: "
                   "--ocio config.ocio"),
      word_of_view(submits, "--display", "NAME", &images::ViewWish::display,
                   "Display of --ocio; default: the config's. Example: --display sRGB"),
      word_of_view(submits, "--view", "NAME", &images::ViewWish::view,
                   "View of --ocio; default: the display's. Example: --view Film"),
      word_of_view(submits, "--ocio-input", "SPACE", &images::ViewWish::input,
                   "Colour space of linear light with sRGB's primaries in --ocio; default: scene_linear. Example: "
                   "--ocio-input lin_srgb"),
      option(
          sinks, "--sink", "files|none", &RenderOptions::sink,
          "Where frames go; none writes no files, to measure rendering; simulations with --write count them. Example: "
          "--sink none"),
      option(
          plans, "--write", "auto|host|nodes", &RenderOptions::write,
          "Who composes frames and writes their files: the host, or the nodes that draw them; default: auto, nodes of "
          "several machines if forecast to be sooner. Example: --write nodes"),
      option(submits, "--report", "FILE", &RenderOptions::report,
             "Write each node's times and work per frame as JSON. Example: --report report.json"),
      option(submits, "--trace", "FILE", &RenderOptions::trace,
             "Write a timeline of all ranks, for ui.perfetto.dev or chrome://tracing. Example: --trace trace.json"),
      option(all & ~bit(Program::simulated), "--watch", "SOCKET", &RenderOptions::watch,
             "Send the frames that nodes draw to the program that listens at this Unix socket. "
             "Example: --watch /tmp/watcher"),
      flag(person, "--window", &RenderOptions::window, "Show frames in a window. Example: --window"),
      number(persons | starts, "--restarts", {&RenderOptions::restarts, false, 1000, 0},
             "How often in a row a job that dies is started again if no new frame comes; 0: never; default: 5. "
             "Example: --restarts 0"),
      option(serves, "--serve", "SOCKET", &RenderOptions::serve,
             "Render no film: draw what a studio requests over this local socket. mars studio uses this option. "
             "Example: --serve /tmp/studio/socket"),
      flag(persons | starts, "-q,--quiet", &RenderOptions::quiet, "Print only errors. Example: --quiet"),
  };
}

bool takes(Program program, const Entry& entry) { return (entry.programs & static_cast<unsigned>(program)) != 0; }

// Headings of the help, and which options stand below them; others stand below "Options".
struct Heading {
  const char* text;
  std::vector<std::string_view> names;
};

const std::vector<Heading>& headings() {
  static const std::vector<Heading> kHeadings{
      {"Pictures and files",
       {"--name",  "--first-number", "--frames",      "--every",      "--size",  "--samples", "--format",
        "--alpha", "--layers",       "--compression", "--eye",        "--faces", "--crop",    "--margin",
        "--ocio",  "--display",      "--view",        "--ocio-input", "--codec", "--quality", "--sink"}},
      {"Machines", {"--nodes", "--force", "--backend", "--platform", "--hostfile", "--restarts", "--write"}},
      {"Division of work (the same pictures)",
       {"--mapping", "--exchange", "--intervals", "--no-coherence", "--block", "--groups", "--sharers", "--cut"}},
      {"Measurements", {"--report", "--trace", "--watch", "--window"}}};
  return kHeadings;
}

void put_under_headings(cli::Command app) {
  for (const cli::Option& option : app.options())
    for (const Heading& heading : headings())
      if (std::ranges::find(heading.names, option.name()) != heading.names.end()) option.under(heading.text);
}

// Names that options had before, by their names now.
constexpr std::array<std::pair<const char*, const char*>, 1> kFormerNames{{{"--cubes", "--groups"}}};

void refuse_former_names(cli::Command app) {
  for (const auto& [former, now] : kFormerNames) {
    const auto refuse = [name = std::string(former), now = std::string(now)](const std::string&) {
      throw cli::UsageError(name, "use " + now);
    };
    app.add_read(former, refuse, "").hidden();
  }
}

// Takes the name of --name, or of the last part of -o, without its ending, which agrees with the format.
void take_name(const std::string& text, bool has_format, RenderOptions& options) {
  using images::PictureFormat;
  const std::filesystem::path name = text;
  const bool has_ending = images::is_picture_name(name);
  const bool exr = name.extension() == images::facts_of(PictureFormat::exr).ending;
  if (has_ending && exr && !has_format) options.format = PictureFormat::exr;
  if (has_ending && exr != (options.format == PictureFormat::exr))
    throw Failure(document::in_quotes(text) + " is no name of " + images::facts_of(options.format).name + " files", "",
                  "leave out --format, or the ending of the name");
  options.name = images::frame_pattern(has_ending ? name.stem().string() : text);
}

// Sets the options for which other options are short.
void resolve(cli::Command app, RenderOptions& options) {
  const bool has_format = !app.first_given({"--format"}).empty();
  options.frames = options.frames.every(std::exchange(options.every, 1));
  if (!options.name.empty()) take_name(options.name, has_format, options);
  const std::filesystem::path folder = options.folder;
  if (options.own_folder || !names_files(folder)) return;
  if (!options.name.empty())
    throw Failure("the files have two names, " + document::in_quotes(options.folder) + " and " +
                      document::in_quotes(options.name),
                  "", "leave out --name, or name a folder alone with -o");
  if (options.sink != SinkKind::files)
    throw Failure(document::in_quotes(options.folder) + " names files, of which --sink none writes none", "",
                  "leave out -o, or --sink none");
  take_name(folder.filename().string(), has_format, options);
  options.folder = folder.has_parent_path() ? folder.parent_path().string() : ".";
}

}  // namespace

void check_nodes(const RenderOptions& options, std::uint32_t cores) {
  constexpr std::uint64_t kACore = 64;
  const std::uint64_t most = kACore * cores;
  if (options.nodes <= most || options.force || options.backend == Backend::simulated) return;
  throw Failure(document::counted(options.nodes, "node") + " are more than " + std::to_string(kACore) +
                    " for each of " + document::counted(cores, "core"),
                "--nodes", "use up to " + std::to_string(most) + ", or add --force");
}

bool measures(const RenderOptions& options) { return !options.report.empty() || !options.trace.empty(); }

void add_render_options(cli::Command app, RenderOptions& options, Program program) {
  for (const Entry& entry : table()) {
    if (takes(program, entry)) entry.add(app, options);
  }
  if (program == Program::mars) put_under_headings(app);
  const bool draws = program != Program::compile && program != Program::plan;
  app.checks([app, &options, program, draws] {
    if (draws) read_outputs(options, program == Program::mars || program == Program::submit);
    resolve(app, options);
    check_pictures(options);
    check_compression(options, !app.first_given({"--compression"}).empty());
    if (draws) check_together(options, program);
  });
  if (draws) refuse_former_names(app);
}

std::optional<int> read_render_options(Program program, const char* name, const char* purpose, RenderOptions& options,
                                       int argc, const char* const* argv) {
  cli::Program words(name, purpose);
  add_render_options(words, options, program);
  return words.read(argc, argv);
}

std::filesystem::path frames_in(const std::filesystem::path& work) { return work / "frames"; }

std::vector<std::string> film_arguments(const RenderOptions& options) {
  Arguments arguments = arguments_for(Program::compile, options);
  arguments.erase(arguments.begin());  // FILM
  return arguments;
}

std::shared_ptr<const images::DisplayView> view_of(const RenderOptions& options) {
  return options.view.config.empty() ? nullptr : images::open_view(options.view);
}

images::FrameForm form_of(const RenderOptions& options) {
  const images::PictureFormat format = options.alpha ? images::with_alpha(options.format) : options.format;
  const auto view = view_of(options);
  return {format,
          options.compression,
          {options.name, options.first_number},
          view ? view->name() : images::ViewName(),
          options.layers.kinds};
}

void set_form(const images::FrameForm& form, RenderOptions& options) {
  options.format = images::without_alpha(form.format);
  options.alpha = images::has_alpha(form.format);
  options.compression = form.compression;
  options.layers.kinds = form.layers;
  options.name = form.names.pattern;
  options.first_number = form.names.first_number;
  options.view = {form.view.config, form.view.display, form.view.view, form.view.input};
}

std::vector<std::string> arguments_for(Program program, const RenderOptions& options) {
  Arguments arguments;
  for (const Entry& entry : table()) {
    if (!takes(program, entry)) continue;
    for (std::string& argument : entry.write(options)) arguments.push_back(std::move(argument));
  }
  return arguments;
}

}  // namespace mars::options
