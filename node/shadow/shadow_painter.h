// Draws lines of pictures in which lights cast shadows, band by band: what of a band is seen, still and moving; which
// of its pairs (pairs.h) casters block; then its pixels. A film in which no light casts is drawn line by line instead
// (raster/scanline.h).
//
// Still casters block pairs of still and moving points, in a keyframe; what they leave of still ones is kept for
// inbetweens, in which still casters block pairs of moving points alone. Moving casters block pairs of both kinds, of
// still ones near their shadows. Still pixels that lose pairs to moving casters are summed up again and go out as
// moving ones.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "hal/messages/private_memory.h"
#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/raster/arena.h"
#include "node/raster/line_boxes.h"
#include "node/raster/pixel_groups.h"
#include "node/raster/scanline.h"
#include "node/raster/still_lines.h"
#include "node/raster/strip_buffer.h"
#include "node/raster/z_line.h"
#include "node/shadow/band.h"
#include "node/shadow/shadow_caster.h"
#include "node/shadow/shadow_plan.h"

namespace mars::shadow {

// A frame as one node draws it.
struct Picture {
  const geometry::Scene& scene;
  const geometry::Sweep& sweep;  // of the interval
  const shading::Shading& shading;
  raster::LineParts parts;
  raster::StillLines& still;
  bool is_keyframe;
};

class ShadowPainter {
 public:
  // `plan`: of the scene's film.
  ShadowPainter(simd::InstructionSet set, const geometry::Scene& scene, const ShadowPlan& plan,
                bool has_layers = false);

  // An interval begins, also on nodes that draw nothing of its keyframe.
  void forget_still() { caster_.forget_still(); }
  // Where surfaces of the picture go that are diced for the camera, so that their shadows need not dice them again.
  DicedSurfaces& diced() { return caster_.diced(); }
  // `look` is called now and then, while the picture is drawn.
  void begin(const Picture& picture, const std::function<void()>& look);
  // Prepares lines from the first of `lines` on, as many as there is memory for: decides what is seen on them; says
  // which. Then cast() finds what casters block of it.
  geometry::LineRange see(const Picture& picture, const geometry::LineRange& lines);
  void cast(const Picture& picture);
  // Puts a line that is prepared.
  void put_line(const Picture& picture, std::uint32_t line, raster::StripBuffer& out);

  raster::DrawnCounts take_counts() { return std::exchange(counts_, {}); }
  CastCounts take_cast_counts() { return caster_.take_counts(); }

 private:
  // One line's groups of one kind, with their light.
  struct LineGroups {
    raster::GroupCounts counts{0, 0};
    raster::Groups groups{};
    shading::UnsummedLight light{};
    const LayerLine* from = nullptr;

    std::uint32_t count() const { return counts.pixels + counts.others; }
  };
  struct Line {
    LineGroups still, moving;
    raster::UnsummedStill again{};          // what still groups are summed up again from, where movers are
    const LayerLine* still_from = nullptr;  // their pairs
    bool is_kept = false;                   // a keyframe's, for inbetweens
  };

  void see_keyframe(const Picture& picture, std::uint32_t number);
  void see_inbetween(const Picture& picture, std::uint32_t number);
  shading::Extent see_still(const Picture& picture, std::uint32_t number);
  void see_kept(const Picture& picture, std::uint32_t number);
  shading::Extent see_moving(const Picture& picture, std::uint32_t number);
  void cast_by_rows(const geometry::Scene& scene);
  LineGroups shade(const Picture& picture, std::uint32_t number, const shading::Extent& extent);
  void copy_depths(float* to, const shading::Extent& extent);
  raster::UnsummedStill new_record(const Picture& picture, std::uint32_t groups);
  void keep_groups(const Picture& picture);
  void keep_pairs(raster::StillLines& still);
  void count_kept_tiles(const raster::StillLines& still);
  void find_lit(const Picture& picture, const LineGroups& groups, wire::StillPairs* pairs) const;
  template <typename Has>
  void fill_record(const Picture& picture, std::uint32_t number, const LineGroups& groups,
                   const raster::UnsummedStill& to, const Has& has) const;
  std::uint16_t* new_moved();

  void sum_up(const Picture& picture, const LineGroups& groups, bool with_moved);
  float open_share(const LayerLine& from, std::uint32_t light, std::uint32_t column, std::uint32_t samples,
                   bool with_moved) const;
  void sum_up_unshadowed(const Picture& picture, const LineGroups& groups);
  void find_changed(const Picture& picture, const Line& line);
  void put_still_light(const Picture& picture, const Line& line, std::uint32_t column, bool shadowed);
  void sum_up_again(const Picture& picture, const Line& line, std::uint32_t column);

  const raster::RasterKernels& raster_kernels_;
  const shading::ShadingKernels& shading_kernels_;
  std::uint32_t width_;
  std::uint32_t samples_;
  std::uint32_t casting_;
  raster::ZLine z_line_;
  raster::PixelGroups groups_;
  ShadowCaster caster_;

  // Of the band.
  std::size_t bytes_of_line_;  // at most
  std::size_t most_squares_;   // that there is memory for points of
  messages::PrivateMemory memory_;
  raster::Arena arena_;
  Layer drawn_, kept_, moving_;  // kept_: still lines of the interval's keyframe; drawn_: those drawn now
  std::vector<Line> lines_;
  geometry::LineRange range_{0, 0};
  std::array<std::vector<std::uint32_t>, 3> tiles_;  // of the three layers, to be cast on

  // Of a line that is put.
  std::vector<std::vector<float>> shares_;  // by casting light
  std::vector<const float*> share_rows_;
  std::vector<std::uint32_t> changed_;  // columns
  std::vector<wire::StillGroup> still_groups_;
  std::vector<wire::StillGroup> unshadowed_groups_;  // of pictures with that layer
  std::vector<std::uint32_t> no_ends_;               // of a line without groups
  std::vector<std::uint64_t> row_tiles_;             // of a row of tiles
  raster::DrawnCounts counts_;
};

}  // namespace mars::shadow
