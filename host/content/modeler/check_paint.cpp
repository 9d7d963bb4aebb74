#include "host/content/modeler/check_paint.h"

#include <optional>
#include <string>

namespace mars::modeler {
namespace {

void check_rows(const document::Element& list, std::size_t fewest, std::size_t most, document::Range range) {
  for (const document::Element row : list) {
    document::require_kind(row, document::Kind::list);
    if (row.size() < fewest || row.size() > most)
      row.refuse("has " + std::to_string(row.size()) + " numbers",
                 "write " + std::to_string(fewest) + (most > fewest ? " or " + std::to_string(most) : ""));
    for (const document::Element number : row) document::read_number(number, range);
  }
}

void check_faces(const document::Element& list, std::size_t rows, const Mesh& mesh) {
  document::require_size(list, mesh.ends.size());
  if (rows == 0) list.refuse("has no rows to number", "take it out, or give the mesh uv or colors");
  std::size_t face = 0;
  for (const document::Element item : list) {
    document::require_size(item, mesh.face(face++).size());
    for (const document::Element corner : item) document::read_count(corner, 0, static_cast<std::uint32_t>(rows - 1));
  }
}

}  // namespace

void check_paint(const document::Fields& fields, const Mesh& mesh) {
  const auto uv = fields.find("uv"), colors = fields.find("colors"), faces = fields.find("paint_faces");
  for (const auto& list : {uv, colors})
    if (list && !faces) document::require_size(*list, mesh.vertices.size());
  if (uv && colors) document::require_size(*colors, uv->size());
  if (uv) check_rows(*uv, 2, 2, {-document::kFarthest, document::kFarthest});
  if (colors) check_rows(*colors, 3, 4, {0, 1});
  if (faces) check_faces(*faces, uv ? uv->size() : colors ? colors->size() : 0, mesh);
}

}  // namespace mars::modeler
