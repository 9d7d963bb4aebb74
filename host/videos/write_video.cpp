#include "host/videos/write_video.h"

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/filled_file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/videos/encoder.h"
#include "host/videos/mark.h"
#include "host/videos/pieces.h"
#include "host/videos/probe.h"

namespace mars::videos {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr double kFastestGif = 50;  // pictures a second: players show a GIF of shorter delays slowly

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

class Writing {
 public:
  Writing(const Source& source, const Order& order, const Listener& listener)
      : source_(source),
        order_(order),
        listener_(listener),
        form_(form_of(order.file, order.form)),
        program_(find_ffmpeg(order.file)),
        encoding_(encoding_words(form_, choose_encoder(order.file, encoders_for(form_, source.size)), source.pixel)) {}

  void write() {
    note(padding_text(form_, source_.size, order_.file));
    if (order_.audio && !form_.kind->has_audio)
      note(order_.file.string() + " is silent: a " + std::string(form_.kind->ending) + " file has no sound");
    if (drops_pictures()) note(order_.file.string() + " has 50 pictures a second: players show a faster GIF slowly");
    if (source_.content && form_.codec->cuts) return join();
    document::fill_whole_file(order_.file, [this](const fs::path& part) { encode(part); });
  }

 private:
  void note(const std::string& line) const {
    if (!line.empty() && listener_.note) listener_.note(line);
  }

  bool is_gif() const { return form_.codec->name == "gif"; }
  bool drops_pictures() const { return is_gif() && source_.rate > kFastestGif && source_.frames.size() > 1; }
  bool has_audio() const { return order_.audio && form_.kind->has_audio; }

  // A GIF's pictures are fed twice.
  void feed_all(Ffmpeg& ffmpeg, bool again = false) const {
    const std::size_t count = source_.frames.size();
    std::size_t fed = again ? count : 0;
    feed(ffmpeg, form_, source_, {0, count}, [&] {
      ++fed;
      if (listener_.encoded) listener_.encoded(is_gif() ? fed / 2 : fed, count);
    });
  }

  // As one piece, with all that the file has.
  void encode(const fs::path& part) const {
    const std::string palette = is_gif() ? find_palette() : "";
    Words words = input_words(form_, source_);
    if (is_gif()) add(words, {"-f", "png_pipe", "-i", "pipe:3"});
    add_audio_input(words);
    if (is_gif())
      add(words, {"-filter_complex", (drops_pictures() ? "fps=50:round=up" : "null") + std::string("[v];[v][1:v]") +
                                         kUsePalette + shape()});
    add(words, encoding_);
    add_rest(words, part);
    Ffmpeg ffmpeg(program_, words, order_.file, listener_.bounds, palette);
    feed_all(ffmpeg, is_gif());
    ffmpeg.finish();
    drops_pictures() ? require_some_picture(part, order_.file)
                     : require_pictures(part, order_.file, source_.frames.size());
  }

  std::string shape() const {
    const std::string filter = shape_filter(source_.pixel);
    return filter.empty() ? "" : "," + filter;
  }

  // Of all pictures, which are read twice: to keep them between would take the memory of them all.
  std::string find_palette() const {
    Words words = input_words(form_, source_);
    add(words, {"-vf", kFindPalette, "-f", "image2pipe", "-c:v", "png", "-"});
    Ffmpeg ffmpeg(program_, words, order_.file, listener_.bounds);
    feed_all(ffmpeg);
    ffmpeg.finish();
    return ffmpeg.printed();
  }

  void join() const {
    if (order_.work != nullptr) return join(order_.work->path());
    const document::WorkFolder work(order_.file, document::WorkFolder::Use::alone,
                                    [this] { note(waiting_text(order_)); });
    if (work.waited() && is_there()) return;
    join(work.path());
  }

  void join(const fs::path& work) const {
    Pieces pieces(source_, form_, order_, encoding_, work);
    pieces.encode(program_, listener_);
    document::fill_whole_file(order_.file, [&](const fs::path& part) {
      Words words{"-v", "error", "-y", "-nostdin", "-f", "concat", "-safe", "0", "-i", file_word(pieces.list())};
      add_audio_input(words);
      add(words, {"-c:v", "copy"});
      add_rest(words, part);
      run_ffmpeg(program_, words, order_.file, listener_.bounds);
      require_pictures(part, order_.file, source_.frames.size());
    });
    pieces.remove();
  }

  // Another process has made it, of the same frames.
  bool is_there() const {
    if (order_.recipe.empty() || !document::file_exists(order_.file)) return false;
    const auto there = mark_of(comment_of(order_.file));
    return there && there->recipe == order_.recipe;
  }

  void add_audio_input(Words& words) const {
    if (has_audio()) add(words, {"-i", file_word(order_.audio->file)});
  }

  void add_rest(Words& words, const fs::path& part) const {
    const double rate = exact_rate(source_.rate);
    const double seconds = static_cast<double>(source_.frames.size()) / rate;
    if (!is_gif()) add(words, {"-map", "0:v:0"});
    if (has_audio()) {
      add(words, {"-map", "1:a:0"});
      add(words, audio_words(*order_.audio, form_, source_.begins, seconds));
    }
    add(words, {"-map_metadata", "-1", "-fflags", "+bitexact", "-metadata", "comment=" + text_of(mark())});
    add(words, container_words(form_));
    words.push_back(file_word(part));
  }

  Mark mark() const {
    const images::PictureSize size = coded_size(form_, source_.size);
    return {fs::path(source_.film).filename().string(),
            order_.recipe,
            source_.frames,
            source_.film_frames,
            source_.rate,
            size.width,
            size.height};
  }

  const Source& source_;
  const Order& order_;
  const Listener& listener_;
  const Form form_;
  const std::string program_;
  const Words encoding_;
};

// GIF and APNG files do not say who made them: a file that begins as one may be ours.
bool is_of_kind_without_comment(const fs::path& file) {
  constexpr std::string_view kGif = "GIF8", kPng = "\x89PNG";
  const std::string start = document::read_start(file, kGif.size());
  return start == kGif || start == kPng;
}

bool is_made_by_mars(const Order& order, const Form& form) try {
  return form.kind->has_audio ? is_mark(comment_of(order.file)) : is_of_kind_without_comment(order.file);
} catch (const Failure&) {  // it is no video
  return false;
}

void refuse_others_file(const Order& order, const Form& form) {
  std::error_code none;
  if (order.overwrite || fs::file_size(order.file, none) == 0 || none || is_made_by_mars(order, form)) return;
  throw Failure("is there already, and MARS has not made it", order.file.string(),
                "choose another name, or remove it first; mars render also replaces it with --overwrite");
}

// Pieces are joined by a list of files, in which a line's end ends a name.
void refuse_line_ends(const fs::path& file, const Form& form) {
  if (form.codec->cuts && fs::absolute(file).string().find_first_of("\n\r") != std::string::npos)
    throw Failure("has a line's end in its name or in that of a folder, which ffmpeg cannot read in a list of files",
                  file.string(), "choose another name, or another folder");
}

}  // namespace

std::string waiting_text(const Order& order) {
  return order.file.string() + ": another process makes it; waiting for that";
}

void check_order(const Order& order, const std::optional<images::PictureSize>& size) {
  const Form form = form_of(order.file, order.form);
  refuse_line_ends(order.file, form);
  choose_encoder(order.file, size ? encoders_for(form, *size) : form.codec->encoders);
  find_ffmpeg(order.file, "ffprobe");
  if (order.audio) document::refuse_same_file(order.audio->file, order.file);
  document::check_can_write(order.file);
  refuse_others_file(order, form);
  if (order.audio && form.kind->has_audio) check_audio(*order.audio);
}

void write_video(const Source& source, const Order& order, const Listener& listener) {
  check(!source.frames.empty(), "a video has pictures");
  Writing(source, order, listener).write();
}

}  // namespace mars::videos
