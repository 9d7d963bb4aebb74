// Numbers and vectors of POV-Ray: sums and products of numbers, vectors, x, y, z and what #declare names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/content/importer/patches/pov_words.h"

namespace mars::importer {

using PovValue = std::vector<double>;  // 1 to 5 numbers, of a matrix 12

// Before the numbers of a colour.
inline constexpr std::array<std::string_view, 7> kColorWords{"color", "colour", "rgb", "rgbf", "rgbt", "rgbft", "srgb"};

class PovValues {
 public:
  // `text` must outlive this.
  explicit PovValues(const PovText& text) : text_(text), words_(text.words) {}
  explicit PovValues(const PovText&&) = delete;

  const PovWord& peek(std::size_t ahead = 0) const { return words_[std::min(place_ + ahead, words_.size() - 1)]; }
  const PovWord& take();
  bool take_sign(const char* sign);
  void expect_sign(const char* sign);

  std::size_t place() const { return place_; }
  void go_to(std::size_t place) { place_ = place, depth_ = 0; }  // between values

  void declare(const std::string& name, PovValue value) { declared_[name] = std::move(value); }

  PovValue value();
  double number();
  glm::dvec3 vector();  // a number stands for three

  // At the line of the word that is next.
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

 private:
  PovValue product();
  PovValue part();
  PovValue list();

  const PovText& text_;
  const std::vector<PovWord>& words_;
  std::size_t place_ = 0, depth_ = 0;
  std::map<std::string, PovValue> declared_;
};

}  // namespace mars::importer
