#include "host/shell/commands/verify_command.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/programs.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/film/frame_set.h"
#include "host/render/resume/resume.h"
#include "host/render/sinks/verify.h"
#include "host/shell/doctor/doctor.h"
#include "host/shell/launch/launch.h"
#include "host/cli/program.h"
#include "host/shell/options/render_options.h"
#include "host/videos/verify_video.h"

namespace mars::commands {
namespace {

struct VerifyWords {
  options::RenderOptions render;  // of --repair, in the folder to verify
  bool missing = false;
  bool repair = false;
};

film::FrameSet frames_of(const sinks::Verdict& verdict) {
  std::vector<std::uint32_t> frames;
  for (const sinks::Verdict::Trouble& trouble : verdict.troubles) frames.push_back(trouble.frame);
  return film::FrameSet(frames);
}

void print_line(const std::string& line) {
  if (!line.empty()) std::cout << line << std::endl;
}

// Exit code 0 in any case; prints nothing if no frame is missing.
void print_missing(const sinks::Verdict& verdict) {
  if (!verdict.troubles.empty()) std::cout << frames_of(verdict).text() << '\n';
}

// "frame 7: missing", "frames 104-347: missing": each line of frames that follow one another.
void print_troubles(std::span<const sinks::Verdict::Trouble> troubles) {
  while (!troubles.empty()) {
    std::vector<std::uint32_t> frames;
    for (const auto& [frame, reason] : troubles) {
      if (reason != troubles[0].reason || frame != troubles[0].frame + frames.size()) break;
      frames.push_back(frame);
    }
    std::cout << film::frames_text(frames) << ": " << troubles[0].reason << '\n';
    troubles = troubles.subspan(frames.size());
  }
}

std::string count_text(const sinks::Verdict& verdict) {
  return std::to_string(verdict.troubles.size()) + " of " + document::counted(verdict.expected, "frame") +
         (verdict.troubles.size() == 1 ? " is missing or wrong" : " are missing or wrong");
}

// Of frames that left nothing, a manifest that is made again cannot know whether they were asked for.
std::string text_of_unlisted(const std::string& folder) {
  sinks::Manifest manifest = sinks::read_manifest(folder);
  std::vector<std::uint32_t> unlisted;
  for (std::uint32_t frame = 0; frame < manifest.film_frames; ++frame)
    if (!std::ranges::binary_search(manifest.frames, frame)) unlisted.push_back(frame);
  if (unlisted.empty()) return "";
  const film::FrameSet frames(unlisted);
  const std::filesystem::path film = std::filesystem::path(folder) / sinks::kFilmName;
  manifest.film = std::filesystem::exists(film) ? film.string() : "FILM";
  const bool one = unlisted.size() == 1;
  return film::frames_text(unlisted) + " of the film left nothing; if you had rendered " + (one ? "it: " : "them: ") +
         resume::command_for(folder, manifest, frames);
}

// Returns the exit code.
int print_verdict(const sinks::Verdict& verdict, const std::string& folder) {
  if (!verdict.troubles.empty()) {
    print_troubles(verdict.troubles);
    std::cout << count_text(verdict) << " (render again: mars verify --repair " << document::shell_word(folder)
              << ")\n";
    return cli::kFailed;
  }
  std::cout << document::counted(verdict.expected, "frame") << ", all there";
  std::cout << (verdict.compared ? " and whole" : "; frames.json has no pixel hashes, so pixels were not compared");
  if (verdict.expected < verdict.film_frames) std::cout << " (the film has " << verdict.film_frames << ")";
  std::cout << '\n';
  std::cout << "pixels (" << verdict.pixels << ") " << verdict.hash << '\n';
  return 0;
}

// "48 frames of demo.json (0-47), 960x540, 24 frames/s, h264, aac"
std::string video_text(const videos::VideoVerdict& verdict) {
  const videos::Probed::Video& video = *verdict.found.video;
  std::string text = document::counted(verdict.decoded, "frame");
  if (verdict.mark && !verdict.mark->film.empty()) text += " of " + verdict.mark->film;
  if (verdict.mark) text += " (" + film::FrameSet(verdict.mark->frames).text() + ")";
  text += ", " + std::to_string(video.width) + "x" + std::to_string(video.height) + ", " + document::shown(video.rate) +
          " frames/s, " + video.codec;
  return verdict.found.audio.empty() ? text : text + ", " + verdict.found.audio;
}

// Returns the exit code.
int print_verdict(const videos::VideoVerdict& verdict) {
  for (const std::string& trouble : verdict.troubles) std::cout << trouble << '\n';
  std::cout << video_text(verdict) << (verdict.troubles.empty() ? ", all there and whole" : "") << '\n';
  if (!verdict.mark) std::cout << "it says nothing of a film, so nothing was compared\n";
  if (verdict.troubles.empty()) std::cout << "decoded pictures " << verdict.hash << '\n';
  return verdict.troubles.empty() ? 0 : cli::kFailed;
}

bool is_video(const std::string& name) { return videos::is_video_name(name) && !std::filesystem::is_directory(name); }

// Renders frames that are missing or wrong from the film that the folder keeps.
void repair(const sinks::Verdict& verdict, options::RenderOptions render) {
  render.frames = frames_of(verdict);
  const std::string& folder = render.folder;
  const sinks::Manifest manifest = sinks::read_manifest(folder);
  resume::require_kept_film(folder, manifest, render.frames);
  if (manifest.pixel_version != wire::kPixelVersion)
    throw Failure(
        "its frames were rendered by a MARS that draws other pixels, which this one would mix with its own", folder,
        "render all with: " + resume::command_for(folder, manifest, film::FrameSet(manifest.frames)) + " --overwrite");
  render.film = std::filesystem::path(folder) / sinks::kFilmName;
  options::set_form(form_of(manifest), render);
  sinks::remove_wrong_files(folder, verdict);
  if (!render.quiet) std::cout << count_text(verdict) << std::endl;
  launch::launch_render(render, child::own_file(), doctor::adviser(child::own_file()));
}

void verify_video(const VerifyWords& words, int& code) {
  const std::string& file = words.render.folder;
  if (words.missing || words.repair)
    throw Failure("is a video, of which no single frame can be rendered again", file,
                  "render it again by the command that made it, with --overwrite");
  code = print_verdict(videos::verify_video(file));
}

}  // namespace

void add_verify(cli::Command app, int& code) {
  const auto words = std::make_shared<VerifyWords>();
  const cli::Command command =
      app.add_command("verify", "Check every frame of a folder or video; print one hash of all pixels");
  command.add("DIR", words->render.folder, "The folder or video given to mars render with -o. Example: build/demo")
      .required();
  const cli::Option missing = command.add_flag(
      "--missing", words->missing,
      "Print only the missing or wrong frames, in the form of --frames; nothing if there are none. Example: --missing");
  const cli::Option repairs = command.add_flag(
      "--repair", words->repair,
      "Make frames.json again if it is lost or damaged; remove wrong frames and render what is missing, from "
      "DIR/film.mars; then check again. Example: --repair");
  repairs.excludes(missing);
  const std::size_t own = command.options().size();
  options::add_render_options(command, words->render, options::Program::repair);
  for (std::size_t i = own; i < command.options().size(); ++i) command.options()[i].needs(repairs);
  command.runs([words, &code] {
    if (is_video(words->render.folder)) return verify_video(*words, code);
    const std::string repaired = words->repair ? sinks::repair_manifest(words->render.folder) : "";
    print_line(repaired);
    if (!repaired.empty()) print_line(text_of_unlisted(words->render.folder));
    sinks::Verdict verdict = sinks::verify_folder(words->render.folder);
    if (words->missing) return print_missing(verdict);
    if (words->repair && !verdict.troubles.empty()) {
      repair(verdict, words->render);
      verdict = sinks::verify_folder(words->render.folder);
    }
    code = print_verdict(verdict, words->render.folder);
  });
}

}  // namespace mars::commands
