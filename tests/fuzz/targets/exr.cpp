// EXR files. The input changes a sound one, or is the file itself.
#include <numeric>

#include "host/images/exr_file.h"
#include "host/images/picture_file.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::exr {
namespace {

Message sound() {
  std::vector<std::uint32_t> pixels(7 * 5 * 2);
  std::iota(pixels.begin(), pixels.end(), 0x3c003a00u);
  return images::encode_picture(images::PictureFormat::exr, 7, 5, pixels, "a note");
}

}  // namespace

void take(std::string_view input) {
  static const Message file = sound();
  if (input.starts_with("\x76\x2f\x31\x01")) {
    images::note_in_exr(std::as_bytes(std::span(input)));
    images::decode_exr(std::as_bytes(std::span(input)), "frame.exr");
    return;
  }
  Script script(input);
  Message changed = file;
  while (!script.at_end()) edit(changed, script, 8192);
  images::note_in_exr(changed);
  images::decode_exr(changed, "frame.exr");
}

const Target target("exr", Form::bytes, take);

}  // namespace mars::fuzz::exr
