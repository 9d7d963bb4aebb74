#include "host/shell/commands/preview_command.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "host/child/programs.h"
#include "host/cli/command.h"
#include "host/content/document/text.h"
#include "host/images/picture_size.h"
#include "host/preview/film_pictures.h"
#include "host/preview/folder_pictures.h"
#include "host/preview/load.h"
#include "host/preview/player.h"
#include "host/preview/reloading_pictures.h"
#include "host/preview/terminal_screen.h"
#include "host/preview/window_screen.h"
#include "host/preview/write_pictures.h"
#include "host/shell/launch/film_audio.h"
#include "host/shell/options/video_options.h"

namespace mars::commands {
namespace {

constexpr double kMostStops = 64;

struct PreviewWords {
  std::string source;
  preview::WriteOptions write;
  preview::Look look;
  preview::Graphics graphics = preview::Graphics::automatic;
  bool window = false;
  videos::Exposing exposing;
  images::ViewWish view;
  std::string audio;
  double delay = 0;  // seconds
};

void print_news(const std::string& line) { std::cout << line << std::endl; }

const videos::Listener kListener{{}, print_news, {print_news}};

void add_output(cli::Command command, const std::shared_ptr<PreviewWords>& words) {
  preview::WriteOptions& write = words->write;
  const auto read_file = [&write](const std::string& word) {
    preview::check_kind(word);
    write.file = word;
  };
  const auto read_size = [&write](const std::string& word) {
    const images::PictureSize size = images::read_picture_size(word);
    write.extent = images::PictureSize{size.width, size.height};
  };
  command
      .add_read(
          "-o,--output", read_file,
          "Write this file instead of playing: a video (.mp4, .mov, .mkv, .webm, .gif, .apng), or .png, one frame "
          "or a contact sheet. Example: -o sheet.png")
      .type("FILE");
  command
      .add_read("--size", read_size,
                "Pixels of each picture that is written; default: the film's own; on a sheet "
                "320x180, in a GIF at most 960x540. Example: --size 480x270")
      .type("WxH");
  command
      .add_read(
          "--frames", [&write](const std::string& word) { write.frames.emplace(word); },
          "Frames that are written; default: all, on a sheet 12. Example: --frames 0-47")
      .type("LIST");
  command.add("--every", write.every, "Only every Nth of these frames. Example: --every 8")
      .range(1u, wire::kMostFrames)
      .type("N");
  command.add("--columns", write.columns, "Pictures in a row of a sheet. Example: --columns 4")
      .range(1u, wire::kMaxSide)
      .type("N");
}

void add_video(cli::Command command, const std::shared_ptr<PreviewWords>& words) {
  options::add_video_form(command, words->write.form);
  command.add("--audio", words->audio, "Sound of a video; default: the film's. Example: --audio music.wav")
      .type("FILE");
  command
      .add("--audio-delay", words->delay,
           "When this sound begins, in seconds after the film's first frame. Example: --audio-delay 1.5")
      .range(-1e6, 1e6)
      .type("SECONDS")
      .needs(command.option("--audio"));
}

void add_exposing(cli::Command command, const std::shared_ptr<PreviewWords>& words) {
  const auto read_stops = [words](const std::string& word) {
    words->exposing.stops = document::number_in<double>(word);
    if (!words->exposing.stops || std::abs(*words->exposing.stops) > kMostStops)
      throw Failure("'" + word + "' is not a number from -64 to 64", "", "");
  };
  command
      .add_read("--exposure", read_stops,
                "Stops by which EXR frames are exposed; default: the film's. Example: --exposure -1")
      .type("STOPS");
  command.add_choice(
      "--curve", {"none", "filmic", "agx"},
      [words](std::size_t number) { words->exposing.curve = static_cast<wire::Curve>(number); },
      "How light of EXR frames is shown; default: the film's. Example: --curve none");
}

void add_view(cli::Command command, const std::shared_ptr<PreviewWords>& words) {
  command
      .add("--ocio", words->view.config,
           "Show light of EXR frames by a view of this OpenColorIO config, not by a curve. Example: --ocio config.ocio")
      .type("CONFIG");
  command.add("--display", words->view.display, "Display of --ocio; default: the config's. Example: --display sRGB")
      .type("NAME");
  command.add("--view", words->view.view, "View of --ocio; default: the display's. Example: --view Film").type("NAME");
  command
      .add("--ocio-input", words->view.input,
           "Colour space of linear light with sRGB's primaries in --ocio; default: scene_linear. Example: --ocio-input "
           "lin_srgb")
      .type("SPACE");
}

void check_view(const PreviewWords& words) {
  if (words.view.config.empty() && words.view != images::ViewWish())
    throw Failure("a view is one of an OpenColorIO config", "", "add --ocio CONFIG");
  if (!words.view.config.empty() && words.exposing.curve)
    throw Failure("a view of OpenColorIO has a curve of its own", "", "leave out --curve, or --ocio");
}

void add_screen(cli::Command command, const std::shared_ptr<PreviewWords>& words) {
  command.add_choice(
      "--graphics", {"auto", "kitty", "sixel", "blocks", "blocks256"},
      [words](std::size_t number) { words->graphics = static_cast<preview::Graphics>(number); },
      "How the terminal shows pictures: its own graphics, or two pixels a character in 24-bit or 256 colours; default: "
      "what the terminal says it can show. Example: --graphics blocks");
  command.add_flag("--window", words->window, "Play in a window instead of the terminal. Example: --window");
}

// Refuses options that would be ignored. Not every command has all.
void check_output(cli::Command command, const PreviewWords& words) {
  const std::filesystem::path& file = words.write.file;
  if (words.window && !file.empty())
    throw Failure("-o writes a file and opens no window", "", "leave out --window, or -o");
  if (!command.first_given({"--graphics"}).empty() && (words.window || !file.empty()))
    throw Failure("--graphics is for pictures in the terminal", "",
                  std::string("leave it out, or ") + (words.window ? "--window" : "-o"));
  const auto refuse = [&](std::initializer_list<std::string_view> names, const char* problem, const char* remedy) {
    if (const std::string name = command.first_given(names); !name.empty())
      throw Failure(name + problem, "", std::string(remedy) + name);
  };
  if (file.empty())
    return refuse({"--size", "--frames", "--every", "--columns", "--codec", "--quality", "--audio"},
                  " is for a file that is written, and none is named", "add -o FILE, or leave out ");
  if (videos::is_video_name(file)) return refuse({"--columns"}, " is for contact sheets", "leave out ");
  refuse({"--codec", "--quality", "--audio"}, " is for videos", "name one with -o, or leave out ");
}

videos::Exposing exposing_of(const PreviewWords& words) {
  videos::Exposing exposing = words.exposing;
  if (!words.view.config.empty()) exposing.view = images::open_view(words.view);
  return exposing;
}

// `smooth`: lines without steps are worth their work there.
using PlayOn = std::function<int(preview::Screen& screen, bool smooth)>;

// Until a person or a signal ends it; the signal then ends the program too, the terminal being given back.
void play_in_terminal(const PreviewWords& words, const PlayOn& play_on) {
  int ended_by = 0;
  {
    const messages::TerminalKind kind = messages::terminal_kind();
    preview::Terminal terminal(words.graphics, kind.name, kind.colors24);
    preview::TerminalScreen screen(terminal);
    const bool few_pixels = terminal.graphics() >= preview::Graphics::blocks;  // they cost little, and need it most
    ended_by = play_on(screen, few_pixels);
  }
  if (ended_by != 0 && ended_by != SIGINT) raise(ended_by);
}

void play_in_window(const PreviewWords& words, images::PictureSize extent, const PlayOn& play_on) {
  preview::WindowScreen screen(child::own_file(), std::filesystem::path(words.source).filename().string(), extent);
  play_on(screen, true);
}

void play(const PreviewWords& words, images::PictureSize extent, const PlayOn& play_on) {
  words.window ? play_in_window(words, extent, play_on) : play_in_terminal(words, play_on);
}

void write_preview(PreviewWords& words, const preview::Previewed& film, const MakeSurface& make_surface) {
  const auto surface = make_surface(film.film);
  words.look.frames = preview::frames_to_write(words.write, film.wireframe.frames);
  words.look.smooth = words.look.wait = true;
  preview::FilmPictures pictures(film.wireframe, *surface, words.look);
  preview::write_pictures(pictures, words.write, kListener);
}

void preview(PreviewWords& words, const MakeSurface& make_surface) {
  document::RecordedReads reads;
  auto film = std::make_unique<preview::Previewed>(preview::load_previewed(words.source));
  if (!words.write.file.empty()) {
    reads.refuse_output(words.write.file);
    return write_preview(words, *film, make_surface);
  }
  std::optional<preview::ReloadingPictures> pictures;
  play(words, {film->wireframe.width, film->wireframe.height}, [&](preview::Screen& screen, bool smooth) {
    words.look.smooth = smooth;
    pictures.emplace(words.source, std::move(film), reads.stamps(), make_surface, words.look);
    return preview::play(*pictures, screen);
  });
  if (pictures->stop()) std::quick_exit(0);  // the film is needed no more: its end is not waited for
}

void write_folder(PreviewWords& words, preview::FolderPictures& pictures) {
  if (!videos::is_video_name(words.write.file)) return preview::write_pictures(pictures, words.write, kListener);
  if (!words.audio.empty())
    words.write.audio = {words.audio, words.delay};
  else
    words.write.audio = launch::audio_of_folder(pictures.reader().manifest());
  videos::check_order({words.write.file, words.write.form, words.write.audio},
                      words.write.extent.value_or(pictures.extent()));
  preview::write_folder_video(pictures, words.write, kListener);
}

void play_folder(PreviewWords& words) {
  preview::FolderPictures pictures(words.source, exposing_of(words));
  if (!words.write.file.empty()) return write_folder(words, pictures);
  play(words, pictures.extent(), [&](preview::Screen& screen, bool) { return preview::play(pictures, screen); });
}

}  // namespace

void add_preview(cli::Command app, const MakeSurface& make_surface) {
  const auto words = std::make_shared<PreviewWords>();
  const cli::Command command =
      app.add_command("preview", "Play a film or a model in the terminal before it is rendered");
  command
      .add("FILM", words->source,
           "A film (.json, .mars) or a model; loaded again when it changes. Example: examples/demo.json")
      .required();
  command.add_choice(
      "--as", {"stick", "vertices", "prisms", "surface", "all"},
      [words](std::size_t number) {
        words->look.as = number < 4 ? std::optional(static_cast<preview::As>(number)) : std::nullopt;
      },
      "How models are shown at first; default: prisms. Example: --as stick");
  command.add_choice(
      "--view", {"camera", "front", "side", "top"},
      [words](std::size_t number) { words->look.from = static_cast<preview::From>(number); },
      "From where the film is seen at first; default: the film's camera. Example: --view side");
  add_screen(command, words);
  add_output(command, words);
  options::add_video_form(command, words->write.form);
  command.checks([command, words] { check_output(command, *words); });
  command.footer("Keys turn joints and set keys of a film: h lists them. docs/previewing.md\n");
  command.runs([words, make_surface] { preview(*words, make_surface); });
}

void add_play(cli::Command app) {
  const auto words = std::make_shared<PreviewWords>();
  const cli::Command command = app.add_command("play", "Play rendered frames in the terminal, or make a video of them");
  command.add("DIR", words->source, "The folder given to mars render with -o. Example: build/demo").required();
  add_screen(command, words);
  add_output(command, words);
  add_video(command, words);
  add_exposing(command, words);
  add_view(command, words);
  command.checks([command, words] {
    check_output(command, *words);
    check_view(*words);
  });
  command.runs([words] { play_folder(*words); });
}

}  // namespace mars::commands
