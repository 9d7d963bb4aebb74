#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/text.h"
#include "host/images/display_view.h"

namespace mars::images {
namespace {

namespace OCIO = OCIO_NAMESPACE;

class OcioView : public DisplayView {
 public:
  OcioView(ViewName name, OCIO::ConstCPUProcessorRcPtr processor)
      : DisplayView(std::move(name)), processor_(std::move(processor)) {}

  void show(std::span<float> rgb) const override {
    OCIO::PackedImageDesc pixels(rgb.data(), static_cast<long>(rgb.size() / 3), 1, 3);
    processor_->apply(pixels);
  }

 private:
  OCIO::ConstCPUProcessorRcPtr processor_;
};

// Without OpenColorIO's first sentence, which names the file, and the words of the reader of YAML beneath it.
std::string reason_of(const OCIO::Exception& failure) {
  constexpr std::size_t kLongest = 300;  // it may repeat what stands in the file
  constexpr std::string_view kFirst = "' failed. ", kYaml = "yaml-cpp: error at ";
  const std::string_view all = failure.what();
  const std::size_t first = all.find(kFirst), yaml = all.find(kYaml);
  if (yaml != all.npos) {
    const std::string_view place = all.substr(yaml + kYaml.size());
    return "it is not written as such configs are, in YAML, at " +
           document::printable(place.substr(0, place.find(':')), kLongest);
  }
  return document::printable(first == all.npos ? all : all.substr(first + kFirst.size()), kLongest);
}

OCIO::ConstConfigRcPtr read_config(const std::string& file) try {
  if (!std::filesystem::is_regular_file(file))
    throw Failure("is no file", file, "name an OpenColorIO config with --ocio");
  OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(file.c_str());
  config->validate();
  return config;
} catch (const OCIO::Exception& failure) {
  throw Failure("is no sound OpenColorIO config: " + reason_of(failure), file, "see what `ociocheck --iconfig` says");
}

// The chosen one of `count` names, or the default.
template <typename NameAt>
std::string choose(const std::string& wish, const char* usual, int count, const NameAt& name_at, const char* what,
                   const std::string& file) {
  const std::string chosen = wish.empty() ? usual : wish;
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.emplace_back(name_at(i));
  if (std::ranges::find(names, chosen) == names.end())
    throw Failure("has no " + std::string(what) + " " + document::in_quotes(chosen), file,
                  "it has " + document::joined(names));
  return chosen;
}

ViewName name_of(const OCIO::ConstConfigRcPtr& config, const ViewWish& wish) {
  ViewName name;
  name.config = std::filesystem::absolute(wish.config).lexically_normal().string();
  name.display = choose(
      wish.display, config->getDefaultDisplay(), config->getNumDisplays(), [&](int i) { return config->getDisplay(i); },
      "display", wish.config);
  const char* display = name.display.c_str();
  name.view = choose(
      wish.view, config->getDefaultView(display), config->getNumViews(display),
      [&](int i) { return config->getView(display, i); }, "view", wish.config);
  name.input = wish.input.empty() ? OCIO::ROLE_SCENE_LINEAR : wish.input;
  if (!config->getColorSpace(name.input.c_str()))
    throw Failure("has no colour space or role " + document::in_quotes(name.input), wish.config,
                  "name the space of linear light with sRGB's primaries: --ocio-input SPACE");
  return name;
}

OCIO::ConstProcessorRcPtr processor_of(const OCIO::ConstConfigRcPtr& config, const ViewName& name) {
  const OCIO::DisplayViewTransformRcPtr transform = OCIO::DisplayViewTransform::Create();
  transform->setSrc(name.input.c_str());
  transform->setDisplay(name.display.c_str());
  transform->setView(name.view.c_str());
  return config->getProcessor(transform);
}

}  // namespace

std::shared_ptr<const DisplayView> open_view(const ViewWish& wish) {
  const OCIO::ConstConfigRcPtr config = read_config(wish.config);
  ViewName name = name_of(config, wish);
  try {
    const OCIO::ConstProcessorRcPtr processor = processor_of(config, name);
    const std::string computed = processor->getCacheID();
    name.checksum = document::checksum_of(std::as_bytes(std::span(computed)));
    return std::make_shared<OcioView>(std::move(name),
                                      processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS));
  } catch (const OCIO::Exception& failure) {
    throw Failure("cannot show light by " + text_of(name) + ": " + reason_of(failure), wish.config,
                  "see whether its files are there: `ociocheck --iconfig`");
  }
}

std::optional<std::string> view_library_version() { return OCIO::GetVersion(); }

}  // namespace mars::images
