#include "host/content/modeler/subdivision.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "host/content/elementary/elementary.h"

namespace mars::modeler {
namespace {

constexpr std::uint32_t kNoFace = ~std::uint32_t{0};
constexpr std::size_t kMostJoined = 6;  // edges of a point: of more, what joins smoothly is too far from a mean

struct Edge {
  std::uint32_t ends[2];
  std::uint32_t faces[2];  // the second: none at a border

  bool is_border() const { return faces[1] == kNoFace; }
  std::uint32_t other(std::uint32_t end) const { return ends[0] == end ? ends[1] : ends[0]; }
};

// What meets in a point.
struct Around {
  std::vector<std::uint32_t> edges, faces;
  std::vector<std::uint32_t> border;  // of the edges: none, or two
};

// A cage, and which of its parts meet.
class Topology {
 public:
  explicit Topology(const Cage& cage) : faces_(cage.faces), around_(cage.points) {
    for (std::uint32_t face = 0; face < faces_.size(); ++face) add(face);
    for (std::uint32_t edge = 0; edge < edges_.size(); ++edge)
      for (const std::uint32_t end : edges_[edge].ends) {
        around_[end].edges.push_back(edge);
        if (edges_[edge].is_border()) around_[end].border.push_back(edge);
      }
  }

  const std::vector<std::vector<std::uint32_t>>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const Around& around(std::uint32_t point) const { return around_[point]; }
  std::size_t points() const { return around_.size(); }
  std::uint32_t edge_between(std::uint32_t one, std::uint32_t other) const { return numbers_.at(key(one, other)); }

 private:
  static std::uint64_t key(std::uint32_t one, std::uint32_t other) {
    return std::uint64_t{std::min(one, other)} << 32 | std::max(one, other);
  }

  void add(std::uint32_t face) {
    const auto& corners = faces_[face];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
      around_[from].faces.push_back(face);
      const auto [known, is_new] = numbers_.try_emplace(key(from, to), static_cast<std::uint32_t>(edges_.size()));
      if (is_new)
        edges_.push_back({{from, to}, {face, kNoFace}});
      else
        edges_[known->second].faces[1] = face;
    }
  }

  const std::vector<std::vector<std::uint32_t>>& faces_;
  std::vector<Around> around_;
  std::vector<Edge> edges_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

// A cage whose points are means of those of the first.
struct Refined {
  Cage cage;
  std::vector<Mean> points;
};

Mean even(std::span<const Mean> means, std::span<const std::uint32_t> numbers) {
  std::vector<Share> shares;
  for (const std::uint32_t number : numbers) shares.push_back({means[number], 1.0 / double(numbers.size())});
  return sum_of(shares);
}

// A step: a quad for each corner of each face, between new points of faces, edges and points.
class Step {
 public:
  explicit Step(const Refined& from) : from_(from), topology_(from.cage) {}

  Refined taken() const {
    Refined to;
    for (const auto& corners : topology_.faces()) to.points.push_back(even(from_.points, corners));
    for (const Edge& edge : topology_.edges()) to.points.push_back(point_of(edge, to.points));
    for (std::uint32_t point = 0; point < topology_.points(); ++point) to.points.push_back(point_of(point, to.points));
    to.cage = {to.points.size(), quads()};
    return to;
  }

 private:
  Mean point_of(const Edge& edge, std::span<const Mean> of_faces) const {
    const Mean &one = from_.points[edge.ends[0]], &other = from_.points[edge.ends[1]];
    if (edge.is_border()) return sum_of(std::array{Share{one, 0.5}, Share{other, 0.5}});
    return sum_of(std::array{Share{one, 0.25}, Share{other, 0.25}, Share{of_faces[edge.faces[0]], 0.25},
                             Share{of_faces[edge.faces[1]], 0.25}});
  }

  Mean point_of(std::uint32_t point, std::span<const Mean> of_faces) const {
    const Around& around = topology_.around(point);
    const Mean& own = from_.points[point];
    if (around.faces.size() == 1) return own;
    std::vector<Share> shares;
    const auto neighbour = [&](std::uint32_t edge) -> const Mean& {
      return from_.points[topology_.edges()[edge].other(point)];
    };
    if (!around.border.empty()) {
      shares.push_back({own, 0.75});
      for (const std::uint32_t edge : around.border) shares.push_back({neighbour(edge), 0.125});
      return sum_of(shares);
    }
    const double valence = double(around.edges.size()), part = 1 / (valence * valence);
    shares.push_back({own, (valence - 2) / valence});
    for (const std::uint32_t edge : around.edges) shares.push_back({neighbour(edge), part});
    for (const std::uint32_t face : around.faces) shares.push_back({of_faces[face], part});
    return sum_of(shares);
  }

  std::vector<std::vector<std::uint32_t>> quads() const {
    const auto faces = static_cast<std::uint32_t>(topology_.faces().size());
    const auto edges = static_cast<std::uint32_t>(topology_.edges().size());
    std::vector<std::vector<std::uint32_t>> quads;
    for (std::uint32_t face = 0; face < faces; ++face) {
      const auto& corners = topology_.faces()[face];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t before = corners[(i + corners.size() - 1) % corners.size()], own = corners[i],
                            after = corners[(i + 1) % corners.size()];
        quads.push_back({faces + edges + own, faces + topology_.edge_between(own, after), face,
                         faces + topology_.edge_between(before, own)});
      }
    }
    return quads;
  }

  const Refined& from_;
  const Topology topology_;
};

// How much, 1 at most, of each of `ways` may be added to the mean that it stays one.
double farthest_of_means(const Mean& from, std::span<const std::vector<Term>> ways) {
  double far = 1;
  for (const std::vector<Term>& way : ways)
    for (const Term& term : way) {
      if (term.weight >= 0) continue;
      const auto own = std::ranges::find(from, term.point, &Term::point);
      far = std::min(far, own == from.end() ? 0 : own->weight / -term.weight);
    }
  return far;
}

// Of a ring of `count` numbers x the sums s of neighbours are known, s[k] = x[k - 1] + x[k]. The least x that has these
// sums, or is nearest to them, is x[k] = sum over m of parts[m] s[k + m].
std::vector<double> parts_of_sums(std::size_t count) {
  std::vector<double> parts(count, 0);
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t wave = 0; wave < count; ++wave) {
      if (2 * wave == count) continue;  // whose sums are 0
      const double half = std::numbers::pi * double(wave) / double(count);
      parts[m] += elementary::cos(half * (2 * double(m) - 1)) / (2 * elementary::cos(half)) / double(count);
    }
  return parts;
}

// Bezier points of quads: of each point one, of each edge two, of each face four.
class QuadPatches {
 public:
  explicit QuadPatches(const Refined& from) : from_(from), topology_(from.cage) {}

  MeanPatches made() {
    for (std::uint32_t face = 0; face < topology_.faces().size(); ++face)
      for (std::size_t corner = 0; corner < 4; ++corner) inner_.push_back(inner_point(face, corner));
    for (const Edge& edge : topology_.edges())
      for (const std::uint32_t end : edge.ends) on_edges_.push_back(edge_point(edge, end));
    for (std::uint32_t point = 0; point < topology_.points(); ++point) {
      net_.means.push_back(corner_point(point));
      if (is_irregular(point)) flatten(point, net_.means.back());
    }
    for (const auto step : {&QuadPatches::join, &QuadPatches::ease})
      for (std::uint32_t point = 0; point < topology_.points(); ++point)
        if (is_irregular(point) && topology_.around(point).edges.size() <= kMostJoined) (this->*step)(point);
    net_.means.insert(net_.means.end(), on_edges_.begin(), on_edges_.end());
    net_.means.insert(net_.means.end(), inner_.begin(), inner_.end());
    for (std::uint32_t face = 0; face < topology_.faces().size(); ++face) net_.patches.push_back(patch_of(face));
    return std::move(net_);
  }

 private:
  // Inside a face, next to its corner.
  Mean inner_point(std::uint32_t face, std::size_t corner) const {
    const auto& corners = topology_.faces()[face];
    const Around& around = topology_.around(corners[corner]);
    const std::size_t faces =
        around.border.empty() ? around.faces.size() : std::max<std::size_t>(4, 2 * around.faces.size());
    const double valence = double(faces), part = 1 / (valence + 5);
    const auto point = [&](std::size_t from) -> const Mean& { return from_.points[corners[(corner + from) % 4]]; };
    return sum_of(std::array{Share{point(0), valence * part}, Share{point(1), 2 * part}, Share{point(2), part},
                             Share{point(3), 2 * part}});
  }

  std::uint32_t inner_number(std::uint32_t face, std::uint32_t point) const {
    const auto& corners = topology_.faces()[face];
    return 4 * face + static_cast<std::uint32_t>(std::ranges::find(corners, point) - corners.begin());
  }

  // On an edge, next to one of its ends: between the faces' inner points.
  Mean edge_point(const Edge& edge, std::uint32_t end) const {
    if (edge.is_border())
      return sum_of(std::array{Share{from_.points[end], 2.0 / 3}, Share{from_.points[edge.other(end)], 1.0 / 3}});
    return even(inner_, std::array{inner_number(edge.faces[0], end), inner_number(edge.faces[1], end)});
  }

  // The middle of the inner points around.
  Mean corner_point(std::uint32_t point) const {
    const Around& around = topology_.around(point);
    if (around.faces.size() == 1 && !around.border.empty()) return from_.points[point];
    if (around.border.empty()) {
      std::vector<std::uint32_t> numbers;
      for (const std::uint32_t face : around.faces) numbers.push_back(inner_number(face, point));
      return even(inner_, numbers);
    }
    std::vector<Share> shares{{from_.points[point], 4.0 / 6}};
    for (const std::uint32_t edge : around.border)
      shares.push_back({from_.points[topology_.edges()[edge].other(point)], 1.0 / 6});
    return sum_of(shares);
  }

  // Where other than four edges meet, the points on these lie in no plane with the corner, and patches would meet at an
  // angle. The first harmonic of how they lie about the corner does lie in one; it is taken as far as points stay
  // means. The inner points go along.
  void flatten(std::uint32_t point, const Mean& corner) {
    const std::vector<Spoke> spokes = spokes_of(point);
    const std::size_t count = spokes.size();
    std::vector<Mean> before;
    std::vector<std::vector<Term>> ways;
    for (const Spoke& spoke : spokes) before.push_back(on_edges_[spoke.on_edge]);
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<Share> shares;
      for (std::size_t j = 0; j < count; ++j)
        shares.push_back({before[j], 2 * elementary::cos(2 * std::numbers::pi * double(j + count - k) / double(count)) /
                                         double(count)});
      ways.push_back(terms_of(shares));
    }
    const double far = farthest_of_means(corner, ways);
    for (std::size_t k = 0; k < count; ++k)
      on_edges_[spokes[k].on_edge] = sum_of(std::array{Share{corner, 1}, Share{ways[k], far}});
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = (k + 1) % count;
      Mean& inner = inner_[spokes[k].inner];
      inner = sum_of(std::array{Share{inner, 1}, Share{on_edges_[spokes[k].on_edge], 0.5}, Share{before[k], -0.5},
                                Share{on_edges_[spokes[next].on_edge], 0.5}, Share{before[next], -0.5}});
    }
  }

  // An edge from a point, and the face that follows it counter-clockwise: numbers in on_edges_ and inner_.
  struct Spoke {
    std::uint32_t on_edge, inner;
  };

  bool is_irregular(std::uint32_t point) const {
    return topology_.around(point).border.empty() && topology_.around(point).edges.size() != 4;
  }

  // Of a straight grid 0: as far as the middle of the edges before and behind an edge from the point lies along it, in
  // lengths of its first part.
  double bend_at(std::uint32_t point) const {
    if (!is_irregular(point)) return 0;
    return elementary::cos(2 * std::numbers::pi / double(topology_.around(point).edges.size()));
  }

  // Let an edge have the Bezier points p, and the points beside it be q and r. Normals on its sides are the same where
  // q + r - 2 p is a multiple of p's derivative, which goes evenly from 2 cos(2 pi / n) at the one end, where n edges
  // meet, to 0 at the other. So, with differences d of p, and b = cos(2 pi / n):
  //   q1 + r1 - 2 p1 = 4 b d1 / 3      join
  //   q2 + r2 - 2 p2 = 2 b d2 / 3      ease
  // and of edges between two such points, whose ends have b and B: q1 + r1 - 2 p1 = 4 b d1 / 3 - 2 B d0 / 3. Points
  // stay means, so this holds but nearly.
  //
  // Each inner point lies beside two of the edges: the least changes of all that suit these.
  void join(std::uint32_t point) {
    const std::vector<Spoke> spokes = spokes_of(point);
    const std::size_t count = spokes.size();
    const double bend = bend_at(point);
    const std::vector<double> parts = parts_of_sums(count);
    std::vector<Mean> joined;
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<Share> shares{{inner_[spokes[k].inner], 1}};
      for (std::size_t m = 0; m < count; ++m) {
        const Spoke &spoke = spokes[(k + m) % count], &before = spokes[(k + m + count - 1) % count];
        const std::uint32_t end = end_of(spoke, point);
        const double other = bend_at(end), far = 4 * bend / 3 * (is_irregular(end) ? 1 : 1 + shortened(bend));
        shares.push_back({on_edges_[spoke.on_edge], parts[m] * (2 - far - 2 * other / 3)});
        shares.push_back({on_edges_[spoke.on_edge ^ 1], parts[m] * far});
        shares.push_back({net_.means[point], parts[m] * 2 * other / 3});
        for (const std::uint32_t beside : {spoke.inner, before.inner}) shares.push_back({inner_[beside], -parts[m]});
      }
      joined.push_back(sum_of(shares));
    }
    for (std::size_t k = 0; k < count; ++k) inner_[spokes[k].inner] = std::move(joined[k]);
  }

  // How much of the last third of an edge ease() takes away where three edges meet at its beginning.
  static double shortened(double bend) { return bend < 0 ? 1 - 1 / (1 - bend / 3) : 0; }

  std::uint32_t end_of(const Spoke& spoke, std::uint32_t point) const {
    return topology_.edges()[spoke.on_edge / 2].other(point);
  }

  // At the regular ends of the edges: where three meet p2 comes nearer to the end; where more do q2 and r2 come nearer
  // to the next edges.
  void ease(std::uint32_t point) {
    const double bend = bend_at(point), nearer = shortened(bend);
    for (const Spoke& spoke : spokes_of(point)) {
      const std::uint32_t end = end_of(spoke, point);
      if (is_irregular(end)) continue;
      Mean& far = on_edges_[spoke.on_edge ^ 1];
      if (bend < 0) {
        far = sum_of(std::array{Share{far, 1 - nearer}, Share{net_.means[end], nearer}});
        continue;
      }
      for (const std::uint32_t face : topology_.edges()[spoke.on_edge / 2].faces) {
        Mean& inner = inner_[inner_number(face, end)];
        inner = sum_of(
            std::array{Share{inner, 1 - bend / 3}, Share{on_edges_[next_edge_point(face, end, point)], bend / 3}});
      }
    }
  }

  // On the face's other edge at `point` than that to `end`, next to `point`.
  std::uint32_t next_edge_point(std::uint32_t face, std::uint32_t point, std::uint32_t end) const {
    const auto& corners = topology_.faces()[face];
    const std::uint32_t at = inner_number(face, point) % 4;
    const std::uint32_t after = corners[(at + 1) % 4], before = corners[(at + 3) % 4];
    const std::uint32_t edge = topology_.edge_between(point, after == end ? before : after);
    return 2 * edge + (topology_.edges()[edge].ends[0] == point ? 0 : 1);
  }

  std::vector<Spoke> spokes_of(std::uint32_t point) const {
    std::vector<Spoke> spokes;
    std::uint32_t face = topology_.around(point).faces[0];
    do {
      const std::uint32_t inner = inner_number(face, point);
      const auto& corners = topology_.faces()[face];
      const std::uint32_t edge = topology_.edge_between(point, corners[(inner + 1) % 4]),
                          last = topology_.edge_between(point, corners[(inner + 3) % 4]);
      spokes.push_back({2 * edge + (topology_.edges()[edge].ends[0] == point ? 0 : 1), inner});
      const auto& sides = topology_.edges()[last].faces;
      face = sides[0] == face ? sides[1] : sides[0];
    } while (face != topology_.around(point).faces[0]);
    return spokes;
  }

  // u runs from corner 0 to corner 1, v from corner 0 to corner 3.
  wire::PatchStencils patch_of(std::uint32_t face) const {
    static constexpr std::size_t kCorner[] = {0, 3, 15, 12}, kInner[] = {5, 6, 10, 9};
    static constexpr std::size_t kSide[4][2] = {{1, 2}, {7, 11}, {14, 13}, {8, 4}};
    const auto points = static_cast<std::uint32_t>(topology_.points());
    const auto edges = static_cast<std::uint32_t>(topology_.edges().size());
    const auto& corners = topology_.faces()[face];
    wire::PatchStencils patch;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t from = corners[i], number = topology_.edge_between(from, corners[(i + 1) % 4]);
      const std::uint32_t begins = topology_.edges()[number].ends[0] == from ? 0 : 1;
      patch[kCorner[i]] = from;
      patch[kSide[i][0]] = points + 2 * number + begins;
      patch[kSide[i][1]] = points + 2 * number + 1 - begins;
      patch[kInner[i]] = points + 2 * edges + 4 * face + static_cast<std::uint32_t>(i);
    }
    return patch;
  }

  const Refined& from_;
  const Topology topology_;
  std::vector<Mean> inner_;     // of each face four
  std::vector<Mean> on_edges_;  // of each edge two, by its ends
  MeanPatches net_;
};

// Whether the faces around the point hang together by edges.
bool is_one_fan(const Topology& topology, const Around& around) {
  std::vector<std::uint32_t> found{around.faces[0]};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const std::uint32_t edge : around.edges) {
      const auto& sides = topology.edges()[edge].faces;
      for (const std::size_t side : {0, 1})
        if (sides[side] == found[i] && sides[1 - side] != kNoFace && !std::ranges::count(found, sides[1 - side]))
          found.push_back(sides[1 - side]);
    }
  return found.size() == around.faces.size();
}

}  // namespace

std::optional<CageFault> fault_of(const Cage& cage) {
  std::unordered_map<std::uint64_t, std::size_t> directed;
  for (std::size_t face = 0; face < cage.faces.size(); ++face) {
    const auto& corners = cage.faces[face];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint64_t way = std::uint64_t{corners[i]} << 32 | corners[(i + 1) % corners.size()];
      if (const auto [known, is_new] = directed.try_emplace(way, face); !is_new)
        return CageFault{face, 0,
                         "goes from point " + std::to_string(corners[i]) + " to point " +
                             std::to_string(corners[(i + 1) % corners.size()]) + " as face " +
                             std::to_string(known->second) + " does",
                         "name corners counter-clockwise as seen from outside; an edge joins at most two faces"};
    }
  }
  const Topology topology(cage);
  for (std::uint32_t point = 0; point < cage.points; ++point) {
    const Around& around = topology.around(point);
    if (around.faces.empty()) return CageFault{{}, point, "belongs to no face", "take it out"};
    if (around.faces.size() > kMostAround)
      return CageFault{{},
                       point,
                       "joins " + std::to_string(around.faces.size()) + " faces",
                       "let " + std::to_string(kMostAround) + " faces at most meet in a point"};
    if (!is_one_fan(topology, around))
      return CageFault{{}, point, "joins faces that share no edge in it", "give each of its sides a point of its own"};
  }
  return std::nullopt;
}

MeanPatches subdivided(const Cage& cage, int level) {
  Refined refined{cage, {}};
  for (std::uint32_t point = 0; point < cage.points; ++point) refined.points.push_back({{point, 1}});
  for (int step = 0; step < level; ++step) refined = Step(refined).taken();
  return QuadPatches(refined).made();
}

}  // namespace mars::modeler
