// No circles of #includes: neither of modules (x.h and x.cpp together are one) nor of folders.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/architecture/sources.h"

namespace {

namespace fs = std::filesystem;

using mars::test::Source;
using mars::test::sources;

// Which others each one includes.
using Graph = std::map<std::string, std::set<std::string>>;
using Path = std::vector<std::string>;

std::string module_of(const std::string& file) { return fs::path(file).replace_extension().generic_string(); }
std::string folder_of(const std::string& file) { return fs::path(file).parent_path().generic_string(); }

// The source file that `include` names, from the root or beside the file that has it; none: it is not ours.
std::optional<std::string> target_of(const Source& from, const std::string& include) {
  static const std::set<std::string> files = [] {
    std::set<std::string> all;
    for (const Source& source : sources()) all.insert(source.path);
    return all;
  }();
  for (const std::string& name : {include, folder_of(from.path) + "/" + include})
    if (files.count(name) != 0) return name;
  return std::nullopt;
}

Graph graph_of(std::string (*vertex_of)(const std::string& file)) {
  Graph graph;
  for (const Source& source : sources()) {
    std::set<std::string>& others = graph[vertex_of(source.path)];
    for (const std::string& include : source.includes)
      if (const auto target = target_of(source, include); target && vertex_of(*target) != vertex_of(source.path))
        others.insert(vertex_of(*target));
  }
  return graph;
}

// A shortest way from `start` back to it; empty if there is none.
Path circle_through(const Graph& graph, const std::string& start) {
  std::map<std::string, std::string> reached_from;
  Path queue{start};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::string& next : graph.at(queue[i])) {
      if (!reached_from.emplace(next, queue[i]).second) continue;
      if (next != start) {
        queue.push_back(next);
        continue;
      }
      Path circle{start};
      for (std::string at = queue[i]; at != start; at = reached_from.at(at)) circle.push_back(at);
      std::reverse(circle.begin() + 1, circle.end());
      return circle;
    }
  }
  return {};
}

// Each begins with its least member.
std::vector<Path> circles_in(const Graph& graph) {
  std::vector<Path> circles;
  for (const auto& [vertex, others] : graph) {
    Path circle = circle_through(graph, vertex);
    if (!circle.empty() && *std::min_element(circle.begin(), circle.end()) == vertex)
      circles.push_back(std::move(circle));
  }
  return circles;
}

void expect_no_circles(const Graph& graph) {
  EXPECT_GT(graph.size(), 15u) << "nothing to scan: the test is broken";
  for (const Path& circle : circles_in(graph)) {
    std::string text;
    for (const std::string& each : circle) text += each + " -> ";
    ADD_FAILURE() << text << circle.front();
  }
}

TEST(Circles, AreFound) {
  const Graph graph = {{"a", {"b"}}, {"b", {"c", "d"}}, {"c", {}},   {"d", {"c", "e"}},
                       {"e", {"b"}}, {"f", {"a", "g"}}, {"g", {"f"}}};
  EXPECT_EQ(circles_in(graph), (std::vector<Path>{{"b", "d", "e"}, {"f", "g"}}));
}

TEST(Circles, IncludesAreResolved) {
  const Graph modules = graph_of(module_of);
  EXPECT_EQ(modules.at("hal/nx/mesh"), std::set<std::string>{"hal/nx/cube"}) << "beside the file";
  EXPECT_EQ(modules.at("hal/failure/explain"),
            (std::set<std::string>{"hal/failure/failure", "hal/failure/process_limit"}));
  EXPECT_EQ(graph_of(folder_of).at("topology"), std::set<std::string>{"hal/failure"});
}

TEST(Circles, NoneOfModules) { expect_no_circles(graph_of(module_of)); }

TEST(Circles, NoneOfFolders) { expect_no_circles(graph_of(folder_of)); }

}  // namespace
