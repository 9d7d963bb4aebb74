#include <algorithm>
#include <span>

#include "host/content/document/base64.h"
#include "host/images/picture_file.h"
#include "host/preview/terminal_picture.h"

namespace mars::preview {
namespace {

constexpr std::size_t kChunk = 4096;  // bytes of text at a time, the protocol's limit

class Kitty : public TerminalPicture {
 public:
  images::PictureSize space(const Terminal& terminal, std::uint32_t lines) const override {
    const images::PictureSize cells = terminal.cells(), cell = terminal.cell();
    return {cells.width * cell.width, (cells.height > lines ? cells.height - lines : 1) * cell.height};
  }

  const std::string& shown(const images::Image& image) override {
    const std::string picture =
        document::base64(images::encode_picture(images::PictureFormat::png, image.width, image.height, image.pixels));
    const int before = number_;
    number_ = 3 - number_;
    text_ = "\x1b[?2026h\x1b[H";
    for (std::size_t at = 0; at < picture.size(); at += kChunk) {
      text_ += at == 0 ? "\x1b_Ga=T,f=100,C=1,q=2,i=" + std::to_string(number_) + "," : "\x1b_Gq=2,";
      text_ += at + kChunk < picture.size() ? "m=1;" : "m=0;";
      text_.append(picture, at, kChunk);
      text_ += "\x1b\\";
    }
    text_ += "\x1b_Ga=d,d=I,q=2,i=" + std::to_string(before) + "\x1b\\\x1b[?2026l";
    return text_;
  }

 private:
  int number_ = 1;  // of the picture that stands: 1 or 2
  std::string text_;
};

}  // namespace

std::unique_ptr<TerminalPicture> make_kitty() { return std::make_unique<Kitty>(); }

}  // namespace mars::preview
