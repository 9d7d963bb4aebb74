// Platforms: machines on which a rendering is simulated or forecast, one JSON file each. A named one lies in
// share/mars/platforms; `here` is what mars calibrate measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hal/simulated/machine.h"
#include "host/experiments/spread.h"
#include "host/images/file_work.h"
#include "host/images/picture_format.h"
#include "node/wire/work.h"

namespace mars::experiments {

struct Platform {
  std::string name;
  std::string about;                       // what it is, and where its numbers come from
  std::string doubt;                       // why its costs cannot be trusted; "": they can
  std::uint64_t memory = 0;                // bytes that a node may use for its frames
  std::uint64_t host_memory = 0;           // bytes that the host may use
  double file_part = 0.1;                  // of the bytes of a picture's pixels, those that its file has
  std::vector<wire::Work> unidentified{};  // kinds whose costs measured times cannot tell from those of others
  std::vector<Spread> spread;              // of forecasts by its costs, where it is the machine that was measured
  simulated::Machine machine;

  // For the host and its sinks.
  int host_processors() const { return machine.host_apart ? machine.host_processors : machine.processors; }
};

// `name`: a file, or the name of one in `folder` without its ending, or two such names, A:B: A with the costs of work
// of B. Throws Failure.
Platform read_platform(const std::string& name, const std::filesystem::path& folder);

// That its costs cannot be trusted, and why; "" where they can.
std::string doubt_text(const Platform& platform);

// That costs of some of the kinds are not identified, and which; "" where all are. Where they make up most of a time,
// it is as sure only for films in which they are as frequent, relative to other work, as in the films that were
// measured.
std::string unidentified_text(const Platform& platform, std::span<const wire::Work> kinds);

// Machines like this one, which has `processors`, with a node on each of them and the costs of platform `name`.
Platform like_here(const std::string& name, const std::filesystem::path& folder, int processors);

// Beside `self`, a program of MARS.
std::filesystem::path platforms_folder(const std::filesystem::path& self);

// Where `here` is: the user's, whether it is there or not.
std::filesystem::path calibrated_platform();

// What encoding a byte of a picture's pixels is.
constexpr wire::Work encoded_byte(images::PictureFormat format) {
  switch (format) {
    case images::PictureFormat::png:
    case images::PictureFormat::png_alpha: break;
    case images::PictureFormat::png16:
    case images::PictureFormat::png16_alpha: return wire::Work::encoded_png16_byte;
    case images::PictureFormat::exr:
    case images::PictureFormat::exr_alpha: return wire::Work::encoded_exr_byte;
  }
  return wire::Work::encoded_byte;
}

// Seconds of a processor that making such files takes.
double file_seconds(const simulated::Machine& machine, images::PictureFormat format, const images::FileWork& work);

}  // namespace mars::experiments
