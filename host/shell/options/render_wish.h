// What a person asks of a rendering, as the options say it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/crop.h"
#include "host/content/film/eye.h"
#include "host/content/film/frame_set.h"
#include "host/images/display_view.h"
#include "host/images/frame_form.h"
#include "host/images/picture_format.h"
#include "host/images/picture_size.h"
#include "host/videos/video_form.h"
#include "node/wire/protocol.h"

namespace mars::options {

// In place of a film's file: a tiny film that every program has in it, to see whether a start works.
inline constexpr const char* kTrialFilm = ":trial";

enum class Backend { automatic, mpi, threads, simulated };
enum class Intervals { automatic, keyframes };
enum class SinkKind { files, none };
enum class WriteWhere { automatic, host, nodes };

struct ChosenLayers {
  wire::LayerSet kinds = 0;

  bool operator==(const ChosenLayers&) const = default;
};

struct RenderOptions {
  std::string film;         // FILM.json or FILM.mars; "": a studio's, which is served
  std::string folder;       // for the frames; "" only without a sink
  bool own_folder = false;  // no person named it: of videos alone, and gone when they are there
  std::string name;         // of the frames' files, with # for the number (images/frame_names.h); "": as by default
  std::uint32_t first_number = 0;
  std::vector<std::string> outputs;  // as they were typed: the folder and the videos, until all words are read
  std::vector<std::string> videos;   // files that are made of the frames
  videos::FormWish video_form;
  std::uint32_t nodes = 0;  // 0: as many as the machine has processors for
  Backend backend = Backend::automatic;
  std::string platform;  // name or file of the simulated machines
  bool force = false;    // also with very many nodes a core (check_nodes)
  std::string hostfile;  // Open MPI's, of the machines to use; "": this one, or the batch system's
  film::FrameSet frames;
  std::uint32_t every = 1;  // Nth frame of each stretch of them; once the line is read, `frames` says it
  std::optional<images::PictureSize> size;  // none: the film's own
  std::optional<std::uint32_t> samples;     // of a pixel; none: the film's own
  film::Eye eye = film::Eye::middle;
  std::optional<film::Crop> crop;  // all that is drawn of the picture; none: all of it
  std::uint32_t margin = 0;        // pixels that are drawn around that
  bool faces = false;              // of a panorama, the film of faces that it is joined of
  wire::Mapping mapping = wire::Mapping::cost;
  wire::Exchange exchange = wire::Exchange::automatic;
  Intervals intervals = Intervals::automatic;
  bool no_coherence = false;  // every frame from scratch
  std::uint32_t block = 16;   // side of the compositor's blocks, pixels
  std::uint32_t groups = 0;   // intervals rendered at a time; 0: chosen by the plan
  std::uint32_t sharers = 0;  // nodes that draw an inbetween together; 0: chosen by the plan
  std::uint32_t cut = 0;      // frames of an interval that a group draws in one go, at most; 0: chosen by the plan
  bool overwrite = false;     // render frames that the folder has already, too
  bool kept_film = false;     // the folder's film.mars, even if `film` has changed; `film` if the folder has none
  SinkKind sink = SinkKind::files;
  WriteWhere write = WriteWhere::automatic;                   // who composes frames and writes their files
  images::PictureFormat format = images::PictureFormat::png;  // of the files
  images::Compression compression = images::Compression::zip;
  bool alpha = false;          // in them, in place of the background
  images::ViewWish view;       // that shows light in PNG files; none: the film's curve does
  ChosenLayers layers{};       // of EXR files
  std::string report;          // file for the measurements; "": none
  std::string trace;           // file for a picture of the run; "": none
  std::string watch;           // socket of a program that watches; "": none
  bool window = false;         // mars starts a program that watches
  std::uint32_t restarts = 5;  // in a row of a job that dies, if no new frame comes
  bool quiet = false;
  std::string serve;  // a studio's socket, at which its pictures are drawn; "": a film is rendered to files

  bool operator==(const RenderOptions&) const = default;
};

// The programs that read the options: each takes those that concern it. submit is mars submit, whose job is mars
// render.
enum class Program : unsigned {
  mars = 1,
  host = 2,
  ranks = 4,
  threads = 8,
  simulated = 16,
  compile = 32,
  plan = 64,
  repair = 128,  // mars verify --repair: which machines render
  submit = 256,
  studio = 512,  // mars studio: which machines draw
};

}  // namespace mars::options
