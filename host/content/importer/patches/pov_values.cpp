#include "host/content/importer/patches/pov_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/patches/patch_scene.h"

namespace mars::importer {
namespace {

constexpr std::size_t kMostNumbers = 12;  // of a matrix

// Number by number; one number stands for as many as the other has.
PovValue combined(const PovValue& one, const PovValue& other, auto how) {
  PovValue all(std::max(one.size(), other.size()));
  const auto at = [](const PovValue& value, std::size_t i) {
    return value.size() == 1 ? value[0] : i < value.size() ? value[i] : 0.0;
  };
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = how(at(one, i), at(other, i));
  return all;
}

}  // namespace

const PovWord& PovValues::take() {
  const PovWord& word = peek();
  if (word.kind != PovKind::end) ++place_;
  return word;
}

bool PovValues::take_sign(const char* sign) {
  if (!peek().is(PovKind::sign, sign)) return false;
  ++place_;
  return true;
}

void PovValues::refuse(const std::string& problem, const std::string& remedy) const {
  throw Failure(problem, text_.place_of(peek()), remedy);
}

void PovValues::expect_sign(const char* sign) {
  if (take_sign(sign)) return;
  const std::string found = peek().kind == PovKind::end ? "its end" : "'" + document::printable(peek().text, 40) + "'";
  refuse("has " + found + " where a '" + sign + "' should be", "check what stands before it");
}

PovValue PovValues::value() {
  PovValue sum = product();
  while (true) {
    if (take_sign("+"))
      sum = combined(sum, product(), [](double a, double b) { return a + b; });
    else if (take_sign("-"))
      sum = combined(sum, product(), [](double a, double b) { return a - b; });
    else
      return sum;
  }
}

PovValue PovValues::product() {
  PovValue all = part();
  while (true) {
    if (take_sign("*"))
      all = combined(all, part(), [](double a, double b) { return a * b; });
    else if (take_sign("/"))
      all = combined(all, part(), [](double a, double b) { return a / b; });
    else
      return all;
  }
}

PovValue PovValues::list() {
  PovValue numbers;
  do {
    const PovValue one = value();
    if (one.size() != 1 || numbers.size() == kMostNumbers)
      refuse("has a vector of what are no 12 single numbers at most", "write numbers between < and >");
    numbers.push_back(one[0]);
    take_sign(",");
  } while (!take_sign(">"));
  return numbers;
}

PovValue PovValues::part() {
  if (++depth_ > kDeepestScene) refuse("has values within values, too deep", "write numbers in their place");
  const PovWord& word = peek();
  PovValue found;
  if (word.kind == PovKind::number) {
    found = {take().number};
  } else if (take_sign("<")) {
    found = list();
  } else if (take_sign("(")) {
    found = value();
    expect_sign(")");
  } else if (take_sign("-")) {
    found = combined({0}, part(), [](double a, double b) { return a - b; });
  } else if (take_sign("+")) {
    found = part();
  } else if (word.kind == PovKind::word && std::ranges::find(kColorWords, word.text) != kColorWords.end()) {
    take();
    found = part();
  } else if (word.is(PovKind::word, "x") || word.is(PovKind::word, "y") || word.is(PovKind::word, "z")) {
    found = {0, 0, 0};
    found[static_cast<std::size_t>(take().text[0] - 'x')] = 1;
  } else if (word.is(PovKind::word, "pi")) {
    take();
    found = {std::numbers::pi};
  } else if (const auto known = declared_.find(word.text); word.kind == PovKind::word && known != declared_.end()) {
    take();
    found = known->second;
  } else {
    refuse(word.kind == PovKind::end ? "ends where a number or a vector should be"
                                     : "has '" + document::printable(word.text, 40) + "', whose value is not known",
           "write a number or a vector in its place");
  }
  --depth_;
  return found;
}

double PovValues::number() {
  const PovValue found = value();
  if (found.size() != 1) refuse("has a vector where a number should be", "write a number");
  return found[0];
}

glm::dvec3 PovValues::vector() {
  const PovValue found = value();
  if (found.size() == 2 || found.size() > 5) refuse("has what is no vector of three numbers", "write <x, y, z>");
  return found.size() == 1 ? glm::dvec3(found[0]) : glm::dvec3(found[0], found[1], found[2]);
}

}  // namespace mars::importer
