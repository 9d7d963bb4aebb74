// Files of a test, opened as the studio opens them.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "hal/failure/explain.h"
#include "host/content/document/file.h"
#include "host/studio/project/project.h"
#include "tests/host/studio/step_words.h"
#include "tests/temporary_folder.h"

namespace mars::studio {

inline constexpr const char* kPip = R"({
  "limbs": {"pelvis": "hip", "left": {"knee": "left-leg"}},
  "joints": [
    {"name": "hip", "place": [0, 0, 1], "segment": {"shape": "box", "sbb": [[-1, -1, 0], [1, 1, 1]], "material": "red"}},
    {"name": "head", "parent": "hip", "place": [0, 0, 1], "limits": {"y": [-30, 40]}, "segment": {"shape": "sphere"}},
    {"name": "left-leg", "parent": "hip", "place": [0, 0.5, 0], "limits": {"x": [-10, 30], "y": [0, 90]},
     "x_axis": [1, 0.25, 0], "segment": {"shape": "capsule", "ends": 0.2, "sbb": [[-0.1, -0.2, -1], [0.1, 0.3, 0]]}},
    {"name": "left-foot", "parent": "left-leg", "place": [0, 0.125, -1], "limits": {"z": [-5, 25]},
     "segment": {"shape": "left_hand"}}
  ],
  "materials": {"red": {"color": [1, 0, 0]}}
})";

inline constexpr const char* kFilm = R"({
  "frames": 48,
  "camera": {"eye": [9, -9, 4], "at": [0, 0, 1]},
  "models": {"pip": "pip.json"},
  "actors": [{"name": "one", "model": "pip"},
             {"name": "two", "model": "pip", "place": [3, 0, 0], "pose": {"head": [0, 10, 0]},
              "keys": [{"frame": 0, "pose": {"left-leg": [0, 0, 0]}, "ease": "both"},
                       {"frame": 24, "pose": {"left-leg": [10, 20, 0]}}]}]
})";

class OpenFiles : public testing::Test {
 protected:
  OpenFiles() {
    write("pip.json", kPip);
    write("film.json", kFilm);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string text(const std::string& name) const { return document::read_file(folder_ / name); }
  std::unique_ptr<Project> open(const std::string& name) const { return open_project(folder_ / name); }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  // Twice: the second look finds the file settled.
  static bool look(Project& project) {
    const bool first = project.look_at_files();
    return project.look_at_files() || first;
  }

  template <typename Act>
  static std::string refusal(Act act) {
    try {
      act();
    } catch (const Failure& failure) {
      return reason_of(failure);
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
  }

  static bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace mars::studio
