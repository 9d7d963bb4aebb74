// What a mesh file of another program becomes: joints with meshes in the unit cube, materials, and a list of what else
// the file holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/importer/joint_frame.h"
#include "host/content/importer/model_size.h"
#include "host/content/modeler/mesh.h"
#include "host/content/modeler/model.h"

namespace mars::importer {

// How a person wants the file read.
struct MeshOptions {
  glm::dmat3 upright{1};  // turns the file's axes into ours
  ModelSize size;
  std::optional<double> crease;  // degrees; given: normals follow from the faces, whatever the file says
  std::string joint;             // the first joint's name
  std::string set_material;      // "mars model rock.json set rock --material color": remedies begin so
  std::string set_limb{};        // "mars model rock.json set JOINT --limb": remedies begin so
  std::string images_folder{};   // "rock-images": where images will lie, as seen from the model's folder
  // Of glTF for a film, which shows animations, cameras and lights, too: how each node stands in the node above it
  // while the model rests; empty: as in the file, and for no film.
  std::vector<glm::dmat4> rest{};
  bool looks_ahead = false;  // a figure is turned until it looks along x, as far as its limbs say where it looks
};

struct Surface {
  double roughness, metallic;

  bool operator==(const Surface&) const = default;
};

// A file that shows the surface, for the day when surfaces show images.
struct MaterialImage {
  std::string_view use;  // a key of a material's images: "color"
  std::string file;      // "rock-images/stone.png"

  bool operator==(const MaterialImage&) const = default;
};

struct ImportedMaterial {
  std::array<double, 3> color;     // as shown
  std::optional<Surface> surface;  // given: of the reflection metallic-roughness
  std::vector<MaterialImage> images{};

  bool operator==(const ImportedMaterial&) const = default;
};

// Places in images and colours of a mesh's corners, which no picture shows yet. Rows of both are equally many where
// there are both.
struct MeshPaint {
  std::vector<std::array<float, 2>> uv;      // v upward
  std::vector<std::array<float, 4>> colors;  // as shown, and alpha
  std::vector<std::uint32_t> corners;        // the row of each of the mesh's corners; none: its vertex's number
};

// An image of the file, to be written beside the model: bytes that lie in the file, or a file's that lies beside it.
struct KeptImage {
  std::string file;  // as in MaterialImage
  std::string bytes;
  std::filesystem::path from{};  // where there are no bytes
};

// The faces of one material. A joint's parts are scaled together from its bounds into the unit cube, so that vertices
// they share stay the same.
struct MeshPart {
  std::optional<std::size_t> material;  // of the file's; none: the file gives none
  modeler::Mesh mesh;
  modeler::Box bounds;  // in the joint's axes
  MeshPaint paint{};
};

// A bone of a skin: what leads from the axes of the skin's joint to those of this one, in the model's units.
struct MeshBone {
  std::size_t joint;  // of the file's
  modeler::Affine bind;
};

// Which joint is which limb: "left.knee".
struct NamedLimb {
  std::string limb, joint;
};

// A joint with one part at the most.
struct MeshJoint {
  std::string name;
  std::string parent;  // "": it stands in the model's frame
  JointFrame frame;    // its origin in the parent's frame, in the model's units
  bool fixed = false;  // it shows a further material of its parent, and cannot turn
  std::optional<std::array<modeler::Limits, 3>> limits{};
  std::optional<MeshPart> part;
  bool has_skin = false;              // the part's vertices follow the file's bones
  std::size_t node = modeler::kNone;  // of the file, which the joint is; of glTF
};

struct MeshFile {
  std::vector<MeshJoint> joints;  // the first has no parent, all others do
  std::vector<MeshBone> bones;    // of the skins, ascending by joint
  bool are_bound_at_rest = true;  // the bones leave the mesh where it is while the model rests
  std::vector<NamedLimb> limbs;   // in the order of a model's
  std::vector<ImportedMaterial> materials;
  std::vector<KeptImage> images;
  glm::dvec3 extent;                              // of all faces; 0 where they are flat
  double factor = 1;                              // from the file's units to the model's
  std::size_t vertices = 0;                       // in the file, before those that agree in place and normal are joined
  std::vector<std::string> made;                  // besides: "a mean colour of 2 textures", ...
  std::vector<std::string> not_read;              // "19 bones", ...
  std::vector<std::filesystem::path> companions;  // files that were read besides: materials, buffers, textures
};

}  // namespace mars::importer
