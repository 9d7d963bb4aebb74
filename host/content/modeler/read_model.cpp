#include "host/content/modeler/read_model.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/material.h"
#include "host/content/modeler/proportions.h"
#include "host/content/modeler/read_bspline.h"
#include "host/content/modeler/read_mesh.h"
#include "host/content/modeler/read_subdivision.h"
#include "host/content/modeler/shape_library.h"
#include "node/shape/dual_quaternion.h"

namespace mars::modeler {
namespace {

constexpr std::string_view kAxes[] = {"x", "y", "z"};
constexpr double kLeastSine = 1e-3;  // between a joint's axes

std::vector<std::string_view> names_of(const auto& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

wire::Patch read_patch(const document::Element& element) {
  document::require_size(element, 16);
  wire::Patch patch;
  std::size_t number = 0;
  for (const document::Element item : element) {
    const glm::dvec3 point = document::read_vector(item, {0, 1});
    for (int axis = 0; axis < 3; ++axis) patch.points[number][axis] = static_cast<float>(point[axis]);
    ++number;
  }
  return patch;
}

std::vector<wire::Patch> read_patches(const document::Element& list) {
  document::require_kind(list, document::Kind::list);
  if (list.size() == 0) list.refuse("has no patches", "give at least one, or take the shape out");
  std::vector<wire::Patch> patches;
  patches.reserve(list.size());
  for (const document::Element patch : list) patches.push_back(read_patch(patch));
  return patches;
}

Shape read_own_shape(const std::string& name, const document::Element& element) {
  if (element.kind() != document::Kind::object) return {name, read_patches(element), {}};
  const document::Fields fields(element, keys::object("surface"));
  const auto bspline = fields.find("bspline"), subdivision = fields.find("subdivision"), mesh = fields.find("mesh");
  const int kinds = bspline.has_value() + subdivision.has_value() + mesh.has_value();
  if (kinds != 1)
    element.refuse(kinds > 1 ? "is several kinds of surface" : "is no bspline, subdivision or mesh",
                   "give it one of bspline, subdivision and mesh");
  if (mesh) return {name, {}, read_mesh(*mesh)};
  PatchShape surface = bspline ? read_bspline(*bspline) : read_subdivision(*subdivision);
  return {name, std::move(surface.patches), {}, std::move(surface.net)};
}

class ModelReader {
 public:
  // `sources`: the files that are being read, each derived from the next.
  ModelReader(std::span<const std::string_view> film_materials, const std::vector<std::filesystem::path>& sources)
      : material_names_(film_materials.begin(), film_materials.end()), sources_(sources) {}

  Model read(const document::Element& element) {
    const document::Fields fields(element, keys::object("model"));
    if (const auto from = fields.find("from")) return derive(fields, *from);
    if (const auto proportions = fields.find("proportions"))
      proportions->refuse("stands without from", "name the model file they belong to: \"from\": \"human.json\"");
    if (const auto materials = fields.find("materials")) read_materials(*materials);
    if (const auto shapes = fields.find("shapes")) read_shapes(*shapes);
    read_joints(fields.required("joints"));
    read_skins();
    if (const auto limbs = fields.find("limbs")) model_.limbs = read_limbs(*limbs, model_.joints);
    return std::move(model_);
  }

 private:
  // Another file's model with other proportions, and materials of its own in place of those of the same names.
  Model derive(const document::Fields& fields, const document::Element& from) {
    for (const std::string_view key : {"joints", "shapes", "limbs"})
      if (const auto other = fields.find(key))
        other->refuse("stands beside from",
                      "a derived model has those of " + document::read_text(from) + ": take it out");
    model_ = read_source(from);
    if (const auto materials = fields.find("materials")) replace_materials(*materials);
    try {
      apply(read_proportions(fields.required("proportions")), model_);
    } catch (const Failure& failure) {
      if (failure.where.find(':') != std::string::npos) throw;  // it names the line already
      throw Failure(failure.problem, fields.find("proportions")->where() + ": " + failure.where, failure.remedy);
    }
    return std::move(model_);
  }

  Model read_source(const document::Element& from) const {
    const std::filesystem::path path = document::read_file_name(from).lexically_normal();
    if (std::ranges::count(sources_, path) || path == std::filesystem::path(from.document().name()).lexically_normal())
      from.refuse("derives the model from itself", "name a file with joints");
    std::vector<std::filesystem::path> sources = sources_;
    sources.push_back(path);
    const document::Document document = document::read_document(from, path);
    std::vector<std::string_view> names(material_names_.begin(), material_names_.end());
    return ModelReader(names, sources).read(document.root());
  }

  void replace_materials(const document::Element& element) {
    std::vector<NamedMaterial> others = std::exchange(model_.materials, {});
    read_materials(element);
    for (NamedMaterial& other : others)
      if (std::ranges::none_of(model_.materials, [&](const NamedMaterial& own) { return own.name == other.name; }))
        model_.materials.push_back(std::move(other));
  }

  void read_materials(const document::Element& element) {
    document::require_kind(element, document::Kind::object);
    for (const document::Element item : element)
      model_.materials.push_back(
          {checked_name(item, item.key()), read_material(document::Fields(item, keys::object("material")))});
    for (const NamedMaterial& material : model_.materials) material_names_.insert(material.name);
  }

  void read_shapes(const document::Element& element) {
    document::require_kind(element, document::Kind::object);
    for (const document::Element item : element) {
      const std::string name = checked_name(item, item.key());
      if (find_library_shape(name)) item.refuse("has the name of a primitive", "choose another name");
      model_.shapes.push_back(read_own_shape(name, item));
    }
    own_shapes_ = model_.shapes.size();
  }

  // The shape that `fields` names: one of the model's own, or of the library, made once for each value of its
  // option.
  std::size_t read_shape(const document::Fields& fields) {
    const document::Element element = fields.required("shape");
    const std::string name = document::read_text(element);
    const LibraryShape* known = find_library_shape(name);
    refuse_other_options(fields, known, name);
    if (!known) return find_own_shape(element, name);
    const OptionValues values = read_option(fields, *known);
    const auto [made, is_new] = library_.try_emplace({known->name, values}, model_.shapes.size());
    if (is_new) model_.shapes.push_back({name, known->make(values)});
    return made->second;
  }

  static OptionValues read_option(const document::Fields& fields, const LibraryShape& shape) {
    OptionValues values{};
    if (shape.option == nullptr) return values;
    const document::Element given = fields.value(shape.option->name);
    const auto numbers = std::span(values).first(keys::count_of(*shape.option));
    if (numbers.size() > 1 && given.kind() == document::Kind::list) {
      document::require_size(given, numbers.size());
      std::size_t at = 0;
      for (const document::Element item : given) numbers[at++] = document::read_number(item, *shape.option);
    } else {
      std::ranges::fill(numbers, document::read_number(given, *shape.option));
    }
    return values;
  }

  std::size_t find_own_shape(const document::Element& element, const std::string& name) const {
    std::vector<std::string_view> own;
    for (std::size_t i = 0; i < own_shapes_; ++i) {
      if (model_.shapes[i].name == name) return i;
      own.push_back(model_.shapes[i].name);
    }
    element.refuse("is " + document::in_quotes(name) + ", which is no shape of the library or of this model",
                   likely_shape(name, own));
  }

  static void refuse_other_options(const document::Fields& fields, const LibraryShape* own, const std::string& shape) {
    for (const LibraryShape& other : shape_library()) {
      if (other.option == nullptr || (own != nullptr && other.option == own->option)) continue;
      if (const auto option = fields.find(other.option->name))
        option->refuse("belongs to the shape " + std::string(other.name) + ", not to " + shape, "take it out");
    }
  }

  static Box read_box(const document::Element& element) {
    document::require_size(element, 2);
    const auto corners = element.begin();
    auto second = corners;
    ++second;
    const Box box{document::read_vector(*corners), document::read_vector(*second)};
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.min[axis] < box.max[axis]))
        element.refuse(std::string("has no extent along ") + "xyz"[axis],
                       "write [[least x, y, z], [greatest x, y, z]], each least below its greatest");
    return box;
  }

  Segment read_segment(const document::Element& element) {
    const document::Fields fields(element, keys::object("segment"));
    Segment segment{read_shape(fields), read_box(fields.value("sbb")), fields.text("material", "")};
    if (!segment.material.empty() && !material_names_.contains(segment.material)) {
      const std::vector<std::string_view> names(material_names_.begin(), material_names_.end());
      fields.find("material")
          ->refuse("is " + document::in_quotes(segment.material) + ", which is no material of the model or the film",
                   document::did_you_mean(segment.material, names, "add it to the materials"));
    }
    return segment;
  }

  static std::array<Limits, 3> read_limits(const document::Element& element) {
    const document::Fields fields(element, keys::object("limits"));
    std::array<Limits, 3> limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const document::Element range = fields.value(kAxes[axis]);
      document::require_size(range, 2);
      auto bound = range.begin();
      limits[axis].lower = document::read_number(*bound, keys::kDegrees);
      limits[axis].upper = document::read_number(*++bound, keys::kDegrees);
      if (limits[axis].lower > limits[axis].upper)
        range.refuse("has its lower limit above its upper",
                     "write the lower first, degrees: \"" + std::string(kAxes[axis]) + "\": [-30, 30]");
    }
    return limits;
  }

  static void read_axes(const document::Fields& fields, Joint& joint) {
    const auto unit = [&](std::string_view key) {
      const glm::dvec3 axis = fields.vector(key);
      const double length = glm::length(axis);
      if (length < 1e-9) fields.find(key)->refuse("has no length", "write a vector of the joint's axis");
      return axis / length;
    };
    joint.x_axis = unit("x_axis");
    joint.y_axis = unit("y_axis");
    if (glm::length(glm::cross(joint.x_axis, joint.y_axis)) < kLeastSine)
      fields.element().refuse("has parallel x and y axes", "give x_axis and y_axis different directions");
  }

  Joint read_joint(const document::Element& element) {
    const document::Fields fields(element, keys::object("joint"));
    Joint joint;
    joint.name = read_name(fields.required("name"));
    joint.place = fields.vector("place");
    read_axes(fields, joint);
    if (const auto limits = fields.find("limits")) joint.limits = read_limits(*limits);
    if (const auto segment = fields.find("segment")) {
      joint.segment = read_segment(*segment);
      skins_.emplace_back(joint.name, *segment);
    }
    return joint;
  }

  // Of the segments read, now that all joints are known.
  void read_skins() {
    for (std::size_t joint = 0; joint < model_.joints.size(); ++joint) numbers_[model_.joints[joint].name] = joint;
    const std::vector<Axes> frames = rest_frames(model_);
    for (const auto& [name, element] : skins_) {
      const std::size_t joint = numbers_.at(name);
      const document::Fields fields(element, keys::object("segment"));
      const bool follows = model_.shapes[model_.joints[joint].segment->shape].has_skin();
      const auto skin = fields.find("skin");
      if (skin && !follows)
        skin->refuse("belongs to a shape with bones, which this one is not",
                     "give its mesh, bspline or subdivision `bones`, or take it out");
      if (!skin && follows)
        fields.find("shape")->refuse("has bones, but the segment has no skin",
                                     "name the bones: \"skin\": {\"joints\": [\"hip\", \"knee\"]}");
      if (skin) read_skin(*skin, joint, frames);
    }
  }

  void read_skin(const document::Element& element, std::size_t number, const std::vector<Axes>& frames) {
    const document::Fields fields(element, keys::object("skin"));
    Segment& segment = *model_.joints[number].segment;
    for (const document::Element item : fields.required("joints")) {
      const std::size_t joint = find_joint(item);
      segment.bones.push_back({joint, bind_at_rest(frames[joint], frames[number])});
    }
    if (const auto binds = fields.find("bind")) {
      document::require_size(*binds, segment.bones.size());
      std::size_t bone = 0;
      for (const document::Element bind : *binds) segment.bones[bone++].bind = read_bind(bind);
    }
    check_bones(element, segment);
    segment.blend = static_cast<wire::Blend>(fields.choice("blend"));
    if (segment.blend == wire::Blend::dual_quaternions) check_volumes(element, model_.joints[number]);
  }

  void check_volumes(const document::Element& element, const Joint& joint) const {
    for (const Bone& bone : joint.segment->bones)
      if (shape::is_flat(bone_matrix({}, bone, joint)))
        element.refuse("flattens what follows '" + model_.joints[bone.joint].name +
                           "', which dual quaternions cannot turn",
                       "give its bind three directions, or write \"blend\": \"linear\"");
  }

  // The shape's points have numbers in the list, which follows the order of the joints.
  void check_bones(const document::Element& element, const Segment& segment) const {
    const std::uint32_t last = last_bone(model_.shapes[segment.shape]);
    if (last >= segment.bones.size())
      element.refuse("has " + document::counted(segment.bones.size(), "joint", "joints") +
                         ", but a point follows bone " + std::to_string(last),
                     "name a joint for each of the shape's bones");
    const auto not_later = [](const Bone& a, const Bone& b) { return a.joint > b.joint; };
    const auto wrong = std::ranges::adjacent_find(segment.bones, not_later);
    if (wrong != segment.bones.end())
      element.refuse("names '" + model_.joints[std::next(wrong)->joint].name + "' after '" +
                         model_.joints[wrong->joint].name + "'",
                     "name joints in the order of the model's, parents before children");
  }

  static Affine read_bind(const document::Element& element) {
    document::require_size(element, 12);
    Affine bind;
    int at = 0;
    for (const document::Element item : element) {
      const int row = at / 4, column = at % 4;
      (column < 3 ? bind.turn[column][row] : bind.place[row]) = document::read_number(item);
      ++at;
    }
    return bind;
  }

  std::size_t find_joint(const document::Element& element) const {
    const std::string name = document::read_text(element);
    if (const auto found = numbers_.find(name); found != numbers_.end()) return found->second;
    element.refuse("is " + document::in_quotes(name) + ", which is no joint of this model",
                   document::did_you_mean(name, names_of(model_.joints), "name a joint of this model"));
  }

  void read_joints(const document::Element& list) {
    document::require_kind(list, document::Kind::list);
    if (list.size() == 0) list.refuse("is empty", "a model has at least one joint");
    std::vector<document::Element> elements;
    for (const document::Element element : list) {
      Joint joint = read_joint(element);
      const auto [first, is_new] = numbers_.try_emplace(joint.name, elements.size());
      if (!is_new)
        element.refuse("is a second joint named '" + joint.name + "', the first is in line " +
                           std::to_string(elements[first->second].line()),
                       "give every joint its own name");
      elements.push_back(element);
      model_.joints.push_back(std::move(joint));
    }
    for (std::size_t i = 0; i < elements.size(); ++i) model_.joints[i].parent = find_parent(elements[i]);
    put_parents_first(elements);
  }

  std::size_t find_parent(const document::Element& element) const {
    const auto parent = element.find("parent");
    if (!parent) return kNone;
    const std::string name = document::read_text(*parent);
    const auto found = numbers_.find(name);
    if (found != numbers_.end()) return found->second;
    parent->refuse(
        "is " + document::in_quotes(name) + ", which is no joint of this model",
        document::did_you_mean(name, names_of(model_.joints), "name a joint of this model, or leave parent out"));
  }

  // Orders the joints as in the file, but each after its ancestors.
  void put_parents_first(const std::vector<document::Element>& elements) {
    const auto& joints = model_.joints;
    enum class State : char { unseen, waiting, placed };
    std::vector<State> state(joints.size(), State::unseen);
    std::vector<std::size_t> order, chain, now_at(joints.size());
    for (std::size_t first = 0; first < joints.size(); ++first) {
      for (std::size_t at = first; at != kNone && state[at] != State::placed; at = joints[at].parent) {
        if (state[at] == State::waiting)
          elements[at].refuse("joint '" + joints[at].name + "' is its own ancestor", "break the cycle of parents");
        state[at] = State::waiting;
        chain.push_back(at);
      }
      for (; !chain.empty(); chain.pop_back()) {
        state[chain.back()] = State::placed;
        now_at[chain.back()] = order.size();
        order.push_back(chain.back());
      }
    }
    std::vector<Joint> sorted;
    sorted.reserve(joints.size());
    for (const std::size_t at : order) {
      sorted.push_back(std::move(model_.joints[at]));
      if (sorted.back().parent != kNone) sorted.back().parent = now_at[sorted.back().parent];
    }
    model_.joints = std::move(sorted);
  }

  Model model_;
  std::size_t own_shapes_ = 0;  // those of the file come first
  std::unordered_set<std::string_view> material_names_;
  std::vector<std::filesystem::path> sources_;
  std::map<std::pair<std::string_view, OptionValues>, std::size_t> library_;  // numbers of shapes made
  std::unordered_map<std::string, std::size_t> numbers_;                      // of joints, as in the file
  std::vector<std::pair<std::string, document::Element>> skins_;  // of joints by name: segments, which may have one
};

}  // namespace

std::string checked_name(const document::Element& element, std::string_view name) {
  if (name.empty()) element.refuse("has an empty name", "write a name");
  if (name.size() > 100) element.refuse("has a name of " + std::to_string(name.size()) + " bytes", "at most 100 bytes");
  if (name.find('/') != std::string_view::npos) element.refuse("has a name with '/'", "use '-' or '_' instead");
  return std::string(name);
}

std::string read_name(const document::Element& element) { return checked_name(element, document::read_text(element)); }

Model read_model(const document::Element& element, std::span<const std::string_view> film_materials) {
  return ModelReader(film_materials, {}).read(element);
}

Model load_model(const std::filesystem::path& path, std::span<const std::string_view> film_materials) {
  const document::Document document = document::read_document(path);
  return read_model(document.root(), film_materials);
}

}  // namespace mars::modeler
